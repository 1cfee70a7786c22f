#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/tangent.h>

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A solution z exp(s t) of the small motions (1) of Tangent that is no state at rest.
struct Solution {
  std::complex<double> s;
  double error;  ///< to which s is known
  Eigen::VectorXcd z;
  bool positive;  ///< whether its energy is > 0, in some frame that moves as the scene does
};

/// The states at rest, one per column, and the other solutions with Im s >= 0.
struct Solutions {
  Eigen::MatrixXd at_rest;
  std::vector<Solution> others;
};

/// All of them, in the part's own unit of time. With P a basis of the null space of B and z' = P c - B^+ E z,
///
///   z' = P c - B^+ E z,    c' = P^T (C B^+ E - K) z - P^T C P c,                                       (1)
///
/// in units of time in which |K| = 1. Its zero eigenvalues may be defective: those of the null space of [P^T
/// K; E], and those of motions that go along them for ever, are deflated before the others are computed,
/// however long their chains are. Each of these is known to the round-off of the terms of (1) times its
/// condition 1/|y^H x|.
[[nodiscard]] Solutions solutions(Tangent t);

/// Whether an energy conserved or dissipated decides stability: K symmetric, constraints that do no work, and
/// C positive semi-definite. Each coordinate is scaled by its own damping, so that a strong damper hides no
/// weak negative one.
[[nodiscard]] bool has_energy(const Tangent& t);

}  // namespace dalembert
