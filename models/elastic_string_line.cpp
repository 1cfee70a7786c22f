#include "dalembert/models/elastic_string_line.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>

namespace dalembert::models {

BeadOnCurve ElasticStringLine::scene() const {
  const double distance = stretch * relaxed_length;
  BeadOnCurve built{.scene = Scene<2>("elastic-string-line"), .bead = {}, .curve = {}};
  built.bead = built.scene.add_particle({.mass = mass, .position = {amplitude, 0.0}});
  built.curve = built.scene.add(OnCurve{built.bead, Plane<2>{}});
  built.scene.add(ElasticString{Fixed<2>{{0.0, -distance}}, built.bead, stiffness, relaxed_length});
  return built;
}

std::vector<Observation<2>> ElasticStringLine::reference(std::span<const double> times) const {
  const Real d = Real(stretch) * relaxed_length;
  const auto pull_per_length = [&](Real x) {
    return stiffness * (1 - relaxed_length / std::sqrt(d * d + x * x));
  };
  const auto equations = [&](const State& y, State& y_rate) {  // y = (x, x')
    y_rate[0] = y[1];
    y_rate[1] = -pull_per_length(y[0]) * y[0] / mass;
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{amplitude, 0}, times, [&](const State& y) {
    seen.push_back({.positions = {vec(y[0], Real(0)).cast<double>()},
                    .forces = {static_cast<double>(pull_per_length(y[0]) * d)}});
  });
  return seen;
}

Observation<2> ElasticStringLine::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> ElasticStringLine::model() const {
  const double pull_at_rest = stiffness * relaxed_length * (stretch - 1.0);
  return {.name = "elastic-string-line",
          .notes = "mex251",
          .reference = "equation of motion of x in extended precision, force by Newton's law",
          .t_end = 10.0,
          .length = relaxed_length,
          .force = pull_at_rest,
          .energy = stiffness * relaxed_length * relaxed_length,
          .scene = [*this] { return observed(scene(), Counted::along_gradient); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
