#include "dalembert/models/sliding_rod.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace dalembert::models {

namespace {

Real angular_acceleration(const SlidingRod& p, Real theta, Real rate) {
  const Real sine = std::sin(theta);
  return 3 * sine * (2 * Real(p.gravity) - p.length * rate * rate * std::cos(theta)) /
         (p.length * (1 + 3 * sine * sine));
}

Observation<2> observation(const SlidingRod& p, const State& y) {  // y = (theta, theta', x_c)
  const Real theta = y[0], rate = y[1], half = Real(p.length) / 2;
  const Real sine = std::sin(theta), cosine = std::cos(theta);
  const VecOf<Real, 2> centre = vec(y[2], half * cosine);
  const VecOf<Real, 2> foot = vec(y[2] - half * sine, Real(0));
  const Real centre_rises = -half * (angular_acceleration(p, theta, rate) * sine + rate * rate * cosine);
  return {.positions = {centre.cast<double>(), foot.cast<double>()},
          .forces = {static_cast<double>(p.mass * (p.gravity + centre_rises))}};
}

Observed<2> observed(RodOnTrack built) {
  return {std::move(built.scene),
          [centre = built.rod.centre(), foot = built.foot, track = built.track](const Sample<2>& sample) {
            return Observation<2>{.positions = {sample.position(centre), sample.position(foot)},
                                  .forces = {sample.multiplier(track)}};
          }};
}

}  // namespace

RodOnTrack SlidingRod::scene() const {
  Scene<2> scene("sliding-rod");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const double half = length / 2.0;
  const RigidBody<2> rod = add_body(scene,
                                    BodyState<2>{.mass = mass,
                                                 .inertia = mass * length * length / 12.0,
                                                 .centre = half * Vec<2>(std::sin(angle), std::cos(angle)),
                                                 .angle = std::numbers::pi / 2 - angle,
                                                 .velocity = {drift, 0.0}},
                                    "rod");
  const BodyPoint<2> foot = rod.point({-half, 0.0});
  const Constraint<1> track = scene.add(OnCurve{foot, Plane<2>{}});
  return {.scene = std::move(scene), .rod = rod, .foot = foot, .track = track};
}

std::vector<Observation<2>> SlidingRod::reference(std::span<const double> times) const {
  const auto equations = [this](const State& y, State& y_rate) {
    y_rate[0] = y[1];
    y_rate[1] = angular_acceleration(*this, y[0], y[1]);
    y_rate[2] = drift;
  };
  const Real centre = Real(length) / 2 * std::sin(Real(angle));
  std::vector<Observation<2>> seen;
  integrate(equations, State{angle, 0, centre}, times,
            [&](const State& y) { seen.push_back(observation(*this, y)); });
  return seen;
}

Observation<2> SlidingRod::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> SlidingRod::model() const {
  return {.name = "sliding-rod",
          .notes = "mex115",
          .reference = "equation of motion of the angle in extended precision, force by Newton's law",
          .t_end = 2.0,
          .length = length,
          .force = mass * gravity,
          .energy = mass * gravity * length,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
