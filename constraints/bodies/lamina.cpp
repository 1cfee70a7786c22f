#include "dalembert/constraints/bodies/lamina.h"

#include <dalembert/constraints/bodies/equimomental.h>
#include <dalembert/constraints/bodies/orthonormal.h>
#include <dalembert/core/errors.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

void check(const LaminaState& s, const std::string& name) {
  const auto require = [&name](bool good, const std::string& what) {
    if (!good) throw InvalidScene("Lamina \"" + name + "\": " + what);
  };
  require(std::isfinite(s.mass) && s.mass > 0.0,
          "mass = " + detail::text(s.mass) + ", must be finite and > 0");
  require(s.inertia.allFinite() && s.inertia.minCoeff() > 0.0,
          "each moment of inertia in the plane must be finite and > 0; a thin rod is a ThinRod");
  require(detail::orthonormal(s.axes), "axes must be right-handed and of unit length");
  require(s.centre.allFinite() && s.velocity.allFinite() && s.angular_velocity.allFinite(),
          "centre, velocity and angular velocity must be finite");
}

}  // namespace

BodyPoint<3, 3> Lamina::point(const Vec<2>& local) const {
  if (!local.allFinite())
    throw InvalidArgument("A point of a lamina has coordinates that are no finite numbers");
  const Vec<3> w = Equimomental<2>(arms).weights(local);
  BodyPoint<3, 3> p{particles, {}};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) p.L.set_col(3 * i + k, w[i] * Vec<3>::Unit(k));
  return p;
}

BodyPoint<3, 3> Lamina::vector(const Vec<2>& local) const {
  BodyPoint<3, 3> v = point(local);
  v.L -= centre().L;
  return v;
}

Mat<3, 3> Lamina::axes(const Sample<3>& sample) const {
  const double far = arms.norm();  // as far as particles, for small round-off
  const Vec<3> x = sample.position(vector({far, 0.0})) / far, y = sample.position(vector({0.0, far})) / far;
  return Mat<3, 3>(x, y, x.cross(y));
}

Lamina add_lamina(Scene<3>& scene, const LaminaState& s, const std::string& name) {
  check(s, name);
  Lamina lamina{.particles = {},
                .rods = {},
                .arms = {std::sqrt(s.inertia.y() / s.mass), std::sqrt(s.inertia.x() / s.mass)}};
  const Equimomental<2> set(lamina.arms);
  require_free_names(scene, name, 3);
  std::array<Vec<3>, 3> arm;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec<2> place = set.place(static_cast<int>(i));
    arm[i] = s.axes.col(0) * place.x() + s.axes.col(1) * place.y();
    lamina.particles[i] = scene.add_particle({.mass = s.mass * set.share(static_cast<int>(i)),
                                              .position = s.centre + arm[i],
                                              .velocity = s.velocity + s.angular_velocity.cross(arm[i])},
                                             particle_of(name, static_cast<int>(i)));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    lamina.rods[i] =
        scene.add(BodyRod<3>{{lamina.particles[i], lamina.particles[j], (arm[j] - arm[i]).norm()}},
                  rod_of(name, static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j))));
  }
  return lamina;
}

}  // namespace dalembert
