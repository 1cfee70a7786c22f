#include "dalembert/models/pendulum_separatrix.h"

#include <array>
#include <cmath>

namespace dalembert::models {

HangingRods PendulumSeparatrix::scene() const {
  const double rate = 2.0 * std::sqrt(gravity / length);
  return hang("pendulum-separatrix", gravity, std::array{RodAndBead{mass, length, 0.0, rate}});
}

Observation<2> PendulumSeparatrix::reference(double t) const {
  using Real = long double;
  const Real phase = std::sqrt(Real(gravity) / length) * t;
  const Real tanh = std::tanh(phase), sech = 1 / std::cosh(phase);
  const Real tension = mass * gravity * (6 * sech * sech - 1);
  return {.positions = {Vec<2>(static_cast<double>(2 * length * tanh * sech),
                               static_cast<double>(length * (1 - 2 * sech * sech)))},
          .forces = {static_cast<double>(tension)}};
}

Model<2> PendulumSeparatrix::model() const {
  return {.name = "pendulum-separatrix",
          .notes = "mex147",
          .reference = "closed form: sin(phi/2) = tanh(omega0 t)",
          .t_end = 2.0 * std::sqrt(9.81 * length / gravity),
          .length = length,
          .force = mass * gravity,
          .energy = mass * gravity * length,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
