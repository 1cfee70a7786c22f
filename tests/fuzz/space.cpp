#include "draft.h"
#include <dalembert/eigen.h>

#include <Eigen/Geometry>

#include <cmath>

namespace dalembert::fuzz {

namespace {

template <class Surface>
void place_surface(Draft<3>& draft, const Place<3>& p, const Surface& surface, const std::string& text) {
  const double omega = draft.size(1.0 / draft.plan.time), start = draft.plan.options.t_start;
  const int moving = draft.random.below(5);
  if (moving == 0) {
    const SwingingPath<3> path{Vec<3>::Zero(), 0.1 * draft.plan.length * draft.random.vector<3>(), omega,
                               start};
    draft.add(call_text("OnSurface", p.text, text, "translating " + write<3>(path.amplitude), omega),
              OnSurface{handle(p), Translating{surface, path}});
  } else if (moving == 1) {
    const Axis axis{draft.plan.length * draft.random.vector<3>() + p.r,
                    draft.numbers(draft.random.direction<3>()), Vec<3>::UnitX()};
    const Swing angle{0.0, draft.random.between(-1.0, 1.0), omega, start};
    draft.add(call_text("OnSurface", p.text, text,
                        "rotating about " + write<3>(axis.point) + write<3>(axis.direction), angle.amplitude,
                        omega),
              OnSurface{handle(p), RotatingAbout{surface, axis, angle}});
  } else {
    draft.add(call_text("OnSurface", p.text, text), OnSurface{handle(p), surface});
  }
}

void add_plane(Draft<3>& draft, const Place<3>& p) {
  const Plane<3> plane{p.r, draft.numbers(draft.arrow(1.0))};
  place_surface(draft, p, plane, "Plane<3>" + write<3>(plane.normal));
}
void add_sphere(Draft<3>& draft, const Place<3>& p) {
  const Vec<3> centre = p.r + draft.arrow(draft.plan.length);
  const Sphere<3> sphere{draft.numbers(centre), draft.number((p.r - centre).norm())};
  place_surface(draft, p, sphere, "Sphere<3>" + write<3>(sphere.centre) + write(sphere.radius));
}
void add_cylinder(Draft<3>& draft, const Place<3>& p) {
  const Vec<3> point = p.r + draft.arrow(draft.plan.length);
  const Vec<3> axis = draft.numbers(draft.arrow(1.0));
  const double radius = draft.number(axis.normalized().cross(p.r - point).norm());
  place_surface(draft, p, Cylinder{point, axis, radius},
                "Cylinder" + write<3>(point) + write<3>(axis) + write(radius));
}
void add_cone(Draft<3>& draft, const Place<3>& p) {
  const Vec<3> apex = p.r + draft.arrow(draft.plan.length);
  const Vec<3> d = p.r - apex;
  Vec<3> axis = draft.random.direction<3>();
  if (axis.dot(d) < 0.0) axis = -axis;
  const double half_angle = draft.number(std::atan2(axis.cross(d).norm(), axis.dot(d)));
  place_surface(draft, p, Cone{apex, axis, half_angle},
                "Cone" + write<3>(apex) + write<3>(axis) + write(half_angle));
}

void add_in_plane(Draft<3>& draft, const Place<3>& p) {
  const Vec<3> point = p.r + draft.plan.length * draft.random.direction<3>();
  const Axis axis{draft.numbers(point), draft.numbers(draft.random.direction<3>()), p.r - point};
  const Swing angle{0.0, draft.size(1.0), draft.size(1.0 / draft.plan.time), draft.plan.options.t_start};
  draft.add(call_text("RotatingPlane", p.text, write<3>(axis.point), write<3>(axis.direction),
                      write<3>(axis.zero), angle.amplitude, angle.omega),
            RotatingPlane{handle(p), axis, angle});
}

}  // namespace

void add_on_surface(Draft<3>& draft) {
  const Place<3> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  switch (draft.random.below(5)) {
    case 0:
      return add_plane(draft, p);
    case 1:
      return add_sphere(draft, p);
    case 2:
      return add_cylinder(draft, p);
    case 3:
      return add_cone(draft, p);
    default:
      return add_in_plane(draft, p);
  }
}

/// A disk of its own, leaning on a plane that touches its rim, and rolling on it or sliding.
void add_disk(Draft<3>& draft) {
  LaminaState state;
  state.mass = draft.size(draft.plan.mass);
  const double radius = draft.size(draft.plan.length);
  state.inertia = draft.number(0.25 * state.mass * radius * radius) * Vec<2>::Ones();
  state.centre = draft.numbers(draft.plan.length * draft.random.vector<3>());
  state.axes =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), eigen(draft.random.direction<3>()))
          .toRotationMatrix();
  if (draft.plan.moving) state.angular_velocity = draft.random.vector<3>() / draft.plan.time;
  Vec<3> N = draft.random.direction<3>();
  const double lean = N.cross(state.axes.col(2)).norm();
  if (lean < 0.2 && draft.plan.kind == Plan::Kind::sensible) return;
  N = draft.numbers(N);
  const Plane<3> plane{state.centre - radius * lean * N, N};
  const std::string text =
      call_text("disk", state.mass, radius, write<3>(state.centre), write<3>(state.axes.col(2)), write<3>(N),
                write<3>(state.angular_velocity));
  draft.attempt(text, [&] {
    const Lamina disk = add_lamina(draft.scene, state, draft.body_name());
    const auto c = disk.centre(), a = disk.point({radius, 0.0}), b = disk.point({0.0, radius});
    draft.add("  its DiskContact", DiskContact{c, a, b, radius, plane});
    if (draft.random.chance(0.6)) draft.add("  its DiskRolling", DiskRolling{c, a, b, radius, plane});
  });
}

}  // namespace dalembert::fuzz
