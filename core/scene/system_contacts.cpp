#include <dalembert/core/scene/system.h>

#include <algorithm>

namespace dalembert {

std::vector<std::size_t> System::contacts() const {
  std::vector<std::size_t> numbers;
  for (std::size_t c = 0; c < layout_->constraints.size(); ++c)
    if (layout_->constraints[c].contact) numbers.push_back(c);
  return numbers;
}

System System::without(std::span<const std::size_t> constraints) const {
  System other = *this;
  other.out_of_force_.resize(rows());
  for (std::size_t b = 0; b < parts_.constraints.size(); ++b) {
    const auto& numbers = parts_.constraint_numbers[b];
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto number = static_cast<std::size_t>(numbers[i]);
      if (std::ranges::find(constraints, number) == constraints.end()) continue;
      (*other.parts_.constraints[b]).leave_out(i);
      const Layout::Constraint& its = layout_->constraints[number];
      std::fill_n(other.out_of_force_.begin() + its.first_row, its.rows, char{1});
    }
  }
  other.rows_in_force_ = static_cast<std::size_t>(std::ranges::count(other.out_of_force_, char{0}));
  return other;
}

}  // namespace dalembert
