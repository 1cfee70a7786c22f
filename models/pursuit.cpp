#include "dalembert/models/pursuit.h"

#include <dalembert/models/minimal_ode.h>

#include <cmath>
#include <limits>
#include <utility>

namespace dalembert::models {

namespace {

/// Y at time t by bisection: t(Y) falls from the time of capture at 0 to 0 at 1.
Real height_at(const PursuitCurve& p, Real t) {
  const Real k = Real(p.prey_speed) / p.pursuer_speed;
  const auto time = [&](Real Y) {
    const Real far = (1 - std::pow(Y, 1 + k)) / (1 + k), near = (1 - std::pow(Y, 1 - k)) / (1 - k);
    return p.height / (2 * Real(p.pursuer_speed)) * (far + near);
  };
  Real low = 0, high = 1;
  while (high - low > std::numeric_limits<Real>::epsilon() * high) {
    const Real middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (time(middle) > t ? low : high) = middle;
  }
  return high;
}

}  // namespace

Chase PursuitCurve::scene() const {
  Chase built{.scene = Scene<2>("pursuit"), .pursuer = {}, .aim = {}};
  built.pursuer =
      built.scene.add_particle({.mass = mass, .position = {0.0, height}, .velocity = {0.0, -pursuer_speed}});
  const auto prey = driven([u = prey_speed](auto t) { return vec(u * t, 0.0); });
  built.aim = built.scene.add(Pursuit{built.pursuer, prey});
  return built;
}

double PursuitCurve::capture_time() const {
  const double u = prey_speed, v = pursuer_speed;
  return height * v / ((v - u) * (v + u));
}

Observation<2> PursuitCurve::reference(double t) const {
  const Real h = height, u = prey_speed, v = pursuer_speed, k = u / v;
  const Real Y = height_at(*this, t), y = h * Y;
  const Real x = h / 2 * (std::pow(Y, 1 + k) / (1 + k) - std::pow(Y, 1 - k) / (1 - k)) + k * h / (1 - k * k);
  const Real rho = y * std::cosh(k * std::log(Y));
  return {.positions = {vec(x, y).cast<double>()},
          .forces = {static_cast<double>(mass * v * u * y / (rho * rho))}};
}

Model<2> PursuitCurve::model() const {
  const double energy = 0.5 * mass * pursuer_speed * pursuer_speed;
  return {.name = "pursuit",
          .notes = "mex235",
          .reference = "closed form of path and time in the height",
          .t_end = part_compared * capture_time(),
          .length = height,
          .force = 2.0 * energy / height,
          .energy = energy,
          .scene =
              [*this] {
                Chase built = scene();
                return Observed<2>{std::move(built.scene),
                                   [pursuer = built.pursuer, aim = built.aim](const Sample<2>& sample) {
                                     return Observation<2>{.positions = {sample.position(pursuer)},
                                                           .forces = {sample.multiplier(aim)}};
                                   }};
              },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
