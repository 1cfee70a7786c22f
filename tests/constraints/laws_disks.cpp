#include "laws.h"
#include <dalembert/constraints/disk_on_plane.h>
#include <dalembert/constraints/upright_rolling.h>

namespace dalembert::laws::laws_disks_test {
namespace {

// clang-format off: one line for each constraint type
const bool registered = [] {
  invariant<3>("DiskContact", [](auto& scene, auto& at, auto a, auto b) {
    const Plane<3> plane{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0)};
    scene.add(DiskContact{a, b, at.fixed(0.3, 1.4, -0.2), 0.8, plane});
  });
  invariant<3>("DiskRolling", [](auto& scene, auto& at, auto a, auto b) {
    const Plane<3> plane{at.point(0.1, 0.2, 0.3), at.direction(1.0, 2.0, -2.0)};
    scene.add(DiskRolling{a, b, at.fixed(0.3, 1.4, -0.2), 0.8, plane});
  });
  any<2>("UprightRolling", [](auto& scene, auto&, auto a, auto) {
    scene.add(UprightRolling{a, scene.add_rotor({.inertia = 1.0}), scene.add_rotor({.inertia = 2.0}), 0.4});
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_disks_test
