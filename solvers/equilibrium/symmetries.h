#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/rotating_frame.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/manifold/start.h>

#include <Eigen/Core>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The motions that carry every motion of a scene into another: X(q) = A (q - c) + b of the sums of
///
///   translations and rotations of each part that nothing couples to others, turns of rotors, and spins of
///   bodies in themselves (a body's particles are an affine basis of it: a constant matrix)           (1)
///
/// about c, the centre of each at the start, as differences of positions do not depend on where the origin
/// is. A translation is by the scene's length, as the others are by a radian: in any unit of length their
/// coefficients are comparable.
///
/// that leave the equations as they are. At states close to the start, on the constraint manifold, with
/// accelerations a and N a basis of W u = 0,
///
///   G X = 0,   psi_q X + W A v = 0,   N^T ((F + W^T lambda)_q X + F_v A v - M A a) = 0.              (2)
///
/// (2) is linear in the coefficients of (1), and nothing is assumed of a body's shape. Derivatives are exact;
/// a sum counts as 0 below `rank_threshold` of its terms.
class Symmetries {
 public:
  Symmetries(const Problem& problem, const Start& start, double time);

  [[nodiscard]] Eigen::Index size() const { return basis_.cols(); }
  /// The motion of some coefficients.
  [[nodiscard]] UniformMotion motion(const Eigen::VectorXd& y) const;
  /// Coefficients, as columns, of all that commute with the motion of y in the state q: what they carry a
  /// state of that motion to is one of the same motion,
  ///
  ///   A_k v = A X_k(q),   A_k A v = A A_k v,   v = A q + b.                                          (3)
  [[nodiscard]] Eigen::MatrixXd commuting(const Eigen::VectorXd& q, const Eigen::VectorXd& y) const;
  /// The same of a frame, which need not be a symmetry.
  [[nodiscard]] Eigen::MatrixXd commuting(const Eigen::VectorXd& q, const RotatingFrame& frame) const;
  /// X(q) of some coefficients, columns, with 0 in uncoupled parts where it is no more than `rank_threshold`
  /// of its terms. Within a part that is displaced small numbers are as right as large ones: of a heavy body
  /// beside the centre of mass, about which a light one makes it turn.
  [[nodiscard]] Eigen::MatrixXd displacements(const Eigen::VectorXd& q, const Eigen::MatrixXd& some) const;
  /// X_k(q) and A_k x of each, columns.
  [[nodiscard]] Eigen::MatrixXd fields(const Eigen::VectorXd& q) const;
  [[nodiscard]] Eigen::MatrixXd images(const Eigen::VectorXd& x) const;
  /// Rates at which parts turn as a whole, of each: rows.
  [[nodiscard]] Eigen::MatrixXd turning() const;

 private:
  struct Generator {
    RotatingFrame::Sparse A;
    Eigen::VectorXd b, c;
    bool turns, rotates;  // a part of the scene; anything, by an angle

    [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& q) const { return A * (q - c) + b; }
  };
  void add_parts(const Problem& problem, const Start& start);
  void add_bodies(const System& system, const Start& start);
  /// Of nothing yet.
  [[nodiscard]] static Generator generator(const Start& start, bool turns, bool rotates);
  [[nodiscard]] Eigen::MatrixXd conditions(const Problem& problem, const Start& start, double time,
                                           int sample) const;

  std::vector<Generator> generators_;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd units_;  // of the coordinates
  Islands parts_;
};

/// An orthonormal basis of what some columns span, each of any length.
[[nodiscard]] Eigen::MatrixXd orthonormal_span(Eigen::MatrixXd columns);

}  // namespace dalembert
