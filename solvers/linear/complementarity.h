#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Core>

#include <optional>

namespace DALEMBERT_HIDDEN dalembert {

/// The linear complementarity problem
///
///   w = M z + q,   w >= 0,   z >= 0,   w^T z = 0,
///
/// by Lemke's pivoting with the lexicographic rule, which ends after finitely many pivots whatever the ties
/// (Cottle, Pang, Stone, The Linear Complementarity Problem, 4.4). For a positive semi-definite M it finds a
/// solution if there is one, and w is unique. The diagonal of M gives each w and z its unit. None if the
/// problem has no solution, or, for another M, none was found.
///
/// Of each pair the basic variable has its value, the other is 0 exactly.
[[nodiscard]] std::optional<Eigen::VectorXd> complementary_solution(const Eigen::MatrixXd& M,
                                                                    const Eigen::VectorXd& q);

}  // namespace dalembert
