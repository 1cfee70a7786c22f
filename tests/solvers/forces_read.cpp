#include "readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

namespace dalembert::forces_read_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Against each law written out here, in a scene with one element of each kind.
TEST(ForcesRead, ForcesAreThoseOfTheirLaws) {
  EachKind each;
  const auto weight = each.scene.add(UniformGravity<2>{{1.0, 0.0}}, "sideways");
  const auto run = simulate(each.scene, {.t_end = 1.0, .samples = 11});
  for (const auto& now : run) {
    const Vec<2> upper = now.position(each.upper), lower = now.position(each.lower),
                 bead = now.position(each.bead);
    const auto force = [&](const char* name, Particle<2> on) {
      return now.force(each.scene.force(name), on);
    };
    const auto expect = [](const Vec<2>& actual, const Vec<2>& expected) {
      EXPECT_LT((actual - expected).norm(), round_off);
    };
    const Vec<2> stretched = bead - lower;
    const Vec<2> pull = 5.0 * (stretched.norm() - 1.0) * stretched.normalized();
    expect(force("Spring0", each.lower), pull);
    expect(force("Spring0", each.bead), -pull);
    EXPECT_EQ(force("Spring0", each.upper), Vec<2>::Zero());
    const Vec<2> e = (bead - upper).normalized();
    const Vec<2> damping = -0.3 * e.dot(now.velocity(each.bead) - now.velocity(each.upper)) * e;
    expect(force("Damper1", each.bead), damping);
    expect(force("Damper1", each.upper), -damping);
    expect(force("Potential2", each.skate),
           -2.0 * (1.0 + 0.1 * std::sin(now.time())) * now.position(each.skate));
    expect(force("ForceLaw3", each.rider), -0.1 * now.velocity(each.rider));
    EXPECT_EQ(now.force(weight, each.rider), Vec<2>(0.5, 0.0));
    // Newton, with every force by name.
    for (const auto& p : {each.upper, each.lower, each.bead, each.rider, each.skate}) {
      Vec<2> all = now.constraint_force(p) + now.force(weight, p);
      for (const char* name : {"UniformGravity0", "Spring0", "Damper1", "Potential2", "ForceLaw3"})
        all += force(name, p);
      expect(all, (p == each.rider ? 0.5 : 1.0) * now.acceleration(p));
    }
  }
}

/// A spring at the tip of a body: its resultant on the body is the spring's force.
TEST(ForcesRead, AForceOnABodyIsItsResultant) {
  CompoundPendulum pendulum;
  const auto spring = pendulum.scene.add(Spring{Fixed<2>{{2.0, 0.0}}, pendulum.tip, 7.0}, "spring");
  for (const auto& now : simulate(pendulum.scene, {.t_end = 1.0, .samples = 11})) {
    const Vec<2> expected = 7.0 * (Vec<2>{2.0, 0.0} - now.position(pendulum.tip));
    EXPECT_LT((now.force(spring, pendulum.body) - expected).norm(), round_off);
  }
}

TEST(ForcesRead, AForceThatThrowsIsAnErrorThatNamesIt) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0}, "bob");
  auto broken = std::make_shared<bool>(false);
  const auto wind = scene.add(force_law(points(bob),
                                        [broken](auto, auto v) {
                                          if (*broken) throw std::runtime_error("a gale");
                                          return (-0.1 * v).eval();
                                        }),
                              "wind");
  const auto run = simulate(scene, {.t_end = 1.0});
  *broken = true;
  EXPECT_THAT(
      [&] { (void)run.force(wind, bob, 3); },
      ThrowsMessage<EquationFault>(AllOf(HasSubstr("\"wind\""), HasSubstr("a gale"), HasSubstr("t = 0.03"))));
}

/// m a_c = F + m g, I phi'' = (r_hinge - r_c) x F; the ground feels -F, with no moment about the hinge.
TEST(ForcesRead, AHingeExertsOnBodyAndGroundWhatNewtonAndEulerSay) {
  using P = CompoundPendulum;
  for (const Stepper stepper : both) {
    const P pendulum;
    const auto run = simulate(pendulum.scene, {.t_end = 2.0, .tolerance = 1e-10, .stepper = stepper});
    for (const auto& now : run) {
      const auto s = pendulum.at(now);
      const Vec<2> a = P::d * (s.rate * s.across - s.square * s.along);
      const Vec<2> F = P::m * (a + Vec<2>{0.0, P::g});
      const double bound = P::m * error_of(run);
      EXPECT_LT((now.constraint_force(pendulum.hinge, pendulum.body) - F).norm(), bound);
      EXPECT_LT((now.constraint_force(pendulum.body) - F).norm(), bound) << "rods inside it cancel";
      EXPECT_LT((now.ground_force(pendulum.hinge) + F).norm(), bound);
      const Vec<2> centre = now.position(pendulum.body.centre());
      EXPECT_NEAR(now.constraint_moment(pendulum.hinge, pendulum.body, centre), P::I * s.rate, bound);
      EXPECT_NEAR(now.constraint_moment(pendulum.body, centre), P::I * s.rate, bound);
      EXPECT_NEAR(now.ground_moment(pendulum.hinge, {0.0, 0.0}), 0.0, round_off);
      const Vec<2> bolt{0.5, -2.0};  // (0 - bolt) x (-F)
      EXPECT_NEAR(now.ground_moment(pendulum.hinge, bolt), bolt.x() * F.y() - bolt.y() * F.x(), 3.0 * bound);
    }
  }
}

/// In space: a body at a ball joint, by Newton at its centre, in all three components of force and moment.
TEST(ForcesRead, ABallJointInSpaceExertsAForceThroughItself) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto body = add_body(scene,
                             BodyState<3>{.mass = 2.0,
                                          .inertia = {0.1, 0.2, 0.25},
                                          .centre = {0.3, 0.1, -0.4},
                                          .velocity = Vec<3>{0.2, 0.5, -0.3}.cross(Vec<3>{0.3, 0.1, -0.4}),
                                          .angular_velocity = {0.2, 0.5, -0.3}},
                             "body");
  const auto joint = scene.add(Coincident{Fixed<3>{}, body.point({-0.3, -0.1, 0.4})}, "joint");
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 11});
  const Vec<3> about{1.0, 2.0, 3.0};
  for (const auto& now : run) {
    const Vec<3> F = 2.0 * (now.acceleration(body.centre()) + Vec<3>{0.0, 0.0, 9.81});
    EXPECT_LT((now.constraint_force(joint, body) - F).norm(), round_off);
    EXPECT_LT((now.ground_force(joint) + F).norm(), round_off);
    EXPECT_LT((now.constraint_moment(joint, body, about) + about.cross(F)).norm(), 4.0 * round_off);
    EXPECT_LT((now.ground_moment(joint, about) - about.cross(F)).norm(), 4.0 * round_off);
  }
}

/// A rod between two beads does nothing to the ground; a wire carries its bead; a pulley's axis has no place.
TEST(ForcesRead, OnlyWhatIsHeldByTheGroundActsOnIt) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0}, "a");
  const auto b = scene.add_particle({.mass = 1.0, .position = {1.0, 1.0}}, "b");
  const auto wheel = scene.add_rotor({.inertia = 1.0}, "wheel");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto rod = scene.add(Distance{a, b, std::sqrt(2.0)}, "rod");
  const auto wire = scene.add(holonomic(points(a), [](auto r) { return r.y(); }), "wire");
  const auto pulley = scene.add(
      holonomic(points(b, wheel), [](auto r, auto phi) { return r.y() - 1.0 - 0.5 * phi[0]; }), "pulley");
  const auto run = simulate(scene, {.t_end = 0.2, .samples = 5});
  for (const auto& now : run) {
    EXPECT_LT(now.ground_force(rod).norm(), round_off);
    EXPECT_NEAR(now.ground_moment(rod, {3.0, 4.0}), 0.0, round_off);
    EXPECT_EQ(now.ground_force(wire), Vec<2>(-now.constraint_force(wire, a)));
    EXPECT_EQ(now.ground_force(pulley), Vec<2>(-now.constraint_force(pulley, b)));
    EXPECT_THAT(
        [&] {
          (void)now.ground_moment(pulley, {0.0, 0.0});
        },
        ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("\"pulley\""), HasSubstr("turns a rotor"))));
  }
}

}  // namespace
}  // namespace dalembert::forces_read_test
