#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace dalembert::overconstrained_test {
namespace {

class Overconstrained : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, Overconstrained, both_steppers, stepper_name);

using Frame = Eigen::Isometry3d;

/// Four hinges, three moving bars, each hinge stated as two balls: 24 equations and 18 coordinates of bodies,
/// yet it moves, and at no position do its constraints lose rank (Bennett 1903): sin twist / length is the
/// same for all bars, and tan(first/2) tan(second/2) = K.
struct Bennett {
  static constexpr double a = 0.8, b = 1.1, twist_a = 0.6;
  Scene<3> scene{"Bennett"};
  std::vector<RigidBody<3>> body;
  std::vector<Constraint<3>> balls;
  std::vector<Vec<3>> places;

  static Frame link(const Frame& hinge, double angle, double length, double twist, Frame& bar) {
    bar = hinge * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
          Eigen::Translation3d(length / 2.0, 0.0, 0.0);
    return bar * Eigen::Translation3d(length / 2.0, 0.0, 0.0) *
           Frame(Eigen::AngleAxisd(twist, Eigen::Vector3d::UnitX()));
  }

  explicit Bennett(double first) {
    const double twist_b = std::asin(b * std::sin(twist_a) / a);
    const double K = std::sin((twist_b + twist_a) / 2.0) / std::sin((twist_b - twist_a) / 2.0);
    const double second = 2.0 * std::atan2(K * std::cos(first / 2.0), std::sin(first / 2.0));
    Frame hinge[5], bar[4];
    hinge[0] = Frame::Identity();
    hinge[1] = link(hinge[0], first, a, twist_a, bar[0]);
    hinge[2] = link(hinge[1], second, b, twist_b, bar[1]);
    hinge[3] = link(hinge[2], -first, a, twist_a, bar[2]);
    hinge[4] = link(hinge[3], -second, b, twist_b, bar[3]);
    EXPECT_LT((hinge[4].matrix() - hinge[0].matrix()).norm(), 1e-12);
    scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
    for (int i = 0; i < 3; ++i)
      body.push_back(add_body(scene,
                              BodyState<3>{.mass = 1.0,
                                           .inertia = {0.003, 0.06, 0.06},
                                           .centre = bar[i].translation(),
                                           .axes = bar[i].linear()},
                              "bar " + std::to_string(i + 1)));
    for (std::size_t i = 0; i < 4; ++i) {
      for (const double side : {-0.1, 0.1}) {
        const Vec<3> p = hinge[i].translation() + side * hinge[i].linear().col(2);
        places.push_back(p);
        if (i == 0)
          balls.push_back(scene.add(Coincident{Fixed<3>{p}, body[0].point_at(p)}));
        else if (i == 3)
          balls.push_back(scene.add(Coincident{body[2].point_at(p), Fixed<3>{p}}));
        else
          balls.push_back(scene.add(Coincident{body[i - 1].point_at(p), body[i].point_at(p)}));
      }
    }
  }

  /// The largest distance between the two halves of a ball.
  template <class Run>
  [[nodiscard]] double gap(const Run& run) const {
    double worst = 0.0;
    for (std::size_t s = 0; s < run.size(); ++s) {
      for (std::size_t k = 0; k < balls.size(); ++k) {
        const std::size_t i = k / 2;
        const Vec<3> left = i == 0 ? places[k] : Vec<3>(run.position(body[i - 1].point_at(places[k]), s));
        const Vec<3> right = i == 3 ? places[k] : Vec<3>(run.position(body[i].point_at(places[k]), s));
        worst = std::max(worst, (left - right).norm());
      }
    }
    return worst;
  }
};

/// What is read lies on the constraints to some roundings of 2 m, of which 0.1, half of a hinge's length, and
/// the angles of the rows make more.
constexpr double on_the_constraints = 1e-12;

TEST_P(Overconstrained, BennettsLinkageObeysAllItsConstraintsBetweenSteps) {
  for (const double first : {0.3, 0.93, 1.56, 2.19, 2.82}) {
    const Bennett linkage(first);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      const auto run = simulate(
          linkage.scene,
          {.t_end = 3.0, .samples = 101, .tolerance = tolerance, .stepper = GetParam(), .assemble = true});
      EXPECT_LT(linkage.gap(run), on_the_constraints) << first << ' ' << tolerance;
      for (std::size_t i = 0; i < run.size(); ++i) {
        EXPECT_NEAR(run.energy(i), run.energy(0), 3000.0 * tolerance * 9.81) << first << ' ' << tolerance;
        for (const auto& ball : linkage.balls)
          EXPECT_TRUE(run.is_determined(ball, i)) << first << ' ' << tolerance << ' ' << run.times()[i];
      }
    }
  }
}

TEST_P(Overconstrained, BennettsLinkageIsReadAtAnyTime) {
  const Bennett linkage(1.21);
  const auto run = simulate(linkage.scene, {.t_end = 3.0,
                                            .samples = 2,
                                            .tolerance = 1e-7,
                                            .stepper = GetParam(),
                                            .dense = true,
                                            .assemble = true});
  std::vector<double> times;
  for (int i = 0; i <= 1000; ++i) times.push_back(0.003 * i);
  EXPECT_LT(linkage.gap(run.at(times)), on_the_constraints);
}

/// Bars on parallel hinges, the last end of which may be kept in the plane in which it moves anyway.
struct Bars {
  Scene<3> scene{"bars"};
  std::vector<RigidBody<3>> bars;
  Vec<3> end;  // of the last, at the start

  Bars(const std::vector<double>& angles, bool in_plane) {
    scene.add(UniformGravity<3>{{0.0, -9.81, 0.0}});
    const Vec<3> z = Vec<3>::UnitZ();
    Vec<3> p = Vec<3>::Zero(), v = Vec<3>::Zero();
    for (const double angle : angles) {
      const Vec<3> x(std::cos(angle), std::sin(angle), 0.0), q = p + x, vq = v + z.cross(x);
      Eigen::Matrix3d axes;
      axes << x, z.cross(x), z;
      bars.push_back(add_body(scene,
                              BodyState<3>{.mass = 1.0,
                                           .inertia = {0.01 / 12.0, 1.0 / 12.0, 1.0 / 12.0},
                                           .centre = 0.5 * (p + q),
                                           .axes = axes,
                                           .velocity = 0.5 * (v + vq),
                                           .angular_velocity = z},
                              "bar " + std::to_string(bars.size() + 1)));
      if (bars.size() == 1)
        add_joint(scene, Revolute{Ground<3>{}, bars[0], p, z});
      else
        add_joint(scene, Revolute{bars[bars.size() - 2], bars.back(), p, z});
      p = q;
      v = vq;
    }
    end = p;
    if (in_plane) scene.add(OnSurface{bars.back().point_at(p), Plane<3>{}}, "in plane");
  }
};

/// Two and three bars are chaotic, but not yet in this time: errors of the steps grow by some hundreds.
TEST_P(Overconstrained, BarsKeptInTheirPlaneMoveAsWithoutIt) {
  for (const std::vector<double>& angles : {std::vector{0.3, 1.0}, std::vector{0.3, 1.0, 1.7}}) {
    const Bars kept(angles, true), free(angles, false);
    const auto exact =
        simulate(free.scene, {.t_end = 1.5, .samples = 31, .tolerance = 1e-11, .stepper = Stepper::erk});
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      const auto run =
          simulate(kept.scene, {.t_end = 1.5, .samples = 31, .tolerance = tolerance, .stepper = GetParam()});
      double worst = 0.0;
      for (std::size_t i = 0; i < run.size(); ++i)
        worst = std::max(worst, (run.position(kept.bars.back().point_at(kept.end), i) -
                                 exact.position(free.bars.back().point_at(free.end), i))
                                    .norm());
      EXPECT_LT(worst, 3000.0 * tolerance + 1e-8) << angles.size() << ' ' << tolerance;
    }
  }
}

TEST_P(Overconstrained, WeldedBlocksOnEachOtherStandUnderAnyLoad) {
  // Nothing can move, and the forces are known to the tolerance; the weld carries the upper block, whatever
  // round-off that load leaves to the lower one.
  for (const double mass : {1.0, 1e4, 1e6}) {
    Scene<3> scene("tower");
    scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
    const auto low =
        add_body(scene, {.mass = 1.0, .inertia = {0.17, 0.17, 0.17}, .centre = {0.0, 0.0, 0.5}}, "low");
    const Vec<3> inertia = mass * Vec<3>{0.17, 0.17, 0.17};
    const auto high = add_body(scene, {.mass = mass, .inertia = inertia, .centre = {0.0, 0.0, 1.5}}, "high");
    add_joint(scene, Weld{Ground<3>{}, low, {0.0, 0.0, 0.0}}, "base");
    const auto weld = add_joint(scene, Weld{low, high, {0.0, 0.0, 1.0}}, "weld");
    const auto run = simulate(scene, {.t_end = 5.0, .samples = 3, .tolerance = 1e-10, .stepper = GetParam()});
    EXPECT_NEAR(reaction(run.sample(2), weld).force.z(), 10.0 * mass, 1e-9 * mass) << mass;
  }
}

TEST_P(Overconstrained, DoorLocksWhereTheAxisOfOneHingeIsOff) {
  // A push of m g_y = 10 at 0.5 m from the hinges has a moment of 5. With axes (0, 0, 1) and (off, 0, 1) only
  // the upper hinge's moment T, at right angles to its axis, has a part about the other: T_x off = 5.
  for (const double off : {1e-5, 1e-3}) {
    Scene<3> scene("door");
    scene.add(UniformGravity<3>{{0.0, 1.0, -10.0}});
    const auto door =
        add_body(scene, {.mass = 10.0, .inertia = {3.0, 1.5, 4.0}, .centre = {0.5, 0.0, 1.0}}, "door");
    add_joint(scene, Revolute{Ground<3>{}, door, {0.0, 0.0, 0.2}, {0.0, 0.0, 1.0}}, "lower");
    const auto upper =
        add_joint(scene, Revolute{Ground<3>{}, door, {0.0, 0.0, 1.8}, {off, 0.0, 1.0}}, "upper");
    const auto run = simulate(scene, {.t_end = 1.0, .samples = 3, .tolerance = 1e-8, .stepper = GetParam()});
    // Positions on their constraints to a hundredth of the tolerance are gradients known to that over `off`.
    EXPECT_NEAR(reaction(run.sample(2), upper).torque.x() * off, 5.0, 5.0 * 1e-10 / off) << off;
  }
}

}  // namespace
}  // namespace dalembert::overconstrained_test
