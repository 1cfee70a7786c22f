#include <dalembert/core/scene/system.h>

#include <numeric>

namespace dalembert {

void System::index_layout() {
  Layout& layout = parts_.layout;
  layout.touching_start.assign(coordinates() + 1, 0);
  for (const int coordinate : layout.slot_coordinate)
    ++layout.touching_start[static_cast<std::size_t>(coordinate) + 1];
  std::partial_sum(layout.touching_start.begin(), layout.touching_start.end(), layout.touching_start.begin());
  layout.touching.resize(layout.slot_coordinate.size());
  std::vector<int> next = layout.touching_start;
  for (const Layout::Constraint& c : layout.constraints) {
    for (const std::size_t slot : c.slots()) {
      const auto coordinate = static_cast<std::size_t>(layout.slot_coordinate[slot]);
      layout.touching[static_cast<std::size_t>(next[coordinate]++)] = static_cast<int>(slot);
    }
  }

  std::vector<AppliedForces::Place> places(layout.forces.size());
  const auto of = [&places](int number) -> auto& { return places[static_cast<std::size_t>(number)]; };
  for (const auto& [number, acceleration] : parts_.gravities) of(number).acceleration = acceleration;
  for (std::size_t b = 0; b < parts_.forces.size(); ++b) {
    const auto& first_row = force_places_[b].first_row;
    for (std::size_t i = 0; i < parts_.force_numbers[b].size(); ++i)
      of(parts_.force_numbers[b][i]) = {
          .batch = parts_.forces[b], .element = i, .first_row = first_row.empty() ? 0 : first_row[i]};
  }
  layout.applied = std::make_shared<const AppliedForces>(std::move(places));
}

}  // namespace dalembert
