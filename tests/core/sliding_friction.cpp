#include "dalembert/core/forces/sliding_friction.h"

#include "../equations.h"
#include <dalembert/dalembert.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace dalembert::sliding_friction_test {
namespace {

/// Two particles on spheres, one rough; and a third that does not slide, of the same type.
class Slides : public testing::Test {
 protected:
  Scene<3> scene{"slides"};
  Particle<3> a = scene.add_particle({.mass = 1.0});
  Particle<3> b = scene.add_particle({.mass = 2.0});
  Sphere<3> sphere{{0.1, 0.2, 0.3}, 1.5};
  Constraint<1> first = scene.add(OnSurface{a, sphere}), second = scene.add(OnSurface{b, sphere});
  Constraint<2> held = scene.add(coulomb(first, Slip{a, sphere}, 0.3), "held");
  Constraint<2> slides = scene.add(coulomb(second, Slip{b, sphere, {0.2, 0.0, 0.0}}, 0.4), "slides");
  State state{0.0, Eigen::VectorXd(6), Eigen::VectorXd(6)};

  Slides() {
    state.q << 1.2, 0.5, -0.9, -0.7, 1.1, 0.8;
    state.v << 0.3, -0.2, 0.5, 0.8, 0.4, -0.6;
  }
  [[nodiscard]] System sliding(double slow) const {
    const std::vector<System::Slide> all{{static_cast<std::size_t>(slides.index), 0.4, {0.6, -0.8}, slow}};
    return scene.system().sliding(all);
  }
};

TEST_F(Slides, FrictionOpposesTheSlipInProportionToTheNormalForce) {
  const System system = sliding(0.0);
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(system.rows()));
  const auto& layout = *system.layout();
  lambda[layout.constraints[static_cast<std::size_t>(second.index)].first_row] = 7.0;
  const Eigen::VectorXd F = friction(system, state, lambda);
  // By hand: the part of v - belt along the sphere.
  const Vec<3> n = (state.q.tail<3>() - sphere.centre).normalized();
  const Vec<3> v = state.v.tail<3>() - Vec<3>(0.2, 0.0, 0.0), along = v - n * n.dot(v);
  EXPECT_TRUE(Vec<3>(F.tail<3>()).isApprox(-0.4 * 7.0 * along.normalized(), 1e-14)) << F.transpose();
  EXPECT_TRUE(F.head<3>().isZero());
  EXPECT_TRUE(system.in_force(
      static_cast<std::size_t>(layout.constraints[static_cast<std::size_t>(held.index)].first_row)));
  EXPECT_FALSE(system.in_force(
      static_cast<std::size_t>(layout.constraints[static_cast<std::size_t>(slides.index)].first_row)));
}

TEST_F(Slides, DerivativesAreConsistent) {
  for (const double slow : {0.0, 0.3}) {
    const System system = sliding(slow);
    Eigen::VectorXd lambda(static_cast<Eigen::Index>(system.rows()));
    for (Eigen::Index r = 0; r < lambda.size(); ++r)
      lambda[r] = system.in_force(static_cast<std::size_t>(r)) ? 1.0 + 0.7 * static_cast<double>(r) : 0.0;
    expect_consistent(system, state, lambda);
  }
}

TEST_F(Slides, SlipIsOrthogonalToTheGradientOfEachSurface) {
  // Slip by Slip, against the gradient that the constraint itself has.
  const auto check = [](const auto& surface, const Vec<3>& r) {
    Scene<3> s;
    const auto p = s.add_particle({.mass = 1.0, .position = r});
    s.add(OnSurface{p, surface});
    s.add(Slip{p, surface});
    const auto W = values(s.system(), {0.0, r, Vec<3>(0.1, 0.2, 0.3)}).W;
    EXPECT_TRUE((W * W.transpose()).isApprox(Eigen::Matrix3d::Identity(), 1e-13)) << W;
  };
  const Vec<3> tilted = Vec<3>(0.3, -0.4, 0.5).normalized(), r(0.7, -1.1, -0.4);
  check(Plane<3>{Vec<3>::Zero(), tilted}, r);
  check(Sphere<3>{Vec<3>(0.1, 0.2, 0.3), 2.0}, r);
  check(Cylinder{Vec<3>::Zero(), tilted, 0.5}, r);
  check(Cone{Vec<3>(0.0, 0.0, -3.0), tilted, 0.6}, r);
}

}  // namespace
}  // namespace dalembert::sliding_friction_test
