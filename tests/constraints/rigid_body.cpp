#include <dalembert/dalembert.h>
#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>

namespace dalembert::rigid_body_test {
namespace {

constexpr double round_off = 50.0 * std::numeric_limits<double>::epsilon();  // some ten operations

/// Bodies from a ball to a needle and a plate a hundred thousand times longer than thick.
class Body : public testing::TestWithParam<Vec<3>> {
 protected:
  static BodyState<3> state() {
    const Vec<3> moments = GetParam();  // of second order, over the mass
    return {.mass = 3.0,
            .inertia = 3.0 * (Vec<3>::Constant(moments.sum()) - moments),
            .centre = {0.3, -0.2, 0.7},
            .axes = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix(),
            .velocity = {1.0, 0.5, -2.0},
            .angular_velocity = {0.6, -1.3, 0.9}};
  }
};

INSTANTIATE_TEST_SUITE_P(BallNeedlePlate, Body,
                         testing::Values(Vec<3>(0.2, 0.2, 0.2), Vec<3>(0.3, 0.1, 0.2),
                                         Vec<3>(1.0, 1e-10, 2e-10), Vec<3>(0.5, 1.0, 1e-10)));

TEST_P(Body, HasTheMassCentreAndInertiaOfItsState) {
  Scene<3> scene;
  const BodyState<3> s = state();
  const auto body = add_body<3>(scene, s, "body");
  const auto masses = scene.system();
  Vec<3> centre = Vec<3>::Zero();
  double mass = 0.0;
  Mat<3, 3> inertia = Mat<3, 3>::Zero();
  for (const auto& p : body.particles) {
    const double m = masses.masses()[static_cast<std::size_t>(p.coordinate)];
    const Vec<3> arm = s.axes.transpose() * (p.gather(scene.initial_positions()) - s.centre);
    mass += m;
    centre += m * arm;
    inertia += m * (arm.squaredNorm() * Mat<3, 3>::Identity() - arm * arm.transpose());
  }
  EXPECT_NEAR(mass, s.mass, round_off);
  EXPECT_LT(centre.norm(), round_off);
  EXPECT_LT((inertia - Eigen::Matrix3d(eigen(s.inertia).asDiagonal())).norm(), round_off);
}

TEST_P(Body, EveryPointOfItMovesAsARigidBodyDoes) {
  Scene<3> scene;
  const BodyState<3> s = state();
  const auto body = add_body<3>(scene, s, "body");
  const Vec<3> local(0.7, -1.2, 0.4);
  const Vec<3> arm = s.axes * local;
  const auto point = body.point(local);
  EXPECT_LT((point.gather(scene.initial_positions()) - (s.centre + arm)).norm(), round_off);
  EXPECT_LT((point.gather(scene.initial_velocities()) - (s.velocity + s.angular_velocity.cross(arm))).norm(),
            round_off);
  const Simulation<3> at(scene, {.t_end = 1.0});
  EXPECT_LT((body.axes(at.sample()) - s.axes).norm(), round_off);
}

// A body hangs by a point 0.4 off its axis from a ball joint that exerts F. A particle's part of F at x is at
// most F (|x|/R + 1); the rods between them meet at angles from 45 degrees to 120, so that none carries
// more than a few times that (measured: 0.3 to 0.5 F; with equal masses a
// rod a hundred times longer than thick carried 400 F).
TEST_P(Body, CarriesForcesOfTheSizeOfItsLoadInside) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
  BodyState<3> s = state();
  s.angular_velocity.setZero();
  s.velocity.setZero();
  const auto body = add_body<3>(scene, s, "body");
  const Vec<3> x(0.1, 0.4, 0.4);
  const auto joint = scene.add(Coincident{Fixed<3>{s.centre + s.axes * x}, body.point(x)});
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-8, .stepper = Stepper::erk});
  constexpr double few = 3.0;
  const double R = std::sqrt(4.0 / 3.0) * body.arms.norm();
  double load = 0.0, inside = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    load = std::max(load, run.multiplier(joint, i).norm());
    for (const auto& rod : body.rods) inside = std::max(inside, std::abs(run.multiplier(rod, i)));
  }
  EXPECT_LT(inside, few * load * (x.norm() / R + 1.0));
  RecordProperty("inside_over_load", std::to_string(inside / load));
}

/// All of a body is added, or nothing.
TEST(BodiesOfTakenNames, LeaveTheSceneAsItWas) {
  for (const char* taken : {"b.p2", "b.rod12"}) {
    Scene<2> scene;
    scene.add_particle({.mass = 1.0}, taken);
    EXPECT_THROW((void)add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 1.0}, "b"), InvalidScene)
        << taken;
    EXPECT_EQ(scene.initial_positions().size(), 2U) << taken;
  }
  for (const char* taken : {"r.p2", "r.rod"}) {
    Scene<2> scene;
    scene.add_particle({.mass = 1.0}, taken);
    EXPECT_THROW((void)add_thin_rod(scene, ThinRodState<2>{.mass = 1.0, .end = {1.0, 0.0}}, "r"),
                 InvalidScene);
    EXPECT_EQ(scene.initial_positions().size(), 2U) << taken;
  }
  for (const char* taken : {"l.p3", "l.rod13"}) {
    Scene<3> scene;
    scene.add_particle({.mass = 1.0}, taken);
    EXPECT_THROW((void)add_lamina(scene, LaminaState{.mass = 1.0, .inertia = {1.0, 1.0}}, "l"), InvalidScene);
    EXPECT_EQ(scene.initial_positions().size(), 3U) << taken;
  }
}

TEST(PlaceInABody, OfNoFiniteNumberIsRefused) {
  Scene<2> plane;
  Scene<3> space;
  const auto rod =
      add_thin_rod(plane, ThinRodState<2>{.mass = 1.0, .start = {0.0, 0.0}, .end = {1.0, 0.0}}, "rod");
  const auto plate = add_lamina(space, LaminaState{.mass = 1.0, .inertia = {1.0, 1.0}}, "plate");
  const auto flat = add_body(plane, BodyState<2>{.mass = 1.0, .inertia = 1.0}, "flat");
  const auto solid = add_body(space, BodyState<3>{.mass = 1.0, .inertia = {1.0, 1.0, 1.0}}, "solid");
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)rod.point(bad), InvalidArgument);
    EXPECT_THROW((void)plate.point({0.0, bad}), InvalidArgument);
    EXPECT_THROW((void)flat.point({0.0, bad}), InvalidArgument);
    EXPECT_THROW((void)solid.point({0.0, 0.0, bad}), InvalidArgument);
    EXPECT_THROW((void)solid.vector({bad, 0.0, 0.0}), InvalidArgument);
    EXPECT_THROW((void)solid.point_at({bad, 0.0, 0.0}), InvalidArgument);
  }
}

// Not the hidden particles, which their user has never heard of.
TEST(Body, IsNamedWhereItsStateIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto expect_refused = [](auto scene, const auto& add, const char* name) {
      try {
        add(scene);
        ADD_FAILURE() << name << " was added";
      } catch (const InvalidScene& error) {
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find("p1"), std::string::npos) << error.what();
      }
      EXPECT_TRUE(scene.initial_positions().empty());
    };
    for (const BodyState<2>& state : {BodyState<2>{.mass = 1.0, .inertia = 1.0, .centre = {bad, 0.0}},
                                      BodyState<2>{.mass = 1.0, .inertia = 1.0, .angle = bad},
                                      BodyState<2>{.mass = 1.0, .inertia = 1.0, .angular_velocity = bad}})
      expect_refused(
          Scene<2>{}, [&](auto& scene) { (void)add_body(scene, state, "b"); }, "Body \"b\"");
    for (const BodyState<3>& state :
         {BodyState<3>{.mass = 1.0, .inertia = {1.0, 1.0, 1.0}, .velocity = {0.0, bad, 0.0}},
          BodyState<3>{.mass = 1.0, .inertia = {1.0, 1.0, 1.0}, .angular_velocity = {0.0, bad, 0.0}}})
      expect_refused(
          Scene<3>{}, [&](auto& scene) { (void)add_body(scene, state, "b"); }, "Body \"b\"");
    const LaminaState plate{.mass = 1.0, .inertia = {1.0, 1.0}, .centre = {0.0, 0.0, bad}};
    expect_refused(
        Scene<3>{}, [&](auto& scene) { (void)add_lamina(scene, plate, "l"); }, "Lamina \"l\"");
    const ThinRodState<2> rod{.mass = 1.0, .end = {1.0, 0.0}, .end_velocity = {bad, 0.0}};
    expect_refused(
        Scene<2>{}, [&](auto& scene) { (void)add_thin_rod(scene, rod, "r"); }, "Rod \"r\"");
  }
}

}  // namespace
}  // namespace dalembert::rigid_body_test
