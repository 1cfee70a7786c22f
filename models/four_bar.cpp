#include "dalembert/models/four_bar.h"

#include <dalembert/models/minimal_ode.h>
#include <dalembert/models/numbered.h>

#include <array>
#include <cmath>
#include <utility>

namespace dalembert::models {

FourBarScene FourBar::scene() const {
  FourBarScene built{.scene = Scene<2>("four-bar"), .uprights = {}, .crossbars = {}, .ground_pins = {}};
  Scene<2>& scene = built.scene;
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const Vec<2> velocity(speed, 0.0);
  for (int i = 0; i <= loops; ++i) {
    const Vec<2> A(i * length, 0.0), B(i * length, length);
    built.uprights.push_back(add_thin_rod<2>(
        scene, {.mass = mass, .start = A, .end = B, .end_velocity = velocity}, numbered("upright", i)));
    built.ground_pins.push_back(
        scene.add(Coincident{Fixed<2>{A}, built.uprights.back().start()}, numbered("A", i)));
  }
  for (int i = 0; i < loops; ++i) {
    const auto& left = built.uprights[static_cast<std::size_t>(i)];
    const auto& right = built.uprights[static_cast<std::size_t>(i) + 1];
    built.crossbars.push_back(add_thin_rod<2>(scene,
                                              {.mass = mass,
                                               .start = {i * length, length},
                                               .end = {(i + 1) * length, length},
                                               .start_velocity = velocity,
                                               .end_velocity = velocity},
                                              numbered("crossbar", i)));
    scene.add(Coincident{left.end(), built.crossbars.back().start()}, numbered("B", i) + ".right");
    scene.add(Coincident{right.end(), built.crossbars.back().end()}, numbered("B", i + 1) + ".left");
  }
  return built;
}

std::vector<Observation<2>> FourBar::reference(std::span<const double> times) const {
  const Real N = loops, L = length, g = gravity;
  const Real W2 = g / L * 3 * (3 * N + 1) / (2 * (4 * N + 1));
  const auto equations = [&](const State& y, State& y_rate) {  // y = (p, p')
    y_rate[0] = y[1];
    y_rate[1] = W2 * std::sin(y[0]);
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{0, Real(speed) / L}, times, [&](const State& y) {
    const VecOf<Real, 2> e = vec(std::sin(y[0]), std::cos(y[0])), across = vec(e.y(), -e.x());
    const VecOf<Real, 2> turning = W2 * e.x() * across - y[1] * y[1] * e;
    const VecOf<Real, 2> ground =
        mass * (L * ((N + 1) / 2 + N) * turning + (2 * N + 1) * g * VecOf<Real, 2>::UnitY());
    Observation<2> at{.positions = {},
                      .forces = {static_cast<double>(ground.x()), static_cast<double>(ground.y())}};
    for (int i = 0; i <= loops; ++i)
      at.positions.push_back((L * (i * VecOf<Real, 2>::UnitX() + e)).cast<double>());
    seen.push_back(std::move(at));
  });
  return seen;
}

Observation<2> FourBar::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> FourBar::model() const {
  const double weight = (2 * loops + 1) * mass * gravity;
  return {.name = "four-bar",
          .notes = "-",
          .reference = "parallelogram branch: p'' = W^2 sin p in extended precision",
          .t_end = 10.0,
          .length = length,
          .force = weight,
          .energy = weight * length,
          .scene =
              [*this] {
                FourBarScene built = scene();
                return Observed<2>{
                    std::move(built.scene),
                    [uprights = built.uprights, pins = built.ground_pins](const Sample<2>& sample) {
                      Observation<2> seen;
                      Vec<2> ground = Vec<2>::Zero();
                      for (const auto& rod : uprights) seen.positions.push_back(sample.position(rod.end()));
                      bool known = true;  // not where the rods lie in line
                      for (const auto& pin : pins) known = known && sample.is_determined(pin);
                      for (const auto& pin : pins)
                        if (known) ground += sample.multiplier(pin);
                      if (!known) ground = Vec<2>::Constant(not_determined);
                      seen.forces = {ground.x(), ground.y()};
                      return seen;
                    }};
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
