#include "laws_joints.h"

namespace dalembert::laws::laws_joints_space_test {
namespace {

const bool registered = [] {
  const auto weld = [](auto& at, auto a, auto b) { return Weld{a, b, at.point(0.1, 0.3, 0.7)}; };
  // Of a point and an axis.
  const auto about = [](auto make) {
    return [make](auto& at, auto a, auto b) {
      return make(a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5));
    };
  };
  const auto revolute = about([](auto... stated) { return Revolute{stated...}; });
  const auto prismatic = about([](auto... stated) { return Prismatic{stated...}; });
  const auto cylindrical = about([](auto... stated) { return Cylindrical{stated...}; });
  const auto planar = about([](auto... stated) { return Planar{stated...}; });
  const auto universal = [](auto& at, auto a, auto b) {
    return Universal{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5),
                     at.direction(2.0, 1.0, 0.0)};
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
}  // namespace dalembert::laws::laws_joints_space_test
