#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The most coordinates of a small scene.
inline constexpr std::size_t most_dense = 600;

/// All modes of a small scene by dense matrices, of each uncoupled part separately. With an orthonormal basis
/// N of the tangent space in the mass metric, u = M^-1/2 N z,
///
///   z'' + C z' + K z = B^T y,    B z' + E z = 0     (nonholonomic rows)                            (1)
///
/// If there are no such rows, C = 0 and K is symmetric: K z = omega^2 z. Otherwise, with P a basis of the
/// null space of B and z' = P c - B^+ E z,
///
///   z' = P c - B^+ E z,    c' = P^T (C B^+ E - K) z - P^T C P c,                                       (2)
///
/// in units of time in which |K| = 1. Its zero eigenvalues may be defective: those of the null space of [P^T
/// K; E], and those of motions that go along them for ever, are deflated before the others are computed,
/// however long their chains are. Each of these is known to the matrix's round-off times its condition 1/|y^H
/// x|, and decides only what exceeds that; where it does not grow an energy u'.M u'/2 + u.K u/2 > 0 decides:
/// for K symmetric, C dissipative, E = 0. Marks no mode as free. Throws EquationFault.
///
/// Of displacements by symmetries (columns of `symmetric`) those that the frame's motion leaves as they are
/// change nothing: K u = 0 and E u = 0 exactly, not to round-off, of which a chain of zeros takes roots.
[[nodiscard]] Modes dense_modes(const System& system, const LinearTerms& terms,
                                const Eigen::MatrixXd& symmetric = {});

/// K on the tangent space, of each uncoupled part separately: its real eigenvalues, increasing, their shapes
/// u = M^-1/2 N z of |z| = 1 as columns, and the covectors that give 1 for their own shape and 0 for the
/// others. Where circulatory forces make K unsymmetric others may be complex.
struct TangentStiffness {
  Eigen::VectorXd values;
  Eigen::MatrixXd shapes, duals;
  double least;  ///< the smallest real part of all eigenvalues
};
[[nodiscard]] TangentStiffness tangent_stiffness(const System& system, const LinearTerms& terms);

/// The eigenvalue of a vibration, Im s > 0, and the error to which it is known.
struct Vibration {
  std::complex<double> s;
  double error;

  [[nodiscard]] bool grows() const { return s.real() > error; }
};

/// Those of a scene in which some may grow, by decreasing real part. None where damping takes energy away, K
/// is symmetric, and either C is or K is not negative along any shape: nothing that vibrates grows then
/// (Kelvin, Tait; Chetaev). Without C, and without nonholonomic rows, -s^2 is an eigenvalue of K.
[[nodiscard]] std::vector<Vibration> vibrations(const System& system, const LinearTerms& terms);

}  // namespace dalembert
