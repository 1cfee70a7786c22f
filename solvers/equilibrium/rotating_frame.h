#pragma once

#include <dalembert/core/results/layout.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/turning.h>

#include <Eigen/Core>

#include <limits>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A uniformly rotating frame on the flat coordinates: with Omega its rate and p its centre every particle at
/// rest in it has
///
///   r' = Omega x (r - p),    or for all together   v = A (q - p),   v' = A v,
///
/// A is block-diagonal and skew, zero for rotors. In the plane rotors are angles about the same axis, and
/// their v is Omega; in space they keep their angles.
class RotatingFrame {
 public:
  RotatingFrame(const Layout& layout, const Turning<3>& turning);

  [[nodiscard]] bool rotates() const { return rate_ > 0.0; }
  [[nodiscard]] double rate() const { return rate_; }
  /// v = A (q - p).
  void velocity(std::span<const double> q, std::span<double> v) const;
  /// out = A x.
  void apply(std::span<const double> x, std::span<double> out) const;
  /// Rotates the positions q, and vectors x, by an angle.
  void rotate_positions(double angle, std::span<double> q) const;
  void rotate_vectors(double angle, std::span<double> x) const;

  /// Coordinates of a particle begin at `first(i)` for each i of them; `none` for a rotor.
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  [[nodiscard]] std::size_t first(std::size_t i) const { return first_[i]; }
  [[nodiscard]] std::size_t dimension() const { return dimension_; }
  /// A block of A, of a particle's coordinates, and of A^2.
  [[nodiscard]] double entry(std::size_t i, std::size_t k) const { return at(cross_, i, k); }
  [[nodiscard]] double square_entry(std::size_t i, std::size_t k) const { return at(square_, i, k); }

 private:
  [[nodiscard]] static double at(const Eigen::Matrix3d& m, std::size_t i, std::size_t k) {
    return m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  }
  void transform(const Eigen::Matrix3d& m, const Eigen::Vector3d& about, std::span<const double> x,
                 std::span<double> out, const Eigen::Vector3d& to) const;

  std::size_t dimension_;
  std::vector<std::size_t> first_, particles_, rotors_;
  double rate_;
  Eigen::Vector3d axis_, centre_;
  Eigen::Matrix3d cross_, square_;
};

}  // namespace dalembert
