#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/equilibrium/uniform_motion.h>

#include <Eigen/Core>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

inline constexpr double round_off_of_a_sum = roundings_of_a_sum * epsilon;

/// The small motions of an uncoupled part of a scene. With an orthonormal basis N of its tangent space in the
/// mass metric, u = M^-1/2 N z,
///
///   z'' + C z' + K z = B^T y,    B z' + E z = 0     (nonholonomic rows)                            (1)
///
/// The numbers of K and E are known to round-off of the terms that they sum. Those may be large beside what
/// is left: the rods of a body that spins carry its centrifugal forces, of which K keeps nothing.
struct Tangent {
  std::size_t all;                       ///< coordinates of the scene
  std::vector<std::size_t> coordinates;  ///< these of them
  Eigen::MatrixXd shapes;                ///< M^-1/2 N
  Eigen::MatrixXd K, C, B, E;
  bool symmetric;                    ///< K
  Eigen::MatrixXd metric;            ///< M^1/2 N
  Eigen::MatrixXd K_terms, E_terms;  ///< what K and E are sums of, without signs
  double roundings;                  ///< to which these are known, see LinearTerms
  /// z -> beta z by symmetries that leave the state as it is, see UniformMotion::fixing.
  std::vector<Eigen::MatrixXd> fixing{};

  /// To which part of its terms a sum is known.
  [[nodiscard]] double known() const { return round_off_of_a_sum * roundings; }
  /// Round-off of K and of E.
  [[nodiscard]] double zero() const { return round_off_of(K_terms); }
  [[nodiscard]] double zero_of_rows() const { return round_off_of(E_terms); }
  /// Scales time so that K, or without stiffness C and E, has norm 1; returns the frequency of that unit.
  double scale_time();

 private:
  [[nodiscard]] double round_off_of(const Eigen::MatrixXd& terms) const {
    return terms.size() > 0 ? known() * terms.maxCoeff() : 0.0;
  }
};

/// All parts. Uncoupled ones are scenes of their own: what is small in one is not lost beside what is stiff
/// in another. Along displacements by symmetries of `motion`, which change nothing, K u and E u are 0 exactly
/// and not to round-off, of which a chain of zero eigenvalues takes roots.
[[nodiscard]] std::vector<Tangent> tangents(const System& system, const LinearTerms& terms,
                                            const UniformMotion* motion = nullptr);

/// N^T X N, with 0 for what is no more than a part `known` of the summed terms.
[[nodiscard]] Eigen::MatrixXd onto(const Eigen::MatrixXd& N, const Eigen::MatrixXd& X, double known);

}  // namespace dalembert
