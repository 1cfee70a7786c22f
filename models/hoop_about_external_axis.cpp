#include "dalembert/models/hoop_about_external_axis.h"

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include <cmath>
#include <utility>

namespace dalembert::models {

namespace {

using Real = long double;

Real frequency(const HoopAboutExternalAxis& p) { return p.spin * std::sqrt(Real(p.offset) / p.radius); }
Real modulus(const HoopAboutExternalAxis& p) { return std::sin(Real(p.amplitude) / 2); }

}  // namespace

BeadOnCurve HoopAboutExternalAxis::scene() const {
  const Vec<2> arm = radius * Vec<2>(std::cos(amplitude), std::sin(amplitude)),
               position = arm + Vec<2>(offset, 0.0);
  BeadOnCurve built{.scene = Scene<2>("hoop-about-external-axis"), .bead = {}, .curve = {}};
  built.bead = built.scene.add_particle(
      {.mass = mass, .position = position, .velocity = spin * Vec<2>(-position.y(), position.x())});
  const Sphere<2> hoop{.centre = {offset, 0.0}, .radius = radius};
  built.curve = built.scene.add(OnCurve{
      built.bead, Rotating{hoop, Vec<2>(0.0, 0.0), [Omega = spin](const auto& t) { return Omega * t; }}});
  return built;
}

Observation<2> HoopAboutExternalAxis::reference(double t) const {
  const Real omega0 = frequency(*this), k = modulus(*this), Omega = spin;
  Real cn;
  const Real sn =
      boost::math::jacobi_elliptic<Real, Real, Real>(k, boost::math::ellint_1(k) - omega0 * t, &cn, nullptr);
  const Real dn = std::hypot(cn, std::cos(Real(amplitude) / 2) * sn);  // Boost's own is 0/0 where cn = 0
  const Real rate = -2 * k * omega0 * cn, sine = 2 * k * sn * dn, cosine = 1 - 2 * k * k * sn * sn;
  const Real s = std::sin(Omega * t), c = std::cos(Omega * t);
  const Real along = offset + radius * cosine, across = radius * sine;  // as seen from the hoop
  const Real inwards = mass * (radius * (rate + Omega) * (rate + Omega) + offset * Omega * Omega * cosine);
  return {.positions = {vec(along * c - across * s, along * s + across * c).cast<double>()},
          .forces = {static_cast<double>(inwards)}};
}

double HoopAboutExternalAxis::period() const {
  return static_cast<double>(4 * boost::math::ellint_1(modulus(*this)) / frequency(*this));
}

Model<2> HoopAboutExternalAxis::model() const {
  const double pull = mass * spin * spin * (radius + offset);
  return {.name = "hoop-about-external-axis",
          .notes = "mex25",
          .reference = "closed form: sin(theta/2) = k sn(K - omega0 t)",
          .t_end = 10.0,
          .length = radius,
          .force = pull,
          .energy = pull * radius,
          .scene =
              [*this] {
                BeadOnCurve built = scene();
                const auto jacobi = [bead = built.bead, m = mass, Omega = spin](const Sample<2>& sample) {
                  const Vec<2> r = sample.position(bead), v = sample.velocity(bead);
                  return sample.energy() - Omega * m * (r.x() * v.y() - r.y() * v.x());
                };
                Observed<2> seen = observed(std::move(built), Counted::against_gradient);
                seen.conserved = jacobi;
                return seen;
              },
          .observations = [*this](std::span<const double> times) { return at_each<2>(*this, times); }};
}

}  // namespace dalembert::models
