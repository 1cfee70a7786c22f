#include "dalembert/solvers/equilibrium/undecayed_motions.h"

#include <dalembert/solvers/equilibrium/quadratic_modes.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;

/// M + rho D with the symmetric part D of the damping, and the rows that are active.
TangentMatrix with_damping(const System& system, const LinearTerms& terms, const ActiveRows& rows) {
  constexpr double strong = 1e12;
  LinearTerms damping{{}, {}, terms.w, {}};
  double most = 0.0;
  for (const auto& d : terms.damping)
    most =
        std::max(most, std::abs(d.value()) / std::sqrt(system.masses()[d.row()] * system.masses()[d.col()]));
  for (const auto& d : terms.damping)
    for (const auto& [i, j] : {std::pair(d.row(), d.col()), std::pair(d.col(), d.row())})
      damping.stiffness.emplace_back(static_cast<int>(i), static_cast<int>(j),
                                     most > 0.0 ? 0.5 * strong / most * d.value() : 0.0);
  return {system, rows, damping, 1.0};
}

}  // namespace

UndecayedMotions::UndecayedMotions(const System& system, const Islands& parts, const Scales& scales)
    : system_(&system),
      parts_(&parts),
      time_(scales.time),
      units_(static_cast<Index>(system.coordinates())),
      modes_(parts.count) {
  for (Index i = 0; i < units_.size(); ++i) units_[i] = scales.unit(static_cast<std::size_t>(i));
}

std::size_t UndecayedMotions::most() const {
  std::size_t most = 0;
  for (const auto& own : modes_) most = std::max(most, own.size());
  return most;
}

Disturbance UndecayedMotions::nothing() const {
  return {Vector::Zero(units_.size()), Vector::Zero(units_.size())};
}

/// What does not vibrate moves by its size in the scene's time.
void UndecayedMotions::add(const Mode& mode, double phase, double part, Disturbance& to) const {
  const double omega = mode.eigenvalue.imag() != 0.0 ? std::abs(mode.eigenvalue.imag()) : 1.0 / time_;
  double size = 0.0;
  for (Index i = 0; i < units_.size(); ++i)
    size = std::max(size, std::abs(mode.shape[static_cast<std::size_t>(i)]) / units_[i]);
  for (Index i = 0; i < units_.size(); ++i) {
    const auto x = part / size * mode.shape[static_cast<std::size_t>(i)] * std::polar(1.0, phase);
    to.shift[i] += x.real();
    to.rate[i] -= omega * x.imag();
  }
}

Disturbance UndecayedMotions::alone(std::size_t k, double phase) const {
  Disturbance d = nothing();
  for (const auto& own : modes_)
    if (k < own.size()) add(*own[k], phase, 1.0, d);
  return d;
}

Disturbance UndecayedMotions::together(int number) const {
  Disturbance d = nothing();
  for (const auto& own : modes_)
    for (std::size_t k = 0; k < own.size(); ++k)
      add(*own[k], number * std::sqrt(2.0 + static_cast<double>(k)), 1.0 / static_cast<double>(own.size()),
          d);
  return d;
}

/// (M + rho D) x = M r + W^T y, W x = 0 leaves of r what D does not resist: after three times to 1e-12 where
/// it is more than 1e-8 of its largest.
Disturbance UndecayedMotions::undamped(const LinearTerms& terms, const ActiveRows& rows,
                                       unsigned number) const {
  constexpr double spread = 10.0;  // of the logarithm of the sizes of coordinates
  const Index n = units_.size();
  TangentMatrix matrix = with_damping(*system_, terms, rows);
  if (!matrix.regular()) return nothing();
  const auto shape = [&](unsigned seed) {
    const Vector size = (spread * generic_vector(n, seed + 1).array()).exp();
    Vector x = generic_vector(n, seed).cwiseProduct(size).cwiseProduct(units_);
    std::vector<double> y(system_->coordinates() + rows.size());
    for (int times = 0; times < 3; ++times) {
      std::ranges::fill(y, 0.0);
      for (std::size_t i = 0; i < system_->coordinates(); ++i)
        y[i] = system_->masses()[i] * x[static_cast<Index>(i)];
      matrix.solve(y);
      x = Eigen::Map<const Vector>(y.data(), n);
    }
    return of_size_1(std::move(x));
  };
  return {shape(4 * number), shape(4 * number + 2) / time_};
}

std::vector<double> UndecayedMotions::sizes(const Vector& x) const {
  std::vector<double> most(parts_->count, 0.0);
  for (Index i = 0; i < x.size(); ++i) {
    double& own = most[parts_->of_coordinate[static_cast<std::size_t>(i)]];
    own = std::max(own, std::abs(x[i]) / units_[i]);
  }
  return most;
}

Vector UndecayedMotions::of_size_1(Vector x) const {
  const auto most = sizes(x);
  for (Index i = 0; i < x.size(); ++i) {
    const double own = most[parts_->of_coordinate[static_cast<std::size_t>(i)]];
    x[i] = own > 0.0 ? x[i] / own : 0.0;
  }
  return x;
}

}  // namespace dalembert
