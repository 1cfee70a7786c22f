#include "dalembert/bench/hand/chain.h"

#include <Eigen/Core>

namespace dalembert::bench {

CartesianChain::CartesianChain(const models::Chain& chain)
    : n_(static_cast<std::size_t>(chain.beads)),
      link_(chain.length / chain.beads),
      bead_(chain.mass / chain.beads),
      gravity_(0.0, -chain.gravity),
      rods_(n_) {}

std::vector<double> CartesianChain::start() const {
  std::vector<double> y(4 * n_, 0.0);
  for (std::size_t i = 0; i < n_; ++i) y[2 * i] = static_cast<double>(i + 1) * link_;
  return y;
}

void CartesianChain::operator()(const std::vector<double>& y, std::vector<double>& y_rate) {
  find_tensions(y);
  Vec<2> above = rods_[0].s * rods_[0].d;
  for (std::size_t i = 0; i < n_; ++i) {
    const Vec<2> below = i + 1 < n_ ? Vec<2>(rods_[i + 1].s * rods_[i + 1].d) : Vec<2>::Zero();
    const Vec<2> a = gravity_ + below - above;
    above = below;
    for (std::size_t k : {0U, 1U}) {
      y_rate[2 * i + k] = y[2 * (n_ + i) + k];
      y_rate[2 * (n_ + i) + k] = a[static_cast<int>(k)];
    }
  }
}

models::Observation<2> CartesianChain::observation(const std::vector<double>& y) {
  find_tensions(y);
  models::Observation<2> seen;
  for (std::size_t i = 0; i < n_; ++i) {
    seen.positions.emplace_back(y[2 * i], y[2 * i + 1]);
    seen.forces.push_back(bead_ * rods_[i].s * rods_[i].d.norm());
  }
  return seen;
}

void CartesianChain::find_tensions(const std::vector<double>& y) {
  const auto vector = [&](std::size_t k) { return Vec<2>::from(y.data() + 2 * k); };
  for (std::size_t i = 0; i < n_; ++i) {
    Rod& rod = rods_[i];
    if (i == 0) {
      rod.d = vector(0);
      rod.s = vector(n_).squaredNorm() + gravity_.dot(rod.d);
      rod.pivot = 1.0 / rod.d.squaredNorm();
      continue;
    }
    Rod& last = rods_[i - 1];
    rod.d = vector(i) - vector(i - 1);
    last.next = last.d.dot(rod.d);
    const double factor = last.next * last.pivot;
    rod.pivot = 1.0 / (2.0 * rod.d.squaredNorm() - factor * last.next);
    rod.s = (vector(n_ + i) - vector(n_ + i - 1)).squaredNorm() + factor * last.s;
  }
  rods_[n_ - 1].s *= rods_[n_ - 1].pivot;
  for (std::size_t i = n_ - 1; i-- > 0;)
    rods_[i].s = (rods_[i].s + rods_[i].next * rods_[i + 1].s) * rods_[i].pivot;
}

}  // namespace dalembert::bench
