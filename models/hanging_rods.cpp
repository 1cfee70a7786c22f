#include "dalembert/models/hanging_rods.h"

#include <cmath>
#include <utility>

namespace dalembert::models {

HangingRods hang(const std::string& name, double gravity, std::span<const RodAndBead> rods) {
  HangingRods built{.scene = Scene<2>(name), .beads = {}, .rods = {}};
  built.scene.add(UniformGravity<2>{{0.0, -gravity}});
  Vec<2> position = Vec<2>::Zero(), velocity = Vec<2>::Zero();
  for (const RodAndBead& rod : rods) {
    const double sine = std::sin(rod.angle), cosine = std::cos(rod.angle);
    position += rod.length * Vec<2>(sine, -cosine);
    velocity += rod.length * rod.rate * Vec<2>(cosine, sine);
    const Particle<2> bead =
        built.scene.add_particle({.mass = rod.mass, .position = position, .velocity = velocity});
    built.rods.push_back(built.beads.empty()
                             ? built.scene.add(Distance{Fixed<2>{}, bead, rod.length})
                             : built.scene.add(Distance{built.beads.back(), bead, rod.length}));
    built.beads.push_back(bead);
  }
  return built;
}

Observed<2> observed(HangingRods built) {
  return {std::move(built.scene),
          [beads = std::move(built.beads), rods = std::move(built.rods)](const Sample<2>& sample) {
            Observation<2> seen;
            for (const Particle<2>& bead : beads) seen.positions.push_back(sample.position(bead));
            for (const Constraint<1>& rod : rods) seen.forces.push_back(-sample.multiplier(rod));
            return seen;
          }};
}

}  // namespace dalembert::models
