#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/erk_state.h>

#include <cmath>

namespace dalembert {

namespace {

/// Steps of h rho beyond this are limited by stability: |R(iy)| exceeds 1 by a thousandth at
/// y = 3.3, by a twentieth at 4.4, and |R(-x)| exceeds 1 at x = 5.9 (from the table of the pair).
constexpr double stable = 3.3;

}  // namespace

/// The weight of an error in each position and velocity against the tolerance at a state.
void ErkStepper::State::weigh(const Node& at) {
  for (std::size_t i = 0; i < n; ++i) {
    weight[i] = 1.0 / scales.position_error(i, at.q[i], tolerance);
    weight[n + i] = 1.0 / scales.velocity_error(i, at.va[i], tolerance);
  }
}

/// Weighted root mean square of `difference`.
double ErkStepper::State::size() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < difference.size(); ++i) {
    const double e = difference[i] * weight[i];
    sum += e * e;
  }
  return std::sqrt(sum / static_cast<double>(difference.size()));
}

/// The estimated error of a step to `next` over the tolerance.
double ErkStepper::State::error(double step) {
  if (scales.of_path) scales.take(scales.further(next.q, halves(next.va).first, step, tolerance));
  weigh(next);
  d.apply(step, k, difference.data(), 2 * n);
  return std::max(size(), error_of_springs(std::span(difference).first(n)));
}

/// A compliant constraint multiplies errors of position by its stiffness: its force w dq/C is to be as
/// accurate, relative to the force that moves its masses by the scene's length in the scene's time; up to
/// round-off.
double ErkStepper::State::error_of_springs(std::span<const double> dq) const {
  if (force_of_spring.empty()) return 0.0;
  const double rounding = scales.rounding(next.q);
  double most = 0.0;
  for (std::size_t r = 0; r < force_of_spring.size(); ++r) {
    if (force_of_spring[r] == 0.0) continue;
    double stretch = 0.0, gradient = 0.0;
    for (const std::size_t j : system->row(r)) {
      stretch += manifold.equations().w[j] * dq[system->w_columns()[j]];
      gradient = std::max(gradient, std::abs(manifold.equations().w[j]));
    }
    const double allowed = system->law(r).compliance * tolerance * force_of_spring[r] + gradient * rounding;
    most = std::max(most, std::abs(stretch) / allowed);
  }
  return most;
}

/// Projects `next` onto the constraint manifold. Returns the correction over the tolerance.
double ErkStepper::State::project() {
  const auto [dq, dv] = halves(difference);
  const auto [v, v_dot] = halves(next.va);
  for (std::size_t i = 0; i < n; ++i) {
    dq[i] = -next.q[i];
    dv[i] = -v[i];
  }
  require(manifold.project(next.t, next.q, v, v_dot));
  for (std::size_t i = 0; i < n; ++i) {
    dq[i] += next.q[i];
    dv[i] += v[i];
  }
  return size();
}

/// The difference of the derivatives of the last stage and of those at the end of a step, times the step, as
/// a fraction of the scene's size.
double ErkStepper::State::disagreement(double step) {
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = step * (k[stages - 1][i] - next.va[i]);
  return tolerance * size();
}

/// The last two stages lie at the same time; the ratio of their derivatives' difference to their
/// own is the largest rate rho that the step has excited (Hairer, Wanner, Solving ODEs II, IV.2).
void ErkStepper::State::watch_stability(double step) {
  const double T2 = scales.time * scales.time;
  double rates = 0.0, states = 0.0;
  last_difference.apply(step, k, stage_q.data(), n);
  for (std::size_t i = 0; i < n; ++i) {
    const double dv = k[stages - 1][i] - k[stages - 2][i];
    const double da = k[stages - 1][n + i] - k[stages - 2][n + i];
    rates += dv * dv + T2 * da * da;
    states += stage_q[i] * stage_q[i] + T2 * dv * dv;
  }
  const double round_off = 100.0 * epsilon * scales.length;
  if (states > round_off * round_off && step * step * rates > stable * stable * states) {
    stability_limited += stability_check_interval;
  }
}

}  // namespace dalembert
