#pragma once

#include <dalembert/core/results/layout.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/uniform_motion.h>
#include <dalembert/solvers/equilibrium/uniform_rotation.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// A frame that moves uniformly, on the flat coordinates: what rests in it has
///
///   v = A q + b,   v' = A v.
///
/// Of a rotation about p with the rate Omega, v = Omega x (r - p) of every particle; in the plane rotors are
/// angles about the same axis, and their v is Omega; in space they keep their angles. See UniformMotion for
/// frames in which parts turn against each other.
class RotatingFrame {
 public:
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  RotatingFrame(const Layout& layout, const UniformRotation<3>& turning);
  explicit RotatingFrame(const UniformMotion& motion);

  [[nodiscard]] bool rotates() const { return rate_ > 0.0; }
  [[nodiscard]] bool moves() const { return moves_; }
  [[nodiscard]] double rate() const { return rate_; }
  /// v = A q + b.
  void velocity(std::span<const double> q, std::span<double> v) const;
  /// out = A x.
  void apply(std::span<const double> x, std::span<double> out) const;
  /// Carries the positions q, and vectors x, on for a time.
  void carry_positions(double time, std::span<double> q) const;
  void carry_vectors(double time, std::span<double> x) const;

  [[nodiscard]] const Sparse& matrix() const { return A_; }
  [[nodiscard]] const Sparse& square() const { return square_; }

 private:
  void carry(double time, const Eigen::VectorXd& drift, std::span<double> x) const;

  double rate_;
  bool moves_;
  Sparse A_, square_;
  Eigen::VectorXd b_;
};

}  // namespace dalembert
