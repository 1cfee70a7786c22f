#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <string>
#include <vector>

namespace dalembert::models {

/// A bead at the lower end of a massless rigid rod.
struct RodAndBead {
  double mass;        ///< of the bead [mass]
  double length;      ///< of the rod [length]
  double angle;       ///< of the rod from the downward vertical, towards +x [rad]
  double rate = 0.0;  ///< d(angle)/dt [rad / time]
};

/// Rods strung one below the other from the origin: pendulum, double pendulum, chain.
struct HangingRods {
  Scene<2> scene;
  std::vector<Particle<2>> beads;   ///< from the origin outwards
  std::vector<Constraint<1>> rods;  ///< the rod above each bead; its tension is -multiplier
};

/// The scene in plane gravity along -y, each rod a Distance.
[[nodiscard]] HangingRods hang(const std::string& name, double gravity, std::span<const RodAndBead> rods);

/// Observes the positions of all beads and the tensions of all rods, from the origin outwards.
[[nodiscard]] Observed<2> observed(HangingRods rods);

}  // namespace dalembert::models
