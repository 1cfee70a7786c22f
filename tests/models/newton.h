#pragma once

#include <dalembert/models/model.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

/// Checks of a hand derivation against its own positions, differentiated numerically: energy and the
/// forces of constraint by Newton's law Z = m (a - g). No code of the solver takes part.
namespace dalembert::models {

/// A number and a bound on its error.
template <class T>
struct Bounded {
  T value;
  double error;
};

/// Positions of one point at t + i h, i = -8 ... 8, and what follows from them by central
/// differences of order 8. Each is formed with the steps h and 2 h: where the difference converges, the
/// truncation error of the first is 1/255 of how much the two differ, so that this difference
/// bounds it with two digits to spare. To this comes round-off: half a unit in the last place of each
/// position, times the sum of the coefficients' magnitudes (2.3 for the first, 6.5 for the second
/// derivative), doubled for the errors of the positions themselves.
template <int D>
class Stencil {
 public:
  static constexpr int reach = 8;

  Stencil(const Model<D>& model, double t, double h, std::size_t point) : h_(h) {
    for (int i = -reach; i <= reach; ++i) times_[static_cast<std::size_t>(i + reach)] = t + i * h;
    const auto seen = model.observations(times_);
    for (std::size_t i = 0; i < times_.size(); ++i) r_[i] = seen[i].positions[point];
  }

  [[nodiscard]] Vec<D> position() const { return r_[reach]; }
  [[nodiscard]] Bounded<Vec<D>> velocity() const {
    return bounded(first(1), first(2), 2 * 2.3 * rounding() / h_);
  }
  [[nodiscard]] Bounded<Vec<D>> acceleration() const {
    return bounded(second(1), second(2), 2 * 6.5 * rounding() / (h_ * h_));
  }

 private:
  [[nodiscard]] const Vec<D>& at(int i) const { return r_[static_cast<std::size_t>(i + reach)]; }
  [[nodiscard]] double rounding() const {
    return 0.5 * std::numeric_limits<double>::epsilon() * std::max(1.0, position().norm());
  }
  [[nodiscard]] static Bounded<Vec<D>> bounded(const Vec<D>& fine, const Vec<D>& coarse, double rounding) {
    return {fine, (fine - coarse).norm() + rounding};
  }
  [[nodiscard]] Vec<D> first(int s) const {
    constexpr std::array c{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    Vec<D> sum = Vec<D>::Zero();
    for (int i = 1; i <= 4; ++i) sum += c[static_cast<std::size_t>(i - 1)] * (at(i * s) - at(-i * s));
    return sum / (s * h_);
  }
  [[nodiscard]] Vec<D> second(int s) const {
    constexpr std::array c{8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};
    Vec<D> sum = -205.0 / 72 * at(0);
    for (int i = 1; i <= 4; ++i) sum += c[static_cast<std::size_t>(i - 1)] * (at(i * s) + at(-i * s));
    return sum / (s * s * h_ * h_);
  }

  double h_;
  std::array<double, 2 * reach + 1> times_{};
  std::array<Vec<D>, 2 * reach + 1> r_;
};

/// Gravity of the models: along the last axis, downwards.
template <int D>
[[nodiscard]] Vec<D> downwards(double gravity) {
  return -gravity * Vec<D>::Unit(D - 1);
}

/// The force of constraint on one point, m (a - g), from its differentiated positions.
template <int D>
[[nodiscard]] Bounded<Vec<D>> force_by_newton(const Stencil<D>& point, double mass, double gravity) {
  const auto a = point.acceleration();
  return {mass * (a.value - downwards<D>(gravity)), mass * a.error};
}

/// Kinetic and potential energy of one point.
template <int D>
[[nodiscard]] Bounded<double> energy(const Stencil<D>& point, double mass, double gravity) {
  const auto v = point.velocity();
  return {mass * (0.5 * v.value.squaredNorm() - downwards<D>(gravity).dot(point.position())),
          mass * v.error * (v.value.norm() + v.error)};
}

}  // namespace dalembert::models
