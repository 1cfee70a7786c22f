#pragma once

#include <dalembert/core/scene/system.h>

#include <Eigen/Core>

#include <string>

namespace dalembert::detail {

/// The most coordinates of a Lagrangian, and equations of constraint on them: their derivatives fill square
/// matrices, and so nothing is allocated for them.
inline constexpr int most_coordinates = 32;
using SmallMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_coordinates, most_coordinates>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_coordinates, 1>;

/// The accelerations a that satisfy
///
///   M a = f + A^T lambda,   A a + gamma = 0,                                                            (1)
///
/// M symmetric but not necessarily definite. With the columns of Z a basis of all a with A a = 0, and a_0 the
/// smallest one with A a_0 + gamma = 0, a = a_0 + Z z and  Z^T M Z z = Z^T (f - M a_0):  lambda does not
/// occur, so that rows of A may depend on each other. Coordinates are measured in units in which M has
/// entries near 1, rows of A have unit length.
struct Accelerations {
  SmallVector a;
  /// Empty, or a direction that the constraints allow and that has no inertia: (1) does not determine a.
  SmallVector without_inertia{};
  /// Of the determinant of Z^T M Z: along a motion it changes only where that is singular.
  int sign = 1;
};
[[nodiscard]] Accelerations accelerations(const SmallMatrix& M, const SmallVector& f, const SmallMatrix& A,
                                          const SmallVector& gamma);

/// The multipliers in A^T lambda = r: of dependent rows those with the smallest forces, and the smallest sine
/// of an angle among the independent ones: 1/sine is the factor by which an error of A is amplified.
struct SolvedMultipliers {
  SmallVector lambda;
  double sine;
  Eigen::Index rank;
};
[[nodiscard]] SolvedMultipliers multipliers(const SmallMatrix& A, const SmallVector& r);

/// The rows of constraints at one instant, A and gamma of (1). Allocates.
struct Rows {
  SmallMatrix A;
  SmallVector gamma;

  [[nodiscard]] static Rows none(int coordinates) { return {SmallMatrix(0, coordinates), SmallVector(0)}; }
};
[[nodiscard]] Rows rows_of(const System& constraints, const Instant& at);

/// The faults that no acceleration follows at q, as motion along the direction has no inertia, and that the
/// motion can have reached q only through such a place.
[[nodiscard]] std::string no_inertia(const SmallVector& q, const SmallVector& direction);
[[nodiscard]] std::string inertia_lost(const SmallVector& q);

}  // namespace dalembert::detail
