#include <dalembert/core/scene/system.h>

#include <algorithm>

namespace dalembert {

std::string System::conditional_label() const {
  for (std::size_t c = 0; c < conditions().of.size(); ++c)
    if (!conditions().of[c].always()) return layout()->constraints[c].label();
  return {};
}

std::vector<std::size_t> System::conditional_rows() const {
  std::vector<std::size_t> rows;
  for (const std::size_t number : conditions().conditional_constraints())
    for (const std::size_t r : layout()->constraints[number].own_rows())
      if (in_force(r)) rows.push_back(r);
  return rows;
}

System System::without(std::span<const std::size_t> constraints) const {
  System other = *this;
  other.out_of_force_.resize(rows());
  for (const std::size_t number : constraints)
    for (const std::size_t r : layout()->constraints[number].own_rows()) other.out_of_force_[r] = 1;
  other.rows_in_force_ = static_cast<std::size_t>(std::ranges::count(other.out_of_force_, char{0}));
  return other;
}

System System::sliding(std::span<const Slide> slides) const {
  std::vector<std::size_t> all;
  for (const Slide& slide : slides) all.push_back(slide.constraint);
  System other = without(all);
  Forces with_them = *forces_;
  for (std::size_t b = 0; b < batches().size(); ++b) {
    std::vector<Sliding> own;
    std::vector<int> constraints;
    for (const Slide& slide : slides) {
      const auto place = std::ranges::find(numbers(b), static_cast<int>(slide.constraint));
      if (place == numbers(b).end()) continue;
      const Layout::Constraint& its = layout()->constraints[slide.constraint];
      own.push_back({static_cast<std::size_t>(place - numbers(b).begin()),
                     conditions().of[slide.constraint].roughness->pressed_by, slide.strength, slide.direction,
                     slide.slow, its.own_rows(), its.slots()});
      constraints.push_back(*place);
    }
    if (own.empty()) continue;
    with_them.batches.add_sliding(std::make_shared<const SlidingFriction>(batches()[b], std::move(own)),
                                  std::move(constraints), with_them.stiffness_pattern);
  }
  other.forces_ = std::make_shared<const Forces>(std::move(with_them));
  return other;
}

}  // namespace dalembert
