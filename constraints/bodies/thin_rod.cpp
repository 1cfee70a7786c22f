#include "dalembert/constraints/bodies/thin_rod.h"

#include <dalembert/core/errors.h>

#include <cmath>
#include <numbers>

namespace dalembert {

namespace {

/// Distance of the particles from the centre, as a fraction of the length.
constexpr double arm = 0.5 * std::numbers::inv_sqrt3;

template <class V>
V between(const V& start, const V& end, double fraction) {
  return start + fraction * (end - start);
}

}  // namespace

template <int D>
BodyPoint<D, 2> ThinRod<D>::point(double fraction) const {
  if (!std::isfinite(fraction))
    throw InvalidArgument("A point of a thin rod is at a fraction that is no finite number");
  const double weight = 0.5 + (fraction - 0.5) / (2.0 * arm);  // of the particle near the end
  BodyPoint<D, 2> p{particles, {}};
  for (int k = 0; k < D; ++k) {
    p.L.set_col(k, (1.0 - weight) * Vec<D>::Unit(k));
    p.L.set_col(D + k, weight * Vec<D>::Unit(k));
  }
  return p;
}

template <int D>
ThinRod<D> add_thin_rod(Scene<D>& scene, const ThinRodState<D>& s, const std::string& name) {
  const double length = (s.end - s.start).norm();
  if (!(std::isfinite(s.mass) && s.mass > 0.0)) {
    throw InvalidScene("Rod \"" + name + "\": mass = " + detail::text(s.mass) + ", must be finite and > 0");
  }
  if (!(std::isfinite(length) && length > 0.0)) {
    throw InvalidScene("Rod \"" + name +
                       "\": its ends must be finite and different; a rod of no length is a particle");
  }
  if (!(s.start_velocity.allFinite() && s.end_velocity.allFinite()))
    throw InvalidScene("Rod \"" + name + "\": the velocities of its ends must be finite");
  for (int i = 0; i < 2; ++i) scene.require_free("particle", particle_of(name, i));
  scene.require_free("Distance", name + ".rod");
  ThinRod<D> rod{.particles = {}, .distance = {}, .length = length};
  for (std::size_t i = 0; i < 2; ++i) {
    const double fraction = i == 0 ? 0.5 - arm : 0.5 + arm;
    rod.particles[i] = scene.add_particle({.mass = 0.5 * s.mass,
                                           .position = between(s.start, s.end, fraction),
                                           .velocity = between(s.start_velocity, s.end_velocity, fraction)},
                                          particle_of(name, static_cast<int>(i)));
  }
  rod.distance =
      scene.add(BodyRod<D>{{rod.particles[0], rod.particles[1], 2.0 * arm * length}}, name + ".rod");
  return rod;
}

template struct ThinRod<2>;
template struct ThinRod<3>;
template ThinRod<2> add_thin_rod(Scene<2>&, const ThinRodState<2>&, const std::string&);
template ThinRod<3> add_thin_rod(Scene<3>&, const ThinRodState<3>&, const std::string&);

}  // namespace dalembert
