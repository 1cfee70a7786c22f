#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Core>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A convex problem under cones of second order,
///
///   x^T Q x / 2 + c^T x = min,   |A_i x + a_i| <= e_i^T x + h_i,                                    (1)
///
/// Q positive semi-definite. With r = A x + a, s = e^T x + h of each cone and a weight w, in the units of the
/// function, it is solved by Newton's method for
///
///   x^T Q x / 2 + c^T x - m sum w_i log(s_i^2 - |r_i|^2),   m -> 0,                                  (2)
///
/// which misses the minimum by 2 m sum w (Boyd, Vandenberghe, Convex Optimization, 11.3). At its solution
/// every cone has both its slack s - |r| and its force: where one of them is 0 in the limit, the other is
/// not, if (1) decides that at all. Weights of their own make parts that have nothing to do with each other
/// independent of each other's size.
struct ConeProgram {
  struct Cone {
    Eigen::MatrixXd A;
    Eigen::VectorXd a, e;
    double h, weight;
  };
  Eigen::MatrixXd Q;
  Eigen::VectorXd c;
  std::vector<Cone> cones;

  /// From an x inside all cones.
  [[nodiscard]] Eigen::VectorXd minimum(Eigen::VectorXd x) const;
};

}  // namespace dalembert
