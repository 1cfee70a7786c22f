#include "laws.h"
#include <dalembert/constraints/geometry/moving.h>
#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/on_surface.h>
#include <dalembert/constraints/point_line_distance.h>
#include <dalembert/constraints/prescribed.h>
#include <dalembert/constraints/rotating_plane.h>

namespace dalembert::laws::laws_moving_test {
namespace {

// clang-format off: one line for each constraint type
const bool registered = [] {
  geometric<2>("LineOffsetFromFixedPoints", [](auto& scene, auto& at, auto a, auto) {
    scene.add(PointLineDistance{a, at.fixed(0.1, 0.2), at.fixed(2.0, 0.9), 0.3});
  });
  invariant<2>("LineOffsetFromALineThatTurns", [](auto& scene, auto& at, auto a, auto b) {
    scene.add(PointLineDistance{a, driven([at](auto t) { return at.point(t, sin(t)); }), b, 0.3});
  });
  any<2>("PrescribedPosition", [](auto& scene, auto&, auto a, auto) {
    scene.add(Prescribed{a, [](auto t) { return vec(sin(t), t * t); }});
  });
  any<2>("PrescribedAngle", [](auto& scene, auto&, auto, auto) {
    scene.add(Prescribed{scene.add_rotor({.inertia = 1.0}), [](auto t) { return vec(t * t * t); }});
  });
  geometric<3>("RotatingPlane", [](auto& scene, auto& at, auto a, auto) {
    const Axis axis{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0), at.direction(2.0, 1.0, 0.5)};
    scene.add(RotatingPlane{a, axis, [](auto t) { return t * t; }});
  });
  geometric<2>("OnCurveTranslating", [](auto& scene, auto& at, auto a, auto) {
    const auto path = [at](auto t) { return (at.point(sin(t), t) - at.point(0.0 * t, 0.0 * t)).eval(); };
    scene.add(OnCurve{a, Translating{Sphere<2>{at.point(0.1, 0.2), 0.6}, path}});
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
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_moving_test
