#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

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
  Eigen::SparseMatrix<double, Eigen::RowMajor> A;
  Eigen::VectorXd b;
  double rate = 0.0;          ///< of the fastest part [rad / time]
  Eigen::MatrixXd symmetric;  ///< columns: displacements by symmetries, along which nothing changes
};

}  // namespace dalembert
