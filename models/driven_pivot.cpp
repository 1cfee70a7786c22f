#include "dalembert/models/driven_pivot.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace dalembert::models {

namespace {

/// Gravity as felt at the pivot, (a_x, g + a_y).
VecOf<Real, 2> felt(const DrivenPivot& p, Real t) {
  const VecOf<Real, 2> acceleration = -Real(p.frequency) * p.frequency * p.pivot(t);
  return acceleration + vec(Real(0), Real(p.gravity));
}

Observation<2> observation(const DrivenPivot& p, const State& y) {  // y = (phi, phi', t)
  const Real phi = y[0], rate = y[1], t = y[2], sine = std::sin(phi), cosine = std::cos(phi);
  const VecOf<Real, 2> g = felt(p, t);
  const VecOf<Real, 2> bob = p.pivot(t) + Real(p.length) * vec(sine, -cosine);
  const Real tension = p.mass * (p.length * rate * rate + g.y() * cosine - g.x() * sine);
  return {.positions = {bob.cast<double>()}, .forces = {static_cast<double>(tension)}};
}

Observed<2> observed(DrivenPendulum built) {
  return {std::move(built.scene),
          [bob = built.bob, rod = built.rod](const Sample<2>& sample) {
            return Observation<2>{.positions = {sample.position(bob)}, .forces = {-sample.multiplier(rod)}};
          },
          {}};  // the drive does work
}

struct NameAndNotes {
  const char *name, *notes;
};
NameAndNotes named(const DrivenPivot& p) {
  if (p.amplitude_y == 0.0) return {"driven-pivot-horizontal", "mex248"};
  if (p.amplitude_x == 0.0) return {"driven-pivot-vertical", "mex249"};
  return {"driven-pivot-circular", "mex250"};
}

}  // namespace

DrivenPendulum DrivenPivot::scene() const {
  DrivenPendulum built{.scene = Scene<2>(named(*this).name), .bob = {}, .rod = {}};
  built.scene.add(UniformGravity<2>{{0.0, -gravity}});
  const Vec<2> velocity = -frequency * Vec<2>(0.0, amplitude_y * std::sin(phase));  // of the pivot at t = 0
  built.bob =
      built.scene.add_particle({.mass = mass,
                                .position = pivot(0.0) + length * Vec<2>(std::sin(angle), -std::cos(angle)),
                                .velocity = velocity});
  const auto moving = driven([p = *this](const auto& t) { return p.pivot(t); });
  built.rod = built.scene.add(Distance{moving, built.bob, length});
  return built;
}

std::vector<Observation<2>> DrivenPivot::reference(std::span<const double> times) const {
  const auto equations = [this](const State& y, State& y_rate) {
    const VecOf<Real, 2> g = felt(*this, y[2]);
    y_rate[0] = y[1];
    y_rate[1] = -(g.y() * std::sin(y[0]) + g.x() * std::cos(y[0])) / length;
    y_rate[2] = 1;
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{angle, 0, 0}, times,
            [&](const State& y) { seen.push_back(observation(*this, y)); });
  return seen;
}

Observation<2> DrivenPivot::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> DrivenPivot::model() const {
  return {.name = named(*this).name,
          .notes = named(*this).notes,
          .reference = "equation of motion of the angle in extended precision, force by Newton's law",
          .t_end = 10.0,
          .length = length,
          .force = mass * gravity,
          .energy = mass * gravity * length,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
