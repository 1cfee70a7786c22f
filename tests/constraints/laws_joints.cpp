#include "laws_joints.h"

namespace dalembert::laws {
namespace {

const bool registered = [] {
  const auto weld = [](auto& at, auto a, auto b) { return Weld{a, b, at.point(0.1, 0.3, 0.7)}; };
  const auto revolute = [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  };
  const auto prismatic = [](auto& at, auto a, auto b) {
    return Prismatic{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  };
  const auto cylindrical = [](auto& at, auto a, auto b) {
    return Cylindrical{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  };
  const auto universal = [](auto& at, auto a, auto b) {
    return Universal{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5),
                     at.direction(2.0, 1.0, 0.0)};
  };
  const auto planar = [](auto& at, auto a, auto b) {
    return Planar{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  };
  joint_of_bodies<3>("Weld", 6, weld);
  joint_of_ground<3>("Weld", 6, weld);
  joint_of_bodies<3>("Revolute", 5, revolute);
  joint_of_ground<3>("Revolute", 5, revolute);
  joint_to_ground<3>("Revolute", 5, revolute);
  joint_of_bodies<3>("Prismatic", 5, prismatic);
  joint_of_ground<3>("Prismatic", 5, prismatic);
  joint_of_bodies<3>("Cylindrical", 4, cylindrical);
  joint_of_ground<3>("Cylindrical", 4, cylindrical);
  joint_of_bodies<3>("Universal", 4, universal);
  joint_of_ground<3>("Universal", 4, universal);
  joint_of_bodies<3>("Planar", 3, planar);
  return true;
}();

}  // namespace
}  // namespace dalembert::laws
