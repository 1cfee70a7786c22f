#pragma once

#include <dalembert/core/scene/system.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace dalembert::detail {

/// The most coordinates of a Lagrangian, and equations of constraint on them: their derivatives fill square
/// matrices, and so nothing is allocated for them.
inline constexpr int most_coordinates = 32;

/// The rows of constraints at one instant, A and gamma of (1) below. Allocates, unless there are none.
struct ConstraintRows {
  std::vector<double> A{};  ///< row after row
  std::vector<double> gamma{};

  [[nodiscard]] int count() const { return static_cast<int>(gamma.size()); }
};
[[nodiscard]] ConstraintRows rows_of(const System& constraints, const Instant& at);

/// The accelerations a that satisfy
///
///   M a = f + A^T lambda,   A a + gamma = 0,                                                            (1)
///
/// M symmetric but not necessarily definite. With the columns of Z a basis of all a with A a = 0, and a_0 the
/// smallest one with A a_0 + gamma = 0, a = a_0 + Z z and  Z^T M Z z = Z^T (f - M a_0):  lambda does not
/// occur, so that rows of A may depend on each other. Coordinates are measured in units in which M has
/// entries near 1, rows of A have unit length.
struct Accelerations {
  /// As many as there are coordinates; or a direction that the constraints allow and that has no inertia.
  std::array<double, most_coordinates> a;
  bool determined = true;  ///< by (1)
  /// Of the determinant of Z^T M Z: along a motion it changes only where that is singular.
  int sign = 1;
};
/// M is square and as long as f.
[[nodiscard]] Accelerations accelerations(std::span<const double> M, std::span<const double> f,
                                          const ConstraintRows& rows);

/// The multipliers in A^T lambda = r: of dependent rows those with the smallest forces, and the smallest sine
/// of an angle among the independent ones: 1/sine is the factor by which an error of A is amplified.
struct SolvedMultipliers {
  std::vector<double> lambda;
  double sine;
  int rank;
};
[[nodiscard]] SolvedMultipliers multipliers(const ConstraintRows& rows, std::span<const double> r);

/// The faults that no acceleration follows at q, as motion along the direction has no inertia, and that the
/// motion can have reached q only through such a place.
[[nodiscard]] std::string no_inertia(std::span<const double> q, std::span<const double> direction);
[[nodiscard]] std::string inertia_lost(std::span<const double> q);

}  // namespace dalembert::detail
