#include "laws_joints.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace dalembert::laws::laws_joints_drives_test {
namespace {

/// A drive of an angle with its hinge: without one, bodies that tilt have no angle to speak of.
template <int D, class J>
void driven_joint(const std::string& type, int rows, const J& joint) {
  const Case<D> c{
      type, rows, [joint](Scene<D>& scene, const Placement<D>& at, const Bodies<D>& b) {
        const auto hinge = joint(at, b[0], b[1]);
        scene.add(hinge);
        scene.add(AngleDrive{hinge, scene.add_rotor({.inertia = 0.2}), [](auto t) { return sin(t); }});
      }};
  register_case<D>("ActsOnBothBodiesAlike", c, expect_action_is_reaction<D>);
  register_laws(c);
}

/// They act on both alike, by couples about the axis: at the stated angle 0 of 1.7 * 0.4 less 0.6 times its
/// rate.
void expect_no_resultant(const Case<3>& c) {
  const Built<3> built(c);
  const State s = stated(built);
  const Eigen::VectorXd F = values(built.system, s).F;
  const Vec<3> axis = Vec<3>(1.0, -2.0, 0.5).normalized();
  std::array<Vec<3>, 2> torque{Vec<3>::Zero(), Vec<3>::Zero()}, omega = torque;
  for (std::size_t k = 0; k < 2; ++k) {
    Vec<3> force = Vec<3>::Zero();
    for (const auto& p : built.bodies[k].particles) {
      force += F.segment<3>(p.coordinate);
      torque[k] += Vec<3>(s.q.segment<3>(p.coordinate)).cross(Vec<3>(F.segment<3>(p.coordinate)));
    }
    for (int e = 0; e < 3; ++e) {  // omega = sum e x e'/2
      const auto v = built.bodies[k].vector(Vec<3>::Unit(e));
      omega[k] += 0.5 * v.gather(s.instant().q).cross(v.gather(s.instant().v));
    }
    EXPECT_LT(force.norm(), 1e-13);  // some ten roundings
  }
  const Vec<3> expected = (1.7 * 0.4 - 0.6 * (omega[1] - omega[0]).dot(axis)) * axis;
  EXPECT_LT((torque[1] - expected).norm(), 1e-13);
  EXPECT_LT((torque[0] + expected).norm(), 1e-13);
}

/// A torsion spring and a damper: forces F, whose derivatives are checked with those of the joint.
void sprung_joint() {
  const Case<3> c{"TorsionSpringAndDamper", 5,
                  [](Scene<3>& scene, const Placement<3>& at, const Bodies<3>& b) {
                    const Revolute hinge{b[0], b[1], at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
                    scene.add(hinge);
                    scene.add(TorsionSpring{hinge, 1.7, 0.4});
                    scene.add(TorsionDamper{hinge, 0.6});
                  }};
  register_case<3>("DifferentiatesItsEquation", c, expect_derivatives<3>);
  register_case<3>("TurnsBothBodiesAlike", c, expect_no_resultant);
}

// clang-format off: one line for each joint
const bool registered = [] {
  driven_joint<3>("AngleDrive", 7, [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)};
  });
  driven_joint<2>("AngleDrive", 4, [](auto& at, auto a, auto b) {
    return Revolute{a, b, at.point(0.1, 0.3)};
  });
  joint_of_bodies<3>("PathDrive", 1, [](auto& at, auto a, auto b) {
    return PathDrive{Prismatic{a, b, at.point(0.1, 0.3, 0.7), at.direction(1.0, -2.0, 0.5)},
                     [](auto t) { return sin(t); }};
  });
  sprung_joint();
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_joints_drives_test
