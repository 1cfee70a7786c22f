#include "dalembert/tests/extremes/cases/chain_of_masses.h"

#include <dalembert/models/minimal_ode.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>
#include <numeric>

namespace dalembert::extremes {

namespace {

using models::Observation;
using models::Real;
using models::State;

/// Tensions and angular accelerations at y = (p_1, ..., p_1', ...).
class Forces {
 public:
  explicit Forces(const ChainOfMasses& chain)
      : chain_(chain), n_(chain.masses.size()), diagonal_(n_), right_(n_), tension_(n_) {}

  const std::vector<Real>& tensions(const State& y) {
    for (std::size_t i = 0; i < n_; ++i) {
      diagonal_[i] = 1 / mass(i) + (i > 0 ? 1 / mass(i - 1) : 0);
      right_[i] = chain_.link * y[n_ + i] * y[n_ + i] + (i == 0 ? Real(g) * std::cos(y[0]) : 0);
      if (i == 0) continue;
      const Real beside = -std::cos(y[i] - y[i - 1]) / mass(i - 1), factor = beside / diagonal_[i - 1];
      diagonal_[i] -= factor * beside;
      right_[i] -= factor * right_[i - 1];
    }
    for (std::size_t i = n_; i-- > 0;) {
      const Real beyond = i + 1 < n_ ? std::cos(y[i + 1] - y[i]) / mass(i) * tension_[i + 1] : 0;
      tension_[i] = (right_[i] + beyond) / diagonal_[i];
    }
    return tension_;
  }

  void rates(const State& y, State& rate) {
    tensions(y);
    for (std::size_t i = 0; i < n_; ++i) {
      Real turning = i == 0 ? -Real(g) * std::sin(y[0]) : 0;
      if (i + 1 < n_) turning += std::sin(y[i + 1] - y[i]) * tension_[i + 1] / mass(i);
      if (i > 0) turning -= std::sin(y[i] - y[i - 1]) * tension_[i - 1] / mass(i - 1);
      rate[i] = y[n_ + i];
      rate[n_ + i] = turning / chain_.link;
    }
  }

 private:
  [[nodiscard]] Real mass(std::size_t i) const { return chain_.masses[i]; }

  const ChainOfMasses& chain_;
  std::size_t n_;
  std::vector<Real> diagonal_, right_, tension_;
};

}  // namespace

ChainOfMasses ChainOfMasses::heavy_at_the_end(int links, double ratio) {
  ChainOfMasses chain{.masses = std::vector<double>(static_cast<std::size_t>(links), 1.0),
                      .link = 1.0 / links};
  chain.masses.back() = ratio;
  return chain;
}

models::Model<2> ChainOfMasses::model() const {
  const double weight = g * std::accumulate(masses.begin(), masses.end(), 0.0);
  const double length = link * static_cast<double>(masses.size());
  return {.name = "chain-of-masses",
          .notes = "",
          .reference = "",
          .t_end = 0.0,
          .length = length,
          .force = weight,
          .energy = weight * length,
          .scene =
              [*this] {
                std::vector<models::RodAndBead> rods;
                for (const double mass : masses) rods.push_back({mass, link, angle});
                return models::observed(models::hang("chain-of-masses", g, rods));
              },
          .observations =
              [*this](std::span<const double> times) {
                const std::size_t n = masses.size();
                State start(2 * n, 0);
                std::fill_n(start.begin(), n, Real(angle));
                Forces forces(*this);
                std::vector<Observation<2>> seen;
                models::integrate([&](const State& y, State& rate) { forces.rates(y, rate); }, start, times,
                                  [&](const State& y) {
                                    Observation<2> at;
                                    VecOf<Real, 2> r = VecOf<Real, 2>::Zero();
                                    const auto& tensions = forces.tensions(y);
                                    for (std::size_t i = 0; i < n; ++i) {
                                      r += Real(link) * vec(std::sin(y[i]), -std::cos(y[i]));
                                      at.positions.push_back(r.cast<double>());
                                      at.forces.push_back(static_cast<double>(tensions[i]));
                                    }
                                    seen.push_back(std::move(at));
                                  });
                return seen;
              }};
}

}  // namespace dalembert::extremes
