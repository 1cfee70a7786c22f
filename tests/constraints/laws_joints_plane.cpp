#include "laws_joints.h"

namespace dalembert::laws::laws_joints_plane_test {
namespace {

// clang-format off: one line for each joint
const bool registered = [] {
  joint_of_bodies<2>("Weld", 3, [](auto& at, auto a, auto b) { return Weld{a, b, at.point(0.1, 0.3)}; });
  joint_of_bodies<2>("Revolute", 2, [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3)};
  });
  joint_of_ground<2>("Revolute", 2, [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3)};
  });
  joint_of_bodies<2>("Prismatic", 2, [](auto& at, auto a, auto b) {
    return Prismatic{a, b, at.point(0.1, 0.3), at.direction(1.0, -2.0)};
  });
  joint_of_ground<2>("Prismatic", 2, [](auto& at, auto a, auto b) {
    return Prismatic{a, b, at.point(0.1, 0.3), at.direction(1.0, -2.0)};
  });
  joint_of_bodies<2>("Gear", 1, [](auto& at, auto a, auto b) {
    return Gear{a, b, at.point(0.1, 0.3), at.point(0.9, -0.2), 10, 15};
  });
  joint_of_bodies<2>("RackAndPinion", 1, [](auto& at, auto a, auto b) {
    return RackAndPinion{a, b, at.point(0.1, 0.3), at.point(1.1, -1.7)};
  });
  joint_of_bodies<2>("PathDrive", 1, [](auto& at, auto a, auto b) {
    return PathDrive{Prismatic{a, b, at.point(0.1, 0.3), at.direction(1.0, -2.0)},
                     [](auto t) { return sin(t); }};
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_joints_plane_test
