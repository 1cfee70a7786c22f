#include "dalembert/core/results/layout.h"

#include <dalembert/core/errors.h>

#include <algorithm>
#include <numeric>

namespace dalembert {

void Layout::index_slots(std::size_t coordinates) {
  touching_start.assign(coordinates + 1, 0);
  for (const int coordinate : slot_coordinate) ++touching_start[static_cast<std::size_t>(coordinate) + 1];
  std::partial_sum(touching_start.begin(), touching_start.end(), touching_start.begin());
  touching.resize(slot_coordinate.size());
  std::vector<int> next = touching_start;
  for (const Constraint& c : constraints) {
    for (const std::size_t slot : c.slots()) {
      const auto coordinate = static_cast<std::size_t>(slot_coordinate[slot]);
      touching[static_cast<std::size_t>(next[coordinate]++)] = static_cast<int>(slot);
    }
  }
}

const Layout::Particle* Layout::particle_at(int coordinate) const {
  const auto next = std::ranges::upper_bound(particles, coordinate, {}, &Particle::coordinate);
  if (next == particles.begin()) return nullptr;
  const Particle& before = *(next - 1);
  return coordinate < before.coordinate + dimension ? &before : nullptr;
}

std::string Layout::label_of_coordinate(int coordinate) const {
  if (const Particle* particle = particle_at(coordinate))
    return "particle \"" + particle->name + "\" along " + "xyz"[coordinate - particle->coordinate];
  const auto rotor = std::ranges::find(rotors, coordinate, &Rotor::coordinate);
  return "rotor \"" + rotor->name + '"';
}

void Layout::refuse(std::uint64_t other) const {
  throw InvalidArgument(
      "This handle is not one of scene \"" + scene + "\": " +
      (other == id && id != 0 ? "it was added after the run was made"
                              : "it belongs to another scene or to none") +
      "; use those that this scene returned, or that its original returned before it was copied");
}

}  // namespace dalembert
