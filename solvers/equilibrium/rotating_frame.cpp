#include "dalembert/solvers/equilibrium/rotating_frame.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dalembert {

RotatingFrame::RotatingFrame(const Layout& layout, const Turning<3>& turning)
    : dimension_(static_cast<std::size_t>(layout.dimension)),
      first_(layout.particles.size() * dimension_ + layout.rotors.size(), none),
      rate_(turning.rate.norm()),
      axis_(rate_ > 0.0 ? Eigen::Vector3d(turning.rate / rate_) : Eigen::Vector3d::UnitZ()),
      centre_(turning.centre) {
  for (const Layout::Particle& particle : layout.particles) {
    const auto first = static_cast<std::size_t>(particle.coordinate);
    particles_.push_back(first);
    std::fill_n(first_.begin() + particle.coordinate, dimension_, first);
  }
  for (const Layout::Rotor& rotor : layout.rotors)
    rotors_.push_back(static_cast<std::size_t>(rotor.coordinate));
  const Vec<3>& w = turning.rate;
  cross_ << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  square_ = cross_ * cross_;
}

/// out = m (x - about) + to for every particle; rotors are left as they are.
void RotatingFrame::transform(const Eigen::Matrix3d& m, const Eigen::Vector3d& about,
                              std::span<const double> x, std::span<double> out,
                              const Eigen::Vector3d& to) const {
  const auto d = static_cast<Eigen::Index>(dimension_);
  for (const std::size_t first : particles_) {
    const Eigen::VectorXd r = Eigen::Map<const Eigen::VectorXd>(x.data() + first, d) - about.head(d);
    Eigen::Map<Eigen::VectorXd>(out.data() + first, d) = m.topLeftCorner(d, d) * r + to.head(d);
  }
}

void RotatingFrame::velocity(std::span<const double> q, std::span<double> v) const {
  std::ranges::fill(v, 0.0);
  if (!rotates()) return;
  transform(cross_, centre_, q, v, Eigen::Vector3d::Zero());
  if (dimension_ == 2)
    for (const std::size_t rotor : rotors_) v[rotor] = rate_ * axis_.z();
}

void RotatingFrame::apply(std::span<const double> x, std::span<double> out) const {
  std::ranges::fill(out, 0.0);
  if (rotates()) transform(cross_, Eigen::Vector3d::Zero(), x, out, Eigen::Vector3d::Zero());
}

void RotatingFrame::rotate_positions(double angle, std::span<double> q) const {
  transform(Eigen::AngleAxisd(angle, axis_).toRotationMatrix(), centre_, q, q, centre_);
  if (dimension_ == 2)
    for (const std::size_t rotor : rotors_) q[rotor] += angle * axis_.z();
}

void RotatingFrame::rotate_vectors(double angle, std::span<double> x) const {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  transform(Eigen::AngleAxisd(angle, axis_).toRotationMatrix(), zero, x, x, zero);
}

}  // namespace dalembert
