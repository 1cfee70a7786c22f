#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace dalembert {

/// A motion along a symmetry of a scene, in its flat coordinates: every state of it is the first one, carried
/// by
///
///   q' = v = A q + b,    v' = A v                                                                    (1)
///
/// A and b are sums of translations and rotations of parts that nothing couples, of rotors that turn, and of
/// bodies that spin about an axis of their own: as a body's particles are an affine basis of it, its spin is
/// a constant matrix too, whichever way its axis points.
struct UniformMotion {
  Eigen::SparseMatrix<double, Eigen::RowMajor> A;  ///< of (1) [1 / time]
  Eigen::VectorXd b;                               ///< of (1) [speed]
  double rate = 0.0;                               ///< of the fastest part [rad / time]
  /// Columns: displacements by symmetries that carry the motion's states into others of the same motion.
  Eigen::MatrixXd symmetric{};
  /// Symmetries u -> A u of the same kind that leave the state as it is: a top that sleeps turned about its
  /// axis and back in itself.
  std::vector<Eigen::SparseMatrix<double, Eigen::RowMajor>> fixing{};
  /// Columns: displacements by all symmetries, which may carry them into states of another such motion.
  Eigen::MatrixXd carried{};
};

}  // namespace dalembert
