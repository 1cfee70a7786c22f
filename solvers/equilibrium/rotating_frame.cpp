#include "dalembert/solvers/equilibrium/rotating_frame.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using ConstFlat = Eigen::Map<const Eigen::VectorXd>;
using Flat = Eigen::Map<Eigen::VectorXd>;

Index size_of(std::span<const double> x) { return static_cast<Index>(x.size()); }

UniformMotion motion_of(const Layout& layout, const UniformRotation<3>& turning) {
  const auto n = static_cast<Index>(layout.particles.size() * static_cast<std::size_t>(layout.dimension) +
                                    layout.rotors.size());
  UniformMotion motion{{n, n}, Eigen::VectorXd::Zero(n), turning.rate.norm()};
  if (motion.rate == 0.0) return motion;
  const Vec<3>& w = turning.rate;
  Eigen::Matrix3d cross;
  cross << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  const Eigen::Vector3d drift = -(cross * turning.centre);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Layout::Particle& particle : layout.particles) {
    for (int i = 0; i < layout.dimension; ++i) {
      motion.b[particle.coordinate + i] = drift[i];
      for (int k = 0; k < layout.dimension; ++k)
        if (i != k) entries.emplace_back(particle.coordinate + i, particle.coordinate + k, cross(i, k));
    }
  }
  if (layout.dimension == 2)
    for (const Layout::Rotor& rotor : layout.rotors) motion.b[rotor.coordinate] = w.z();
  motion.A.setFromTriplets(entries.begin(), entries.end());
  return motion;
}

}  // namespace

RotatingFrame::RotatingFrame(const Layout& layout, const UniformRotation<3>& turning)
    : RotatingFrame(motion_of(layout, turning)) {}

RotatingFrame::RotatingFrame(const UniformMotion& motion)
    : rate_(motion.rate),
      moves_(motion.A.nonZeros() > 0 || !motion.b.isZero(0.0)),
      A_(motion.A),
      square_(motion.A * motion.A),
      b_(motion.b) {}

void RotatingFrame::velocity(std::span<const double> q, std::span<double> v) const {
  Flat(v.data(), size_of(v)) = A_ * ConstFlat(q.data(), size_of(q)) + b_;
}

void RotatingFrame::apply(std::span<const double> x, std::span<double> out) const {
  Flat(out.data(), size_of(out)) = A_ * ConstFlat(x.data(), size_of(x));
}

/// x' = A x + drift by its Taylor series, in steps of at most a radian: the terms left are below round-off.
void RotatingFrame::carry(double time, const Eigen::VectorXd& drift, std::span<double> x) const {
  constexpr int terms = 20;
  double size = 0.0;
  for (Index i = 0; i < A_.outerSize(); ++i) size = std::max(size, A_.row(i).cwiseAbs().sum());
  const double steps = std::max(1.0, std::ceil(std::abs(time) * size)), h = time / steps;
  Flat all(x.data(), size_of(x));
  for (double step = 0.0; step < steps; ++step) {
    Eigen::VectorXd term = h * (A_ * all + drift);
    for (int k = 2; k <= terms; ++k) {
      all += term;
      term = (h / k) * (A_ * term).eval();
    }
  }
}

void RotatingFrame::carry_positions(double time, std::span<double> q) const { carry(time, b_, q); }

void RotatingFrame::carry_vectors(double time, std::span<double> x) const {
  carry(time, Eigen::VectorXd::Zero(size_of(x)), x);
}

}  // namespace dalembert
