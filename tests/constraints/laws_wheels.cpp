#include "laws.h"
#include <dalembert/constraints/knife_edge.h>
#include <dalembert/constraints/pursuit.h>
#include <dalembert/constraints/rolling.h>

namespace dalembert::laws::laws_wheels_test {
namespace {

// clang-format off: one line for each constraint type
const bool registered = [] {
  any<2>("RollingOnATrackThatTurns", [](auto& scene, auto&, auto a, auto b) {
    scene.add(
        Rolling{a, scene.add_rotor({.inertia = 1.0}), driven([](auto t) { return vec(t, sin(t)); }), b, 0.4});
  });
  invariant<2>("HeadingAlongADrivenDirection", [](auto& scene, auto& at, auto a, auto b) {
    scene.add(KnifeEdge{a, b, driven([at](auto t) { return at.point(2.0 + t, sin(t)); })});
  });
  invariant<2>("Pursuit", [](auto& scene, auto& at, auto a, auto) {
    scene.add(Pursuit{a, driven([at](auto t) { return at.point(0.5 * t, 2.0 + sin(t)); })});
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_wheels_test
