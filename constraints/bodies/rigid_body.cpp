#include "dalembert/constraints/bodies/rigid_body.h"

#include <dalembert/constraints/bodies/equimomental.h>
#include <dalembert/constraints/bodies/orthonormal.h>
#include <dalembert/core/errors.h>

#include <cmath>
#include <numeric>
#include <sstream>

namespace dalembert {

namespace {

void require(bool good, const std::string& name, const std::string& what) {
  if (!good) throw InvalidScene("Body \"" + name + "\": " + what);
}

/// Shares of the mass, and body coordinates of the particles; columns.
template <int D>
struct Particles {
  static constexpr int count = BodyPoint<D>::count;
  Vec<count> share;
  Mat<D, count> place;

  explicit Particles(const Vec<D>& arms) {
    if constexpr (D == 2) {
      share = Vec<count>::Constant(0.5);
      place = Mat<D, count>({{-arms.x(), arms.x()}, {0.0, 0.0}});
    } else {
      const Equimomental<3> set(arms);
      for (int i = 0; i < count; ++i) {
        share[i] = set.share(i);
        place.set_col(i, set.place(i));
      }
    }
  }
};

bool finite(const BodyState<2>& s) {
  return s.centre.allFinite() && std::isfinite(s.angle) && s.velocity.allFinite() &&
         std::isfinite(s.angular_velocity);
}
bool finite(const BodyState<3>& s) {
  return s.centre.allFinite() && s.axes.allFinite() && s.velocity.allFinite() &&
         s.angular_velocity.allFinite();
}

Vec<2> arms_of(const BodyState<2>& s, const std::string& name) {
  require(std::isfinite(s.inertia) && s.inertia > 0.0, name,
          "inertia must be finite and > 0; a body without inertia is a particle");
  return Vec<2>::Constant(std::sqrt(s.inertia / s.mass));
}

Vec<3> arms_of(const BodyState<3>& s, const std::string& name) {
  const Vec<3> second_moments = Vec<3>::Constant(s.inertia.sum() / 2.0) - s.inertia;
  require(s.inertia.allFinite() && second_moments.minCoeff() > 0.0, name,
          "each principal moment of inertia must be finite and less than the sum of the other two; use "
          "add_lamina or add_thin_rod for what is thin");
  const Vec<3> squares = second_moments / s.mass;
  return {std::sqrt(squares.x()), std::sqrt(squares.y()), std::sqrt(squares.z())};
}

Mat<2, 2> axes_of(const BodyState<2>& s) {
  return Mat<2, 2>({{std::cos(s.angle), -std::sin(s.angle)}, {std::sin(s.angle), std::cos(s.angle)}});
}
Mat<3, 3> axes_of(const BodyState<3>& s) { return s.axes; }

Vec<2> turning(const BodyState<2>& s, const Vec<2>& arm) {
  return s.angular_velocity * Vec<2>(-arm.y(), arm.x());
}
Vec<3> turning(const BodyState<3>& s, const Vec<3>& arm) { return s.angular_velocity.cross(arm); }

}  // namespace

template <int D>
BodyPoint<D> RigidBody<D>::point(const Vec<D>& local) const {
  if (!local.allFinite())
    throw InvalidArgument("A point of a body has coordinates that are no finite numbers");
  BodyPoint<D> p{particles, {}};
  if constexpr (D == 2) {
    // centre + x e + y (e turned left), e = (p_2 - p_1)/(2 rho)
    const Vec<2> e_part = local / (2.0 * arms.x()), turned_left(-e_part.y(), e_part.x());
    p.L = Mat<2, 4>(Vec<2>(0.5 * Vec<2>::UnitX() - e_part), 0.5 * Vec<2>::UnitY() - turned_left,
                    0.5 * Vec<2>::UnitX() + e_part, 0.5 * Vec<2>::UnitY() + turned_left);
  } else {
    const Vec<4> w = Equimomental<3>(arms).weights(local);
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) p.L.set_col(3 * i + k, w[i] * Vec<3>::Unit(k));
  }
  return p;
}

template <int D>
BodyPoint<D> RigidBody<D>::vector(const Vec<D>& local) const {
  BodyPoint<D> v = point(local);
  v.L -= centre().L;
  return v;
}

template <int D>
double RigidBody<D>::mass() const {
  return std::accumulate(masses.begin(), masses.end(), 0.0);
}

template <int D>
typename RigidBody<D>::Inertia RigidBody<D>::inertia() const {
  if constexpr (D == 2) {
    return mass() * arms.x() * arms.x();
  } else {
    const Vec<3> second_moments = arms.cwiseAbs2();
    return mass() * (Vec<3>::Constant(second_moments.sum()) - second_moments);
  }
}

template <int D>
typename RigidBody<D>::Axes RigidBody<D>::axes(const Sample<D>& sample) const {
  Axes axes;
  const Vec<D> origin = sample.position(centre());
  // Points as far from the centre as particles keep round-off small whatever the size of the body.
  const double far = arms.norm();
  for (int k = 0; k < D; ++k) axes.set_col(k, (sample.position(point(far * Vec<D>::Unit(k))) - origin) / far);
  return axes;
}

template <int D>
RigidBody<D> add_body(Scene<D>& scene, const BodyState<D>& state, const std::string& name) {
  require(std::isfinite(state.mass) && state.mass > 0.0, name,
          "mass = " + detail::text(state.mass) + ", must be finite and > 0");
  require(finite(state), name, "centre, attitude, velocity and angular velocity must be finite");
  const Mat<D, D> axes = axes_of(state);
  require(detail::orthonormal(axes), name, "axes must be right-handed and of unit length");
  RigidBody<D> body;
  body.arms = arms_of(state, name);
  require_free_names(scene, name, RigidBody<D>::particle_count);
  body.stated_centre = state.centre;
  body.stated_axes = axes;
  const Particles<D> set(body.arms);
  for (int i = 0; i < RigidBody<D>::particle_count; ++i) {
    const Vec<D> arm = axes * set.place.col(i);
    const double mass = set.share[i] * state.mass;
    body.masses[static_cast<std::size_t>(i)] = mass;
    body.particles[static_cast<std::size_t>(i)] = scene.add_particle(
        {mass, state.centre + arm, state.velocity + turning(state, arm)}, particle_of(name, i));
  }
  std::size_t rod = 0;
  for (int i = 0; i < RigidBody<D>::particle_count; ++i) {
    for (int j = i + 1; j < RigidBody<D>::particle_count; ++j) {
      const double length = (set.place.col(j) - set.place.col(i)).norm();
      body.rods[rod++] = scene.add(BodyRod<D>{{body.particles[static_cast<std::size_t>(i)],
                                               body.particles[static_cast<std::size_t>(j)], length}},
                                   rod_of(name, i, j));
    }
  }
  return body;
}

template struct RigidBody<2>;
template struct RigidBody<3>;
template RigidBody<2> add_body(Scene<2>&, const BodyState<2>&, const std::string&);
template RigidBody<3> add_body(Scene<3>&, const BodyState<3>&, const std::string&);

}  // namespace dalembert
