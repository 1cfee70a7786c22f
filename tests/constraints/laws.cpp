#include "laws.h"

#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/disk_on_plane.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/heading.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/in_plane.h>
#include <dalembert/constraints/line_offset.h>
#include <dalembert/constraints/moving.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/on_surface.h>
#include <dalembert/constraints/prescribed.h>
#include <dalembert/constraints/pursuit.h>
#include <dalembert/constraints/rigid_body.h>
#include <dalembert/constraints/rolling.h>
#include <dalembert/constraints/upright_rolling.h>

namespace dalembert::laws {
namespace {

// clang-format off: one line for each constraint type
const bool registered = [] {
  geometric<2>("PlanarDistanceFromAFixedPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Distance{at.fixed(0.1, 0.2), a, 1.3});
  });
  geometric<2>("PlanarDistanceBetweenParticles", [](auto& scene, auto&, auto a, auto b) {
    scene.add(Distance{a, b, 1.3});
  });
  geometric<2>("PlanarDistanceFromADrivenPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Distance{driven([at](auto t) { return at.point(sin(t), t * t); }), a, 1.3});
  });
  geometric<3>("SpatialDistanceFromAFixedPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Distance{at.fixed(0.1, 0.2, 0.3), a, 1.3});
  });
  geometric<3>("SpatialDistanceBetweenParticles", [](auto& scene, auto&, auto a, auto b) {
    scene.add(Distance{a, b, 1.3});
  });
  geometric<3>("SpatialDistanceToADrivenPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Distance{a, driven([at](auto t) { return at.point(sin(t), t * t, 1.0); }), 1.3});
  });
  geometric<2>("PlanarCoincidentParticles", [](auto& scene, auto&, auto a, auto b) {
    scene.add(Coincident{a, b});
  });
  geometric<3>("SpatialCoincidentWithAFixedPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Coincident{a, at.fixed(0.1, 0.2, 0.3)});
  });
  geometric<2>("PlanarCoincidentWithADrivenPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Coincident{driven([at](auto t) { return at.point(cos(t), t * t * t); }), a});
  });
  geometric<2>("OnCurvePlane", [](auto& scene, auto& at, auto a, auto) {
    scene.add(OnCurve{a, Plane<2>{at.point(0.1, 0.2), at.direction(3.0, 4.0)}});
  });
  geometric<2>("OnCurveSphere", [](auto& scene, auto& at, auto, auto b) {
    scene.add(OnCurve{b, Sphere<2>{at.point(0.1, 0.2), 1.5}});
  });
  any<2>("OnCurveLambda", [](auto& scene, auto&, auto a, auto) {
    scene.add(OnCurve{a, [](auto r) { return r.y() - r.x() * r.x(); }});
  });
  any<2>("OnCurveThatMoves", [](auto& scene, auto&, auto a, auto) {
    scene.add(OnCurve{a, [](auto t, auto r) { return r.y() - sin(r.x() - t); }});
  });
  geometric<3>("OnSurfacePlane", [](auto& scene, auto& at, auto a, auto) {
    scene.add(OnSurface{a, Plane<3>{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0)}});
  });
  geometric<3>("OnSurfaceSphere", [](auto& scene, auto& at, auto, auto b) {
    scene.add(OnSurface{b, Sphere<3>{at.point(0.1, 0.2, 0.3), 1.5}});
  });
  geometric<3>("OnSurfaceCylinder", [](auto& scene, auto& at, auto a, auto) {
    scene.add(OnSurface{a, Cylinder{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0), 0.7}});
  });
  geometric<3>("OnSurfaceCone", [](auto& scene, auto& at, auto a, auto) {
    scene.add(OnSurface{a, Cone{at.point(0.1, 0.2, 0.3), at.direction(1.0, -2.0, 2.0), 0.6}});
  });
  any<3>("OnSurfaceThatMoves", [](auto& scene, auto&, auto a, auto) {
    scene.add(OnSurface{a, [](auto t, auto r) { return r.z() - t * r.x() * r.y(); }});
  });
  any<2>("ScleronomicHolonomic", [](auto& scene, auto&, auto a, auto b) {
    scene.add(holonomic(points(a, b), [](auto r_a, auto r_b) {
      return r_a.x() * r_b.y() - exp(r_a.y()) + r_b.squaredNorm();
    }));
  });
  any<2>("RheonomicHolonomic", [](auto& scene, auto&, auto a, auto b) {
    scene.add(holonomic(points(a, b),
                        [](auto t, auto r_a, auto r_b) { return r_a.x() * sin(t * r_b.y()) + t * t * t; }));
  });
  any<3>("HolonomicOfTwoEquations", [](auto& scene, auto&, auto a, auto b) {
    scene.add(holonomic(points(b, a), [](auto t, auto r_b, auto r_a) {
      return vec(r_a.dot(r_b) - t, r_a.cross(r_b).norm());
    }));
  });
  any<2>("HolonomicOfADrivenPoint", [](auto& scene, auto&, auto a, auto) {
    scene.add(holonomic(points(driven([](auto t) { return vec(t, sin(t)); }), a),
                        [](auto r_d, auto r_a) { return r_d.x() * r_a.x() + r_d.y() * r_a.y(); }));
  });
  any<2>("ScleronomicNonholonomic", [](auto& scene, auto&, auto a, auto) {
    scene.add(
        nonholonomic(points(a), [](auto r, auto v) { return v.y() * cos(r.x()) - r.y() * r.x() * v.x(); }));
  });
  any<2>("RheonomicNonholonomic", [](auto& scene, auto&, auto a, auto) {
    scene.add(nonholonomic(points(a),
                           [](auto t, auto r, auto v) { return v.y() - sin(t * r.x()) * v.x() - t * t; }));
  });
  any<3>("NonholonomicOfTwoEquations", [](auto& scene, auto&, auto a, auto b) {
    scene.add(nonholonomic(points(a, b), [](auto r_a, auto r_b, auto v_a, auto v_b) {
      return vec(v_a.dot(r_b), r_a.cross(v_b).x());
    }));
  });
  any<2>("NonholonomicOfADrivenPoint", [](auto& scene, auto&, auto a, auto) {
    scene.add(nonholonomic(points(a, driven([](auto t) { return vec(t, sin(2.0 * t)); })),
                           [](auto r_a, auto r_d, auto v_a, auto v_d) {
                             return (r_d - r_a).dot(v_d - v_a) + r_d.x() * v_d.y();
                           }));
  });
  invariant<2>("PursuitOfADrivenPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(nonholonomic(points(a, driven([at](auto t) { return at.point(t, sin(2.0 * t)); })),
                           [](auto r_a, auto r_d, auto v_a, auto) {
                             return v_a.x() * (r_d - r_a).y() - v_a.y() * (r_d - r_a).x();
                           }));
  });
  invariant<3>("DiskContact", [](auto& scene, auto& at, auto a, auto b) {
    const Plane<3> plane{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0)};
    scene.add(DiskContact{a, b, at.fixed(0.3, 1.4, -0.2), 0.8, plane});
  });
  invariant<3>("DiskRolling", [](auto& scene, auto& at, auto a, auto b) {
    const Plane<3> plane{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0)};
    scene.add(DiskRolling{a, b, at.fixed(0.3, 1.4, -0.2), 0.8, plane});
  });
  geometric<2>("LineOffsetFromFixedPoints", [](auto& scene, auto& at, auto a, auto) {
    scene.add(LineOffset{a, at.fixed(0.1, 0.2), at.fixed(2.0, 0.9), 0.3});
  });
  invariant<2>("LineOffsetFromALineThatTurns", [](auto& scene, auto& at, auto a, auto b) {
    scene.add(LineOffset{a, driven([at](auto t) { return at.point(t, sin(t)); }), b, 0.3});
  });
  any<2>("RollingOnATrackThatTurns", [](auto& scene, auto&, auto a, auto b) {
    scene.add(
        Rolling{a, scene.add_rotor({.inertia = 1.0}), driven([](auto t) { return vec(t, sin(t)); }), b, 0.4});
  });
  any<2>("UprightRolling", [](auto& scene, auto&, auto a, auto) {
    scene.add(UprightRolling{a, scene.add_rotor({.inertia = 1.0}), scene.add_rotor({.inertia = 2.0}), 0.4});
  });
  invariant<2>("HeadingAlongADrivenDirection", [](auto& scene, auto& at, auto a, auto b) {
    scene.add(Heading{a, b, driven([at](auto t) { return at.point(2.0 + t, sin(t)); })});
  });
  invariant<2>("Pursuit", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Pursuit{a, driven([at](auto t) { return at.point(0.5 * t, 2.0 + sin(t)); })});
  });
  any<2>("PrescribedPosition", [](auto& scene, auto&, auto a, auto) {
    scene.add(Prescribed{a, [](auto t) { return vec(sin(t), t * t); }});
  });
  any<2>("PrescribedAngle", [](auto& scene, auto&, auto, auto) {
    scene.add(Prescribed{scene.add_rotor({.inertia = 1.0}), [](auto t) { return vec(t * t * t); }});
  });
  geometric<3>("InPlane", [](auto& scene, auto& at, auto a, auto) {
    const Axis axis{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0), at.direction(2.0, 1.0, 0.5)};
    scene.add(InPlane{a, axis, [](auto t) { return t * t; }});
  });
  geometric<2>("OnCurveTranslating", [](auto& scene, auto& at, auto a, auto) {
    const Vec<2> shift = at.direction(0.3, 0.8);
    scene.add(OnCurve{a, Translating{Sphere<2>{at.point(0.1, 0.2), 0.6},
                                     [shift](auto t) { return vec(shift.x() * sin(t), shift.y() * t); }}});
  });
  geometric<2>("OnCurveRotating", [](auto& scene, auto& at, auto a, auto) {
    const Plane<2> line{at.point(0.1, 0.2), at.direction(3.0, 4.0)};
    scene.add(OnCurve{a, Rotating{line, at.point(1.0, -1.0), [](auto t) { return t * t; }}});
  });
  geometric<3>("OnSurfaceRotatingAbout", [](auto& scene, auto& at, auto a, auto) {
    const Axis axis{at.point(0.5, 0.2, 0.3), at.direction(1.0, 2.0, -2.0), at.direction(2.0, 1.0, 0.5)};
    const Cone cone{at.point(0.1, 0.2, 0.3), at.direction(1.0, -2.0, 2.0), 0.6};
    scene.add(OnSurface{a, RotatingAbout{cone, axis, [](auto t) { return t * t; }}});
  });
  any<2>("DistanceFromAPointOfABody", [](auto& scene, auto&, auto a, auto b) {
    scene.add(Distance{RigidBody<2>{{a, b}, {}, {0.7, 0.7}}.point({0.3, -0.5}), Fixed<2>{{0.1, 0.2}}, 1.3});
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws
