#include "dalembert/models/chain.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace dalembert::models {

namespace {

constexpr double horizontal = std::numbers::pi / 2;

/// The equations of the chain and the room they need; the state is p_1 ... p_N, p_1' ... p_N'.
class ChainEquations {
 public:
  explicit ChainEquations(const Chain& chain)
      : n_(static_cast<std::size_t>(chain.beads)),
        l_(Real(chain.length) / chain.beads),
        m_(Real(chain.mass) / chain.beads),
        g_(chain.gravity),
        sine_(n_),
        cosine_(n_),
        c_(n_),
        s_(n_),
        tau_(n_),
        pivot_(n_) {}

  [[nodiscard]] State start() const {
    State y(2 * n_, 0);
    std::fill_n(y.begin(), n_, Real(horizontal));
    return y;
  }

  void operator()(const State& y, State& y_rate) {
    find_tensions(y);
    for (std::size_t i = 0; i < n_; ++i) {
      Real across = i == 0 ? -g_ * sine_[0] : -s_[i - 1] * tau_[i - 1];
      if (i + 1 < n_) across += s_[i] * tau_[i + 1];
      y_rate[i] = y[n_ + i];
      y_rate[n_ + i] = across / l_;
    }
  }

  [[nodiscard]] Observation<2> observation(const State& y) {
    find_tensions(y);
    Observation<2> seen;
    VecOf<Real, 2> position(0, 0);
    for (std::size_t i = 0; i < n_; ++i) {
      position += l_ * vec(sine_[i], -cosine_[i]);
      seen.positions.push_back(position.cast<double>());
      seen.forces.push_back(static_cast<double>(m_ * tau_[i]));
    }
    return seen;
  }

 private:
  /// Leaves tau in tau_, by elimination without exchanges: the matrix is positive definite.
  void find_tensions(const State& y) {
    directions(y);
    for (std::size_t i = 0; i < n_; ++i) {
      const Real rate = y[n_ + i];
      tau_[i] = l_ * rate * rate;
      if (i == 0) {
        pivot_[0] = 1;
        tau_[0] += g_ * cosine_[0];
      } else {
        const Real factor = c_[i - 1] / pivot_[i - 1];
        pivot_[i] = 2 - factor * c_[i - 1];
        tau_[i] += factor * tau_[i - 1];
      }
    }
    tau_[n_ - 1] /= pivot_[n_ - 1];
    for (std::size_t i = n_ - 1; i-- > 0;) tau_[i] = (tau_[i] + c_[i] * tau_[i + 1]) / pivot_[i];
  }

  void directions(const State& y) {
    for (std::size_t i = 0; i < n_; ++i) {
      const Real angle = y[i];
      sine_[i] = std::sin(angle);
      cosine_[i] = std::cos(angle);
    }
    for (std::size_t i = 0; i + 1 < n_; ++i) {
      c_[i] = cosine_[i] * cosine_[i + 1] + sine_[i] * sine_[i + 1];
      s_[i] = cosine_[i] * sine_[i + 1] - sine_[i] * cosine_[i + 1];
    }
  }

  std::size_t n_;
  Real l_, m_, g_;
  std::vector<Real> sine_, cosine_;  // of p_i
  std::vector<Real> c_, s_, tau_, pivot_;
};

}  // namespace

HangingRods Chain::scene() const {
  const auto n = static_cast<std::size_t>(beads);
  return hang("chain", gravity, std::vector(n, RodAndBead{mass / beads, length / beads, horizontal}));
}

std::vector<Observation<2>> Chain::reference(std::span<const double> times, Real tolerance) const {
  ChainEquations equations(*this);
  std::vector<Observation<2>> seen;
  integrate(
      std::ref(equations), equations.start(), times,
      [&](const State& y) { seen.push_back(equations.observation(y)); }, tolerance);
  return seen;
}

Observation<2> Chain::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> Chain::model() const {
  return {.name = "chain",
          .notes = "-",
          .reference = "angles of the rods in extended precision, tensions by Newton's law in O(N)",
          .t_end = 1.0,
          .length = length,
          .force = mass * gravity,
          .energy = mass * gravity * length,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
