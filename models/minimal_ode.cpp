#include "dalembert/models/minimal_ode.h"

#include <boost/numeric/odeint.hpp>

namespace dalembert::models {

void integrate(const Equations& equations, State start, std::span<const double> times,
               const std::function<void(const State& y)>& observe, Real tolerance) {
  namespace odeint = boost::numeric::odeint;
  constexpr Real first_step = 1e-5L;  // grows up to fivefold per step, as the error allows

  std::vector<Real> at{0};
  at.insert(at.end(), times.begin(), times.end());
  bool at_start = true;
  odeint::integrate_times(
      odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<State, Real>()),
      [&](const State& y, State& y_rate, Real) { equations(y, y_rate); }, start, at.begin(), at.end(),
      first_step,
      [&](const State& y, Real) {
        if (!at_start) observe(y);
        at_start = false;
      });
}

}  // namespace dalembert::models
