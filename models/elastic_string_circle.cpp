#include "dalembert/models/elastic_string_circle.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>

namespace dalembert::models {

double ElasticStringCircle::distance() const {
  const double b = stretch * relaxed_length;
  return tied == Tied::outside ? radius + b : radius - b;
}

BeadOnCurve ElasticStringCircle::scene() const {
  BeadOnCurve built{.scene = Scene<2>("elastic-string-circle"), .bead = {}, .curve = {}};
  built.bead =
      built.scene.add_particle({.mass = mass, .position = radius * Vec<2>(std::cos(angle), std::sin(angle))});
  built.curve = built.scene.add(OnCurve{built.bead, Sphere<2>{.radius = radius}});
  built.scene.add(ElasticString{Fixed<2>{{distance(), 0.0}}, built.bead, stiffness, relaxed_length});
  return built;
}

std::vector<Observation<2>> ElasticStringCircle::reference(std::span<const double> times) const {
  const Real r = radius, d = distance();
  const auto pull_per_length = [&](Real theta) {
    return stiffness * (1 - relaxed_length / std::sqrt(r * r + d * d - 2 * r * d * std::cos(theta)));
  };
  const auto equations = [&](const State& y, State& y_rate) {  // y = (theta, theta')
    y_rate[0] = y[1];
    y_rate[1] = -pull_per_length(y[0]) * d * std::sin(y[0]) / (mass * r);
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{angle, 0}, times, [&](const State& y) {
    const Real theta = y[0], rate = y[1], cosine = std::cos(theta);
    const Real outwards = pull_per_length(theta) * (r - d * cosine) - mass * r * rate * rate;
    seen.push_back({.positions = {vec(r * cosine, r * std::sin(theta)).cast<double>()},
                    .forces = {static_cast<double>(outwards)}});
  });
  return seen;
}

Observation<2> ElasticStringCircle::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> ElasticStringCircle::model() const {
  const double pull_at_rest = stiffness * relaxed_length * (stretch - 1.0);
  return {.name = "elastic-string-circle",
          .notes = "mex251",
          .reference = "equation of motion of the angle in extended precision, force by Newton's law",
          .t_end = 10.0,
          .length = radius,
          .force = pull_at_rest,
          .energy = stiffness * relaxed_length * relaxed_length,
          .scene = [*this] { return observed(scene(), Counted::along_gradient); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
