#include "dalembert/models/pendulum_rotation.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include <array>
#include <cmath>

namespace dalembert::models {

namespace {

using Real = long double;

Real frequency(const PendulumRotation& p) { return std::sqrt(Real(p.gravity) / p.length); }
Real modulus(const PendulumRotation& p) { return 1 / std::sqrt(Real(p.energy_ratio)); }

}  // namespace

HangingRods PendulumRotation::scene() const {
  const double rate = static_cast<double>(2 * frequency(*this) / modulus(*this));
  return hang("pendulum-rotation", gravity, std::array{RodAndBead{mass, length, 0.0, rate}});
}

Observation<2> PendulumRotation::reference(double t) const {
  const Real omega0 = frequency(*this), kappa = modulus(*this);
  Real cn;
  const Real sn = boost::math::jacobi_elliptic<Real, Real, Real>(kappa, omega0 * t / kappa, &cn, nullptr);
  const Real dn = std::sqrt(1 - kappa * kappa * sn * sn);  // Boost's own is 0/0 where cn = 0
  const Real rate = 2 * omega0 / kappa * dn, sine = 2 * sn * cn, cosine = 1 - 2 * sn * sn;
  const Real tension = mass * (length * rate * rate + gravity * cosine);
  return {.positions = {Vec<2>(static_cast<double>(length * sine), static_cast<double>(-length * cosine))},
          .forces = {static_cast<double>(tension)}};
}

double PendulumRotation::period() const {
  const Real kappa = modulus(*this);
  return static_cast<double>(2 * kappa * boost::math::ellint_1(kappa) / frequency(*this));
}

Model<2> PendulumRotation::model() const {
  return {.name = "pendulum-rotation",
          .notes = "mex147",
          .reference = "closed form: phi/2 = am(omega0 t/kappa)",
          .t_end = 10.0,
          .length = length,
          .force = mass * gravity,
          .energy = mass * gravity * length,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
