#include <dalembert/core/scene/system.h>

#include <algorithm>

namespace dalembert {

std::vector<std::size_t> System::conditional_rows() const {
  std::vector<std::size_t> rows;
  for (const std::size_t number : layout_->conditional_constraints())
    for (const std::size_t r : layout_->constraints[number].own_rows())
      if (in_force(r)) rows.push_back(r);
  return rows;
}

System System::without(std::span<const std::size_t> constraints) const {
  System other = *this;
  other.out_of_force_.resize(rows());
  for (const std::size_t number : constraints)
    for (const std::size_t r : layout_->constraints[number].own_rows()) other.out_of_force_[r] = 1;
  other.rows_in_force_ = static_cast<std::size_t>(std::ranges::count(other.out_of_force_, char{0}));
  return other;
}

System System::sliding(std::span<const Slide> slides) const {
  std::vector<std::size_t> all;
  for (const Slide& slide : slides) all.push_back(slide.constraint);
  System other = without(all);
  for (std::size_t b = 0; b < parts_.constraints.size(); ++b) {
    std::vector<Sliding> own;
    std::vector<int> numbers;
    for (const Slide& slide : slides) {
      const auto place = std::ranges::find(parts_.constraint_numbers[b], static_cast<int>(slide.constraint));
      if (place == parts_.constraint_numbers[b].end()) continue;
      const Layout::Constraint& its = layout_->constraints[slide.constraint];
      own.push_back({static_cast<std::size_t>(place - parts_.constraint_numbers[b].begin()),
                     its.condition.roughness->pressed_by, slide.strength, slide.direction, slide.slow,
                     its.own_rows(), its.slots()});
      numbers.push_back(*place);
    }
    if (own.empty()) continue;
    other.forces_.add_sliding(std::make_shared<const SlidingFriction>(parts_.constraints[b], std::move(own)),
                              std::move(numbers), other.stiffness_pattern_);
  }
  return other;
}

}  // namespace dalembert
