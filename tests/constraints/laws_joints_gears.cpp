#include "laws_joints.h"

namespace dalembert::laws::laws_joints_gears_test {
namespace {

// clang-format off: one line for each joint
const bool registered = [] {
  joint_of_bodies<3>("Screw", 5, [](auto& at, auto a, auto b) {
    return Screw{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5), 0.8};
  });
  joint_of_bodies<3>("Gear", 1, [](auto& at, auto a, auto b) {
    return Gear{a,  b, at.point(0.1, 0.3, 0.7), at.point(0.9, -0.2, 0.8), at.direction(1.0, -2.0, 0.5),
                10, 15};
  });
  joint_of_bodies<3>("InternalGear", 1, [](auto& at, auto a, auto b) {
    return Gear{a,  b,  at.point(0.1, 0.3, 0.7), at.point(0.9, -0.2, 0.8), at.direction(1.0, -2.0, 0.5),
                10, -15};
  });
  joint_of_bodies<3>("RackAndPinion", 1, [](auto& at, auto a, auto b) {
    return RackAndPinion{a, b, at.point(0.1, 0.3, 0.7), at.point(1.1, -1.7, 1.2),
                         at.direction(2.0, 1.0, 0.0)};
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_joints_gears_test
