#include "dalembert/models/parabolic_slide.h"

#include <dalembert/models/minimal_ode.h>

#include <boost/math/special_functions/ellint_2.hpp>

#include <array>
#include <cmath>

namespace dalembert::models {

BeadOnCurve ParabolicSlide::scene() const {
  BeadOnCurve built{.scene = Scene<2>("parabolic-slide"), .bead = {}, .curve = {}};
  built.scene.add(UniformGravity<2>{{0.0, -gravity}});
  built.bead = built.scene.add_particle(
      {.mass = mass, .position = {amplitude, curvature * amplitude * amplitude}, .velocity = {0.0, 0.0}});
  built.curve = built.scene.add(OnCurve{built.bead, [A = curvature](const auto& r) {
                                          using std::sqrt;
                                          const auto height = r.y() - A * r.x() * r.x();
                                          return height / sqrt(1.0 + 4.0 * A * A * r.x() * r.x());
                                        }});
  return built;
}

std::vector<Observation<2>> ParabolicSlide::reference(std::span<const double> times) const {
  const Real A = curvature, g = gravity;
  const auto equations = [&](const State& y, State& y_rate) {  // y = (x, x')
    const Real x = y[0], u = y[1];
    y_rate[0] = u;
    y_rate[1] = -(4 * A * A * x * u * u + 2 * g * A * x) / (1 + 4 * A * A * x * x);
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{amplitude, 0}, times, [&](const State& y) {
    const Real x = y[0], u = y[1];
    const Real normal_force = mass * (g + 2 * A * u * u) / std::sqrt(1 + 4 * A * A * x * x);
    seen.push_back(
        {.positions = {vec(x, A * x * x).cast<double>()}, .forces = {static_cast<double>(normal_force)}});
  });
  return seen;
}

Observation<2> ParabolicSlide::reference(double t) const { return reference(std::array{t}).front(); }

double ParabolicSlide::period() const {
  const Real c = 2 * Real(curvature) * amplitude, s = std::sqrt(1 + c * c);
  return static_cast<double>(4 * s * boost::math::ellint_2(c / s) / std::sqrt(2 * Real(gravity) * curvature));
}

Model<2> ParabolicSlide::model() const {
  return {.name = "parabolic-slide",
          .notes = "mex131",
          .reference = "equation of motion of x in extended precision, force by Newton's law",
          .t_end = 5.0,
          .length = amplitude,
          .force = mass * gravity,
          .energy = mass * gravity * curvature * amplitude * amplitude,
          .scene = [*this] { return observed(scene(), Counted::along_gradient); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
