#include "dalembert/models/governor.h"

#include <dalembert/models/minimal_ode.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace dalembert::models {

namespace {

Real angular_acceleration(const Governor& p, Real theta, Real rate) {
  const Real sine = std::sin(theta), cosine = std::cos(theta), m1 = p.mass, m2 = p.sleeve_mass, L = p.length;
  return sine * (cosine * L * (m1 * p.spin * p.spin - 2 * m2 * rate * rate) - (m1 + m2) * p.gravity) /
         (L * (m1 + 2 * m2 * sine * sine));
}

Observation<3> observation(const Governor& p, const State& y) {  // y = (theta, theta', t)
  const Real theta = y[0], rate = y[1], turned = p.spin * y[2], L = p.length;
  const Real sine = std::sin(theta), cosine = std::cos(theta);
  const Real rising = L * (sine * angular_acceleration(p, theta, rate) + cosine * rate * rate);
  const Real lower = p.sleeve_mass * (p.gravity + 2 * rising) / (2 * cosine);
  const Real upper = lower + p.mass * (p.gravity + rising) / cosine;
  const Real drive = 2 * p.mass * L * p.spin * rate * cosine;
  const VecOf<Real, 3> out = L * sine * vec(std::cos(turned), std::sin(turned), Real(0));
  const VecOf<Real, 3> down = L * cosine * vec(Real(0), Real(0), Real(-1));
  const auto number = [](Real force) { return static_cast<double>(force); };
  return {
      .positions = {(down + out).cast<double>(), (down - out).cast<double>(), (2 * down).cast<double>()},
      .forces = {number(upper), number(upper), number(lower), number(lower), number(drive), number(drive)}};
}

Observation<3> observe(const GovernorParts& p, const Sample<3>& sample) {
  const auto tension = [&](Constraint<1> rod) { return -sample.multiplier(rod); };
  return {
      .positions = {sample.position(p.masses[0]), sample.position(p.masses[1]), sample.position(p.sleeve)},
      .forces = {tension(p.upper[0]), tension(p.upper[1]), tension(p.lower[0]), tension(p.lower[1]),
                 sample.multiplier(p.drives[0]), sample.multiplier(p.drives[1])}};
}

double jacobi_integral(const Governor& governor, const GovernorParts& p, const Sample<3>& sample) {
  double angular_momentum = 0.0;  // the sleeve has none
  for (const Particle<3>& mass : p.masses)
    angular_momentum += governor.mass * sample.position(mass).cross(sample.velocity(mass)).z();
  return sample.energy() - governor.spin * angular_momentum;
}

}  // namespace

double Governor::equilibrium() const {
  const double cosine = (mass + sleeve_mass) * gravity / (mass * length * spin * spin);
  return cosine < 1.0 ? std::acos(cosine) : 0.0;
}

Governor::Built Governor::scene() const {
  Built built{.scene = Scene<3>("governor"), .parts = {}};
  Scene<3>& scene = built.scene;
  GovernorParts& parts = built.parts;
  scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  const double out = length * std::sin(angle), down = -length * std::cos(angle);
  parts.sleeve = scene.add_particle({.mass = sleeve_mass, .position = {0.0, 0.0, 2.0 * down}}, "sleeve");
  parts.axis = {scene.add(OnSurface{parts.sleeve, Plane<3>{.normal = Vec<3>::UnitX()}}),
                scene.add(OnSurface{parts.sleeve, Plane<3>{.normal = Vec<3>::UnitY()}})};
  for (const std::size_t i : {0U, 1U}) {
    const double side = i == 0 ? 1.0 : -1.0, ahead = i == 0 ? 0.0 : std::numbers::pi;
    const Particle<3> mass_here = scene.add_particle(
        {.mass = mass, .position = {side * out, 0.0, down}, .velocity = {0.0, side * spin * out, 0.0}});
    parts.masses[i] = mass_here;
    parts.upper[i] = scene.add(Distance{Fixed<3>{}, mass_here, length});
    parts.lower[i] = scene.add(Distance{mass_here, parts.sleeve, length});
    parts.drives[i] = scene.add(
        RotatingPlane{mass_here, Axis{}, [Omega = spin, ahead](const auto& t) { return Omega * t + ahead; }});
  }
  return built;
}

std::vector<Observation<3>> Governor::reference(std::span<const double> times) const {
  const auto equations = [this](const State& y, State& y_rate) {
    y_rate[0] = y[1];
    y_rate[1] = angular_acceleration(*this, y[0], y[1]);
    y_rate[2] = 1;
  };
  std::vector<Observation<3>> seen;
  integrate(equations, State{angle, 0, 0}, times,
            [&](const State& y) { seen.push_back(observation(*this, y)); });
  return seen;
}

Observation<3> Governor::reference(double t) const { return reference(std::array{t}).front(); }

Model<3> Governor::model() const {
  return {.name = "governor",
          .notes = "mex23",
          .reference = "equation of motion of the angle in extended precision, forces by Newton's law",
          .t_end = 10.0,
          .length = length,
          .force = (2.0 * mass + sleeve_mass) * gravity,
          .energy = 2.0 * (mass + sleeve_mass) * gravity * length,
          .scene =
              [*this] {
                Built built = scene();
                return Observed<3>{std::move(built.scene),
                                   [parts = built.parts](const Sample<3>& s) { return observe(parts, s); },
                                   [governor = *this, parts = built.parts](const Sample<3>& s) {
                                     return jacobi_integral(governor, parts, s);
                                   }};
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
