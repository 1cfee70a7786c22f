#include <dalembert/dalembert.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

// Joints by hand: one door, its reactions and multipliers, springs, errors.
namespace dalembert::joints_test {
namespace {

constexpr double round_off = 1e-12;  // of forces of some 100: a hundred roundings

/// A door of mass 20, 0.8 wide and 2 high, in the plane x, z, hinged along z.
RigidBody<3> add_door(Scene<3>& scene, const Vec<3>& angular_velocity = Vec<3>::Zero()) {
  scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
  return add_body<3>(scene,
                     {.mass = 20.0,
                      .inertia = {7.0, 8.0, 1.2},
                      .centre = {0.4, 0.0, 1.0},
                      .velocity = angular_velocity.cross(Vec<3>(0.4, 0.0, 0.0)),
                      .angular_velocity = angular_velocity},
                     "door");
}

// At rest: 200 up, and the moment of the weight about the hinge's point, 0.4 from it.
TEST(Revolute, HoldsTheWeightOfADoor) {
  Scene<3> scene;
  const auto door = add_door(scene);
  const auto hinge = add_joint(scene, Revolute{Ground<3>{}, door, {0, 0, 1}, {0, 0, 1}}, "hinge");
  const Simulation<3> at(scene, {.t_end = 1.0});
  const Reaction<3> on_door = reaction(at.sample(), hinge);
  EXPECT_LT((on_door.force - Vec<3>(0, 0, 200)).norm(), 200.0 * round_off);
  EXPECT_LT((on_door.torque - Vec<3>(0, -80, 0)).norm(), 200.0 * round_off);
  EXPECT_TRUE(at.sample().is_unique(hinge));
  EXPECT_EQ(at.statistics().degrees_of_freedom, 1);
}

// Stated the other way round it is the ground that has what the door had.
TEST(Revolute, GivesTheReactionOnItsSecondBody) {
  Scene<3> scene;
  const auto door = add_door(scene);
  const auto hinge = add_joint(scene, Revolute{door, Ground<3>{}, {0, 0, 1}, {0, 0, 1}}, "hinge");
  const Simulation<3> at(scene, {.t_end = 1.0});
  EXPECT_LT((reaction(at.sample(), hinge).force - Vec<3>(0, 0, -200)).norm(), 200.0 * round_off);
  EXPECT_LT((reaction(at.sample(), hinge).torque - Vec<3>(0, 80, 0)).norm(), 200.0 * round_off);
}

// Turning at 3/s it also takes 20 * 0.4 * 9 = 72 towards the hinge; the multipliers are force and torque.
TEST(Revolute, HasMultipliersThatAreForceAndTorque) {
  Scene<3> scene;
  const auto door = add_door(scene, {0, 0, 3});
  const auto hinge = add_joint(scene, Revolute{Ground<3>{}, door, {0, 0, 1}, {0, 0, 1}}, "hinge");
  const Simulation<3> at(scene, {.t_end = 1.0});
  const Vec<5> lambda = at.multiplier(hinge);
  const Reaction<3> on_door = reaction(at.sample(), hinge);
  EXPECT_LT((lambda.head<3>() - Vec<3>(-72, 0, 200)).norm(), 200.0 * round_off);
  const Eigen::Matrix3d& axes = hinge.joint.frames.stated;
  EXPECT_LT((lambda[3] * axes.col(0) + lambda[4] * axes.col(1) - on_door.torque).norm(), 200.0 * round_off);
  EXPECT_NEAR(angular_velocity(at.sample(), hinge), 3.0, round_off);
}

// Two hinges hold a door twice: their forces across add to what is needed, one of them alone is not unique.
TEST(Revolute, TwoOnOneAxisShareAForceThatIsNotUnique) {
  Scene<3> scene;
  const auto door = add_door(scene, {0, 0, 3});
  const auto upper = add_joint(scene, Revolute{Ground<3>{}, door, {0, 0, 1.8}, {0, 0, 1}}, "upper");
  const auto lower = add_joint(scene, Revolute{Ground<3>{}, door, {0, 0, 0.2}, {0, 0, 1}}, "lower");
  const Simulation<3> at(scene, {.t_end = 1.0});
  EXPECT_EQ(at.statistics().redundant_equations, 5);
  EXPECT_FALSE(at.sample().is_unique(upper));
  const Vec<3> sum = reaction(at.sample(), upper).force + reaction(at.sample(), lower).force;
  EXPECT_LT((sum - Vec<3>(-72, 0, 200)).norm(), 200.0 * round_off);
}

// The plane: a rod of length 2 and mass 3 from its end, moment of inertia 4; V = 5 phi^2/2 and a damper 0.5
// make 4 phi'' + 0.5 phi' + 5 phi = 0.
TEST(TorsionSpring, SwingsWithADamperAsADampedOscillator) {
  Scene<2> scene;
  const double rest = -0.6, decay = 0.5 / 8.0, w = std::sqrt(5.0 / 4.0 - decay * decay);
  const auto rod = add_body<2>(scene, {.mass = 3.0, .inertia = 1.0, .centre = {1.0, 0.0}}, "rod");
  const auto pin = add_joint(scene, Revolute{Ground<2>{}, rod, {0, 0}}, "pin");
  scene.add(TorsionSpring{pin, 5.0, rest});
  scene.add(TorsionDamper{pin, 0.5});
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const auto run = simulate(scene, {.t_end = 5.0, .samples = 11, .tolerance = 1e-10, .stepper = stepper});
    for (std::size_t i = 0; i < run.size(); ++i) {
      const double t = run.times()[i];
      const double phi = rest - rest * std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
      EXPECT_NEAR(angle(run.sample(i), pin), phi, 100.0 * 1e-10);
    }
  }
}

// Thrown round faster than the spring can hold, V(150 deg) = 5 * 2.618^2/2 = 17 < 4 * 3^2/2.
TEST(TorsionSpring, StopsTheRunWhereItsAngleIsNoLongerKnown) {
  Scene<2> scene;
  const auto rod = add_body<2>(
      scene,
      {.mass = 3.0, .inertia = 1.0, .centre = {1.0, 0.0}, .velocity = {0.0, 3.0}, .angular_velocity = 3.0},
      "rod");
  const auto pin = add_joint(scene, Revolute{Ground<2>{}, rod, {0, 0}}, "pin");
  scene.add(TorsionSpring{pin, 5.0}, "coil");
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    try {
      (void)simulate(scene, {.t_end = 5.0, .samples = 11, .tolerance = 1e-6, .stepper = stepper});
      ADD_FAILURE() << "must be refused";
    } catch (const IntegrationFailure& failure) {
      EXPECT_NE(std::string(failure.what()).find("coil"), std::string::npos) << failure.what();
      EXPECT_NE(std::string(failure.what()).find("TurnCounter"), std::string::npos) << failure.what();
    }
  }
}

// A slide driven by a path: 3 (s'' + 10) along it, s = sin 2t.
TEST(PathDrive, TakesTheForceOfItsPath) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto block = add_body<2>(scene, {.mass = 3.0, .inertia = 1.0}, "block");
  const auto slide = add_joint(scene, Prismatic{Ground<2>{}, block, {0, 0}, {0, 1}}, "slide");
  const auto drive = add_joint(scene, PathDrive{slide, [](auto t) { return sin(2.0 * t); }}, "drive");
  const auto run = simulate(scene, {.t_end = 3.0, .samples = 7, .tolerance = 1e-8, .assemble = true});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i], F = 3.0 * (-4.0 * std::sin(2.0 * t) + 10.0);
    EXPECT_NEAR(travel(run.sample(i), slide), std::sin(2.0 * t), 1e-8);
    EXPECT_NEAR(run.multiplier(drive, i), F, 1e-8);
    EXPECT_LT((reaction(run.sample(i), drive).force - Vec<2>(0.0, F)).norm(), 1e-8);
  }
}

template <class Act>
std::string what_is_wrong(const Act& act) {
  Scene<3> scene;
  const auto a = add_body<3>(scene, {.mass = 1.0, .inertia = {1, 1, 1}}, "a");
  const auto b = add_body<3>(scene, {.mass = 1.0, .inertia = {1, 1, 1}, .centre = {1, 0, 0}}, "b");
  try {
    act(scene, a, b);
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return {};
}

TEST(Joints, SayWhatIsWrong) {
  const Vec<3> O = Vec<3>::Zero(), x(1, 0, 0), y(0, 1, 0), nowhere = Vec<3>::Constant(NAN);
  const auto says = [](const std::string& what, const std::string& part) {
    EXPECT_NE(what.find(part), std::string::npos) << what;
  };
  says(what_is_wrong([&](auto& s, auto& a, auto& b) {
         s.add(Revolute{a, b, O, O}, "h");
       }),
       "Revolute \"h\": its axis");
  says(what_is_wrong([&](auto& s, auto& a, auto& b) {
         s.add(Revolute{a, b, nowhere, x});
       }),
       "its point must be finite");
  says(what_is_wrong([&](auto& s, auto& a, auto&) {
         s.add(Revolute{a, a, O, x});
       }),
       "joins a body with itself");
  says(what_is_wrong([&](auto& s, auto& a, auto&) {
         s.add(Revolute{a, RigidBody<3>{}, O, x});
       }),
       "never added");
  says(what_is_wrong([&](auto& s, auto& a, auto& b) { s.add(Universal{a, b, O, x, x + y}); }), "right angle");
  says(what_is_wrong([&](auto& s, auto& a, auto& b) { s.add(Prismatic{a, b, O, nowhere}); }), "direction");
  says(what_is_wrong([&](auto& s, auto& a, auto& b) {
         s.add(TorsionSpring{Revolute{a, b, O, x}, -1.0});
       }),
       "stiffness = -1");
  says(what_is_wrong([&](auto& s, auto& a, auto& b) {
         s.add(TorsionDamper{Revolute{a, b, O, x}, NAN});
       }),
       "coefficient");
}

TEST(Gear, SaysWhatIsWrong) {
  const auto fault = [](const Vec<2>& other, int z1, int z2) {
    Scene<2> scene;
    const auto a = add_body<2>(scene, {.mass = 1.0, .inertia = 1.0}, "a");
    const auto b = add_body<2>(scene, {.mass = 1.0, .inertia = 1.0, .centre = {1, 0}}, "b");
    return Gear{a, b, {0, 0}, other, z1, z2}.fault();
  };
  EXPECT_TRUE(fault({1, 0}, 20, 30).empty());
  EXPECT_TRUE(fault({1, 0}, 20, -60).empty());
  EXPECT_NE(fault({1, 0}, 0, 30).find("teeth = 0"), std::string::npos);
  EXPECT_NE(fault({1, 0}, 30, -30).find("teeth"), std::string::npos);
  EXPECT_NE(fault({0, 0}, 20, 30).find("centres"), std::string::npos);
}

}  // namespace
}  // namespace dalembert::joints_test
