#include "dalembert/models/plane_pendulum.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include <array>
#include <cmath>

namespace dalembert::models {

namespace {

using Real = long double;

Real frequency(const PlanePendulum& p) { return std::sqrt(Real(p.gravity) / p.length); }
Real modulus(const PlanePendulum& p) { return std::sin(Real(p.amplitude) / 2); }

}  // namespace

HangingRods PlanePendulum::scene() const {
  return hang("plane-pendulum", gravity, std::array{RodAndBead{mass, length, amplitude}});
}

Observation<2> PlanePendulum::reference(double t) const {
  const Real omega0 = frequency(*this), k = modulus(*this);
  Real cn;
  const Real sn =
      boost::math::jacobi_elliptic<Real, Real, Real>(k, boost::math::ellint_1(k) - omega0 * t, &cn, nullptr);
  const Real dn = std::hypot(cn, std::cos(Real(amplitude) / 2) * sn);  // Boost's own is 0/0 where cn = 0
  const Real half_sine = k * sn, half_cosine = dn, rate = -2 * k * omega0 * cn;
  const Real sine = 2 * half_sine * half_cosine, cosine = 1 - 2 * half_sine * half_sine;
  const Real tension = mass * (length * rate * rate + gravity * cosine);
  return {.positions = {Vec<2>(static_cast<double>(length * sine), static_cast<double>(-length * cosine))},
          .forces = {static_cast<double>(tension)}};
}

double PlanePendulum::period() const {
  return static_cast<double>(4 * boost::math::ellint_1(modulus(*this)) / frequency(*this));
}

Model<2> PlanePendulum::model() const {
  return {.name = "plane-pendulum",
          .notes = "mex132, mex146",
          .reference = "closed form: sin(phi/2) = k sn(K - omega0 t)",
          .t_end = 10.0,
          .length = length,
          .force = mass * gravity,
          .energy = mass * gravity * length,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
