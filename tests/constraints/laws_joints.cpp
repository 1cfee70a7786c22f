#include "laws_joints.h"

namespace dalembert::laws {
namespace {

// clang-format off: one line for each joint
const bool registered = [] {
  joint_of_bodies<3>("Weld", 6, [](auto& at, auto a, auto b) { return Weld{a, b, at.point(0.1, 0.3, 0.7)}; });
  joint_of_ground<3>("Weld", 6, [](auto& at, auto a, auto b) { return Weld{a, b, at.point(0.1, 0.3, 0.7)}; });
  joint_of_bodies<3>("Revolute", 5, [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  joint_of_ground<3>("Revolute", 5, [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  joint_to_ground<3>("Revolute", 5, [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  joint_of_bodies<3>("Prismatic", 5, [](auto& at, auto a, auto b) {
    return Prismatic{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  joint_of_ground<3>("Prismatic", 5, [](auto& at, auto a, auto b) {
    return Prismatic{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  joint_of_bodies<3>("Cylindrical", 4, [](auto& at, auto a, auto b) {
    return Cylindrical{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  joint_of_ground<3>("Cylindrical", 4, [](auto& at, auto a, auto b) {
    return Cylindrical{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  joint_of_bodies<3>("Universal", 4, [](auto& at, auto a, auto b) {
    return Universal{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5),
                     at.direction(2.0, 1.0, 0.0)};
  });
  joint_of_ground<3>("Universal", 4, [](auto& at, auto a, auto b) {
    return Universal{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5),
                     at.direction(2.0, 1.0, 0.0)};
  });
  joint_of_bodies<3>("Planar", 3, [](auto& at, auto a, auto b) {
    return Planar{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws
