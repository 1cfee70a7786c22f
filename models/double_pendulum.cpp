#include "dalembert/models/double_pendulum.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>

namespace dalembert::models {

namespace {

// y = (p1, p2, p1', p2')

Real upper_acceleration(const DoublePendulum& p, const State& y) {
  const Real p1 = y[0], p2 = y[1], w1 = y[2], w2 = y[3];
  const Real sine = std::sin(p1 - p2), cosine = std::cos(p1 - p2);
  return (-p.mass2 * sine * (p.length2 * w2 * w2 + p.length1 * w1 * w1 * cosine) -
          (Real(p.mass1) + p.mass2) * p.gravity * std::sin(p1) +
          p.mass2 * p.gravity * cosine * std::sin(p2)) /
         (p.length1 * (p.mass1 + p.mass2 * sine * sine));
}

Observation<2> observation(const DoublePendulum& p, const State& y) {
  const Real p1 = y[0], p2 = y[1], w1 = y[2], w2 = y[3];
  const Real d = p1 - p2;
  const Real tension2 =
      p.mass2 * (p.gravity * std::cos(p2) + p.length2 * w2 * w2 + p.length1 * w1 * w1 * std::cos(d) +
                 p.length1 * upper_acceleration(p, y) * std::sin(d));
  const Real tension1 = p.mass1 * (p.gravity * std::cos(p1) + p.length1 * w1 * w1) + tension2 * std::cos(d);
  const VecOf<Real, 2> upper = Real(p.length1) * vec(std::sin(p1), -std::cos(p1));
  const VecOf<Real, 2> lower = upper + Real(p.length2) * vec(std::sin(p2), -std::cos(p2));
  return {.positions = {upper.cast<double>(), lower.cast<double>()},
          .forces = {static_cast<double>(tension1), static_cast<double>(tension2)}};
}

}  // namespace

HangingRods DoublePendulum::scene() const {
  return hang("double-pendulum", gravity,
              std::array{RodAndBead{mass1, length1, angle1}, RodAndBead{mass2, length2, angle2}});
}

std::vector<Observation<2>> DoublePendulum::reference(std::span<const double> times) const {
  const auto equations = [this](const State& y, State& y_rate) {
    const Real p1 = y[0], p2 = y[1], w1 = y[2], w2 = y[3], d = p1 - p2;
    const Real upper = upper_acceleration(*this, y);
    const Real lower =
        (length1 * (w1 * w1 * std::sin(d) - upper * std::cos(d)) - gravity * std::sin(p2)) / length2;
    y_rate[0] = w1;
    y_rate[1] = w2;
    y_rate[2] = upper;
    y_rate[3] = lower;
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{angle1, angle2, 0, 0}, times,
            [&](const State& y) { seen.push_back(observation(*this, y)); });
  return seen;
}

Observation<2> DoublePendulum::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> DoublePendulum::model() const {
  return {.name = "double-pendulum",
          .notes = "mex20",
          .reference = "Lagrange's equations in extended precision, force by Newton's law",
          .t_end = 5.0,
          .length = length1,
          .force = (mass1 + mass2) * gravity,
          .energy = (mass1 + mass2) * gravity * length1 + mass2 * gravity * length2,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
