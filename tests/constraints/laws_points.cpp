#include "laws.h"
#include <dalembert/constraints/bodies/rigid_body.h>
#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/distance.h>

namespace dalembert::laws::laws_points_test {
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
  any<2>("DistanceFromAPointOfABody", [](auto& scene, auto&, auto a, auto b) {
    scene.add(Distance{RigidBody<2>{{a, b}, {}, {0.7, 0.7}}.point({0.3, -0.5}), Fixed<2>{{0.1, 0.2}}, 1.3});
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_points_test
