#include "dalembert/core/lagrange/embedding.h"

#include <dalembert/core/equations/differentiated.h>

#include <cmath>

namespace dalembert::detail {

void require_all_placed(const Layout& layout, std::span<const double> q) {
  const auto require = [&](const auto& all, const char* kind) {
    for (const auto& one : all) {
      if (!std::isnan(q[static_cast<std::size_t>(one.coordinate)])) continue;
      throw InvalidArgument(std::string("The embedding does not say where ") + kind + " \"" + one.name +
                            "\" of scene \"" + layout.scene + "\" is; add it");
    }
  };
  require(layout.particles, "particle");
  require(layout.rotors, "rotor");
}

void rethrow_placing(const Layout& layout, int coordinate, double t) {
  const auto* particle = layout.particle_at(coordinate);
  const std::string label =
      particle != nullptr ? "particle \"" + particle->name + '"' : layout.label_of_coordinate(coordinate);
  try {
    rethrow_as_fault(0);
  } catch (const ElementFault& fault) {
    throw named(fault, "The embedding of " + label, t);
  }
}

void require_frictionless(const System& system) {
  if (!system.forces().has_friction()) return;
  throw InvalidArgument(system.forces().owner_of_friction(0) +
                        " reads a multiplier: the motion alone does not tell it from the force of "
                        "constraint; compare a scene without it");
}

void constraint_forces(const System& system, const Instant& at, std::span<const double> a,
                       std::span<double> Z) {
  auto e = system.evaluation();
  system.evaluate(at, e);
  for (std::size_t i = 0; i < Z.size(); ++i) Z[i] = system.masses()[i] * a[i] - e.force[i];
}

}  // namespace dalembert::detail
