#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A solution u exp(s t) of (lambda^2 M + lambda C + K) u = W^T y, W u + c y = 0, at lambda = s.
struct QuadraticPair {
  std::complex<double> s;
  Eigen::VectorXcd u;
  /// |(s^2 M + s C + K) u - W^T y| over (|s|^2 + |s| |C| + |K|) |u|, all in the mass metric, see Tisseur,
  /// Linear Algebra Appl. 309 (2000).
  double backward_error;
  /// To which s is known where it may grow, Re s > 0: by its condition 1/|v^H (2 s M + C) u| with the
  /// solution v on the left, and a backward error of the roundings of a sum.
  double error = 0.0;
};

/// All solutions of a large scene with |s| up to that of the `wanted`th with |s| > `zero`, conjugates and
/// those within `zero` included, by increasing |s|. With a real shift sigma, and S of a state (a, b) = (u,
/// u'),
///
///   [ K + sigma C + sigma^2 M  -W^T ] [ p ]     [ M b + (C + sigma M) a ]
///   [ W                         c   ] [ y ] = - [           0           ],    S (a, b) = (p, a + sigma p),
///
/// S (u, s u) = (u, s u)/(s - sigma): one real factorisation, and of the largest eigenvalues of S those
/// nearest to sigma. Arnoldi's method, its leading Schur vectors locked as they converge (Stewart, SIAM J.
/// Matrix Anal. 23, 2001) and deflated from the next run, which starts from another generic vector. Since
/// |s - sigma| <= |s| + sigma, all with |s| <= R are known when all within R + sigma of the shift are: a run
/// ends when its largest Schur values, converged, reach as far, and the search when a run begins there. What
/// is small beside the largest of S is improved by inverse iteration (Newton's method, Tisseur). Like every
/// Krylov method this proves nothing of a solution that no starting vector has a part in.
///
/// Throws InvalidScene if fewer converge, the equations are singular or a solution does not satisfy them.
[[nodiscard]] std::vector<QuadraticPair> nearest_solutions(const System& system, const LinearTerms& terms,
                                                           double sigma, double unit_of_frequency,
                                                           double zero, std::size_t wanted);

/// A reproducible vector with a part in everything.
[[nodiscard]] Eigen::VectorXd generic_vector(Eigen::Index n, unsigned seed);

}  // namespace dalembert
