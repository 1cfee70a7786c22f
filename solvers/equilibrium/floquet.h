#pragma once

#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>

#include <complex>
#include <functional>
#include <span>
#include <vector>

namespace dalembert {

/// The factors by which small disturbances of a periodic motion are multiplied in every period.
struct Floquet {
  std::vector<std::complex<double>> multipliers;  ///< by decreasing modulus
  int steps = 0;                                  ///< of the variational equations, in one period
  /// How far each may be off. A multiplier that is close to others, as a double one, is known to a root of
  /// what the map of a period is known to.
  std::vector<double> errors{};

  /// The modulus of the largest.
  [[nodiscard]] double growth() const { return multipliers.empty() ? 0.0 : std::abs(multipliers.front()); }
  /// Unstable if one exceeds 1 by more than its error, stable if all are smaller by as much; else undecided,
  /// as in a motion without damping: linear terms let disturbances neither grow nor decay.
  [[nodiscard]] Stability stability() const;
};

/// For Systems, each made anew by `system`, out of which `floquet` takes its own.
[[nodiscard]] Floquet find_multipliers(const std::function<System()>& system, std::span<const double> q,
                                       std::span<const double> v, double period);

/// The multipliers of the periodic motion that begins at t = 0 with a scene's initial state: that of a driven
/// scene such as an upright pendulum on a vibrating pivot, or a natural vibration.
///
///   M w' = (F + W^T lambda)_q u + F_v w + W^T y,   u' = w + M^-1 G^T z,   W w + psi_q u = 0,   G u = 0   (1)
///
/// for disturbances u of q and w of v, along the motion as the explicit stepper finds it. (1) is the
/// linearisation of the stabilised index-2 equations, on the tangent space of the constraints, integrated by
/// Radau IIA of order 9 (Hairer, Wanner, Solving ODEs II, VII.4), which decays as what is stiff does, in
/// steps that are halved until each errs by less than 1e-11 of what it does. Rotors may turn round in a
/// period, if a whole turn of them changes nothing.
///
/// All in the norm of the energy, sqrt(u^T (|K| + M/T^2) u + w^T M w) with the stiffness K at the start and
/// the period T, which vibrations keep, however stiff they are. Carried through the rest of the period these
/// errors add up to that of the map, e. A simple multiplier errs by no more than e/|y^H x|, with its
/// eigenvectors y and x of length 1 on the left and right; of n that are equal, which e moves apart by an
/// n-th root, that is an n-th of the way: of d multipliers each is known to d e/|y^H x|, or by Elsner to (2
/// |M| + e)^(1 - 1/d) e^(1/d) if that is less.
///
/// Throws NoEquilibrium if the motion does not return after `period`, or where forces or constraints differ
/// after it at its ends or at 48 instants between; InvalidArgument if the period is
/// not finite and > 0, InvalidScene if a force reads multipliers; what `simulate` throws.
template <int D>
[[nodiscard]] Floquet floquet(const Scene<D>& scene, double period) {
  return find_multipliers([&scene] { return scene.system(); }, scene.initial_positions(),
                          scene.initial_velocities(), period);
}

}  // namespace dalembert
