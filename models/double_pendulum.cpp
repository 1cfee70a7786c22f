#include "dalembert/models/double_pendulum.h"

#include <dalembert/models/double_pendulum_equations.h>
#include <dalembert/models/minimal_ode.h>

#include <array>

namespace dalembert::models {

HangingRods DoublePendulum::scene() const {
  return hang("double-pendulum", gravity,
              std::array{RodAndBead{mass1, length1, angle1}, RodAndBead{mass2, length2, angle2}});
}

std::vector<Observation<2>> DoublePendulum::reference(std::span<const double> times) const {
  const DoublePendulumEquations<Real> equations(*this);
  const auto start = equations.start();
  std::vector<Observation<2>> seen;
  integrate(equations, State(start.begin(), start.end()), times,
            [&](const State& y) { seen.push_back(equations.observation(y)); });
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
