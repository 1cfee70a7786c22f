#include <dalembert/core/scene/system.h>

#include <algorithm>

namespace dalembert {

namespace {

std::vector<std::size_t> constraints_that(const Layout& layout, const auto& hold) {
  std::vector<std::size_t> numbers;
  for (std::size_t c = 0; c < layout.constraints.size(); ++c)
    if (hold(layout.constraints[c].condition)) numbers.push_back(c);
  return numbers;
}

}  // namespace

std::vector<std::size_t> System::contacts() const {
  return constraints_that(*layout_, [](const Condition& c) { return c.contact.has_value(); });
}

std::vector<std::size_t> System::frictional_constraints() const {
  return constraints_that(*layout_, [](const Condition& c) { return c.roughness.has_value(); });
}

std::vector<std::size_t> System::conditional_constraints() const {
  return constraints_that(*layout_, [](const Condition& c) { return c.contact || c.roughness; });
}

std::vector<std::size_t> System::conditional_rows() const {
  std::vector<std::size_t> rows;
  for (const std::size_t number : conditional_constraints())
    for (const std::size_t r : layout_->constraints[number].own_rows())
      if (in_force(r)) rows.push_back(r);
  return rows;
}

std::vector<std::size_t> System::released() const {
  return constraints_that(*layout_, [](const Condition& c) { return c.released; });
}

std::string System::conditional_label() const {
  for (const Layout::Constraint& c : layout_->constraints)
    if (c.condition.contact || c.condition.roughness || c.condition.released) return c.label();
  return {};
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
    other.slides_.push_back(std::make_shared<const SlidingFriction>(parts_.constraints[b], std::move(own)));
    other.parts_.forces.push_back(other.slides_.back());
    other.parts_.force_numbers.push_back(std::move(numbers));
  }
  other.place_forces(*layout_);
  return other;
}

}  // namespace dalembert
