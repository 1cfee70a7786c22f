#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <limits>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The most coordinates of a small scene.
inline constexpr std::size_t most_dense = 600;

/// All modes of a small scene by dense matrices, of each uncoupled part separately, see Tangent. Without
/// nonholonomic rows, C = 0 and K symmetric they are those of K z = omega^2 z, else those of `solutions`. The
/// error to which an eigenvalue is known decides whether it grows; where that does not tell, an energy u'.M
/// u'/2 + u.K u/2 > 0: for K symmetric, C dissipative, E = 0; with momenta that symmetries of `motion`
/// conserve; last of all `stable_otherwise`, of a part. Marks no mode as free. Throws EquationFault.
[[nodiscard]] Modes dense_modes(const System& system, const LinearTerms& terms,
                                const UniformMotion* motion = nullptr,
                                const std::function<bool(std::size_t)>& stable_otherwise = {});

/// Of each part whether all small motions decay but as many as symmetries carry the steady motion into
/// others alike. These others are then the centre manifold of all that stays, and what is near comes to one
/// of them, at the same distance for ever (reduction principle: Carr, Applications of Centre Manifold Theory,
/// 1981).
[[nodiscard]] std::vector<char> attracting_parts(const System& system, const LinearTerms& terms,
                                                 const UniformMotion& motion);

/// K on the tangent space (with nonholonomic rows: of what may move), of each uncoupled part separately: its
/// real eigenvalues, increasing, their shapes u = M^-1/2 N z of |z| = 1 as columns, and the covectors that
/// give 1 for their own shape and 0 for the others. Where circulatory forces make K unsymmetric others may be
/// complex. Of displacements by symmetries, along which K is 0, they are left out.
struct TangentStiffness {
  Eigen::VectorXd values;
  Eigen::MatrixXd shapes, duals;
  /// The smallest real part of all eigenvalues, of symmetries too.
  double least = std::numeric_limits<double>::infinity();
  /// The logarithm of |det K|, of the product of all eigenvalues that are not 0, and whether it is negative.
  /// Where two real eigenvalues become complex close to 0, the determinant still passes 0 with a slope.
  double log_determinant = 0.0;
  bool negative = false;
};
/// `symmetric`: displacements by symmetries, as columns.
[[nodiscard]] TangentStiffness tangent_stiffness(const System& system, const LinearTerms& terms,
                                                 const Eigen::MatrixXd& symmetric);

/// The eigenvalue of a vibration, Im s > 0 (or of a motion that does not vibrate), and the error to which it
/// is known.
struct Vibration {
  std::complex<double> s;
  double error;

  [[nodiscard]] bool grows() const { return s.real() > error; }
};

/// Those of a scene in which some may grow, by decreasing real part. None where damping takes energy away, K
/// is symmetric, and either C is or K is not negative along any shape: nothing that vibrates grows then
/// (Kelvin, Tait; Chetaev). Without C, and without nonholonomic rows, -s^2 is an eigenvalue of K.
[[nodiscard]] std::vector<Vibration> vibrations(const System& system, const LinearTerms& terms);

/// All eigenvalues of the small motions about a steady motion that are not 0, real ones included, by
/// decreasing real part.
[[nodiscard]] std::vector<Vibration> all_vibrations(const System& system, const LinearTerms& terms,
                                                    const UniformMotion& motion);

}  // namespace dalembert
