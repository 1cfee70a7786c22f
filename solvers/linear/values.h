#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// The saddle-point system that every solve of this library is about,
///
///   [ M + A   -U^T ] [ x ]   [ a ]
///   [ L        S   ] [ y ] = [ b ],
///
/// by what stands in it besides the masses. U = W + (dF_f/dlambda)^T, L = W where nothing else is given,
/// A = h H + d D with H = -d(F + W^T lambda)/dq and D = -dF/dv, S diagonal and not 0 in compliant rows only.
/// What is empty is zero.
struct SaddleValues {
  std::span<const double> w;                      ///< in the pattern of the system's W
  std::span<const double> s{};                    ///< the diagonal of S, one number per row of the system
  std::span<const double> slope{};                ///< dF_f/dlambda, in the system's pattern
  std::span<const double> lower{};                ///< L, in W's pattern
  const System::Linearisation* forces = nullptr;  ///< -H and -D
  double h = 0.0, d = 0.0;

  /// Which of it are there: the blocks of a pattern that holds them.
  enum class Blocks { symmetric, slope, all };
  [[nodiscard]] Blocks blocks() const {
    if (forces != nullptr) return Blocks::all;
    return slope.empty() ? Blocks::symmetric : Blocks::slope;
  }
};

}  // namespace dalembert
