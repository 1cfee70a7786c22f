#pragma once

#include <dalembert/core/scene/system.h>

#include <string>
#include <vector>

namespace dalembert {

/// What is known of velocity constraints that share coordinates.
struct Integrability {
  std::vector<std::string> constraints;  ///< labels, one per equation of the set
  /// The whole set is integrable: together with the scene's holonomic constraints it is
  /// equivalent to equations between coordinates and time.
  bool holonomic = false;
  /// If the set is not: those of its equations that are integrable each by itself.
  std::vector<std::string> integrable_alone;
};

/// Judges the nonholonomic constraints of a system at a state (notes, mln37), set by set.
///
/// Each row is a one-form omega_j = A_j dq + a_j dt. With the holonomic rows dg they span I; X are
/// the directions in (q, t) that all of them allow. By Frobenius' theorem I is integrable if and
/// only if every d omega_j vanishes between any two of these directions,
///
///   B_j,ab = X_a^T (J_j - J_j^T) X_b = 0,     J_j,kl = d(omega_j)_l / dz_k,   z = (q, t).      (1)
///
/// Derivatives are exact, ranks are found by QR. The notes' sufficient condition (each form closed)
/// misses sets that are integrable only with a factor or only together. A set found not integrable
/// at one state is not; one found integrable must be so at every state, so ask at several.
[[nodiscard]] std::vector<Integrability> integrability(const System& system, double t,
                                                       std::span<const double> q);

}  // namespace dalembert
