#include "laws.h"
#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/on_surface.h>

namespace dalembert::laws::laws_surfaces_test {
namespace {

// clang-format off: one line for each constraint type
const bool registered = [] {
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
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_surfaces_test
