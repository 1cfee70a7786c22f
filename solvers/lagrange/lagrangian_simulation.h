#pragma once

#include <dalembert/core/lagrange/lagrangian_motion.h>
#include <dalembert/solvers/simulation.h>

namespace dalembert {

/// Runs a Lagrangian system by either stepper. Throws InvalidArgument, InconsistentStart (also where L_vv is
/// singular at the start), IntegrationFailure; see there. Options mean what they mean for a scene: the
/// tolerance is relative to the coordinates' scales.
template <int N>
[[nodiscard]] LagrangianMotion<N> simulate(const LagrangianSystem<N>& system, const Options& options) {
  return {system, simulate(system.rotor_scene(options.t_start), options), options.tolerance};
}

}  // namespace dalembert
