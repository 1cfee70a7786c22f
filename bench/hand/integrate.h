#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/bench/processor_time.h>

#include <boost/numeric/odeint.hpp>

#include <limits>

namespace dalembert::bench {

/// Integrates equations of motion derived by hand with Boost.odeint's controlled Runge-Kutta-Fehlberg 7(8).
/// `Equations` has `start()`, the state at times.front(); `operator()(y, y_rate)`; and `observation(y)`.
template <int D, class Equations>
[[nodiscard]] MethodRun<D> integrate_by_hand(Equations equations, std::span<const double> times,
                                             double tolerance) {
  namespace odeint = boost::numeric::odeint;
  using State = decltype(equations.start());
  constexpr double first_step = 0.01;  // shrinks or grows up to fivefold a step: soon right
  constexpr double none = std::numeric_limits<double>::quiet_NaN();

  MethodRun<D> run;
  run.seen.reserve(times.size());
  long evaluations = 0;
  const auto rate = [&](const State& y, State& y_rate, double) {
    ++evaluations;
    equations(y, y_rate);
  };
  State y = equations.start();
  const double begin = processor_time();
  const std::size_t steps = odeint::integrate_times(
      odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<State>()), rate, y,
      times.begin(), times.end(), first_step,
      [&](const State& now, double) { run.seen.push_back(equations.observation(now)); });
  run.statistics.run_time = processor_time() - begin;
  run.statistics.steps = static_cast<long>(steps);
  run.statistics.evaluations = evaluations;
  run.statistics.residual_position = run.statistics.residual_velocity = none;
  return run;
}

}  // namespace dalembert::bench
