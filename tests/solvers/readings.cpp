#include "scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr Stepper both[] = {Stepper::ida, Stepper::erk};

/// Round-off of a linear system of a few equations with numbers of size 1 to 100, in units in the last place:
/// each of its quantities is a sum of some tens of products, and its condition here is below 10.
constexpr double round_off = 1e3 * epsilon * 100.0;

/// On a circle of radius L the acceleration is -v^2 r/L^2 along the rod and the part of g across it.
TEST(Readings, ThePendulumsAccelerationIsThatOfTheCircle) {
  for (const Stepper stepper : both) {
    const Pendulum pendulum;
    const auto run = simulate(pendulum.scene, {.t_end = 3.0, .stepper = stepper});
    for (const auto& now : run) {
      const Vec<2> r = now.position(pendulum.bob), v = now.velocity(pendulum.bob), g{0.0, -9.81};
      const Vec<2> expected = -v.squaredNorm() * r + g - g.dot(r) * r;
      EXPECT_LT((now.acceleration(pendulum.bob) - expected).norm(), round_off);
    }
  }
}

/// A compound pendulum of mass m, inertia I about its centre, whose hinge is d from it: with the angle phi of
/// the arm from the vertical, (I + m d^2) phi'' = -m g d sin phi and (I + m d^2) phi'^2/2 = m g d (cos phi -
/// cos phi_0).
struct CompoundPendulum {
  static constexpr double m = 3.0, I = 0.4, d = 0.6, g = 9.81, start = 1.2;
  Scene<2> scene{"compound"};
  RigidBody<2> body;
  BodyPoint<2> pin, tip;
  Constraint<2> hinge;

  CompoundPendulum() {
    scene.add(UniformGravity<2>{{0.0, -g}});
    // The body's first axis points from the hinge to the centre.
    body = add_body(scene,
                    BodyState<2>{.mass = m,
                                 .inertia = I,
                                 .centre = {d * std::sin(start), -d * std::cos(start)},
                                 .angle = start - 0.5 * std::numbers::pi},
                    "body");
    pin = body.point({-d, 0.0});
    tip = body.point({2.0 * d, 0.0});
    hinge = scene.add(Coincident{Fixed<2>{}, pin}, "hinge");
  }
  struct State {
    Vec<2> along, across;  ///< the arm, and to its left
    double square, rate;   ///< of the angular velocity; angular acceleration
  };
  [[nodiscard]] State at(const Sample<2>& now) const {
    const Vec<2> along = now.position(body.centre()).normalized(), across{-along.y(), along.x()};
    const double inertia = I + m * d * d;
    const double cosine = -along.y(), sine = along.x();
    return {along, across, 2.0 * m * g * d * (cosine - std::cos(start)) / inertia,
            -m * g * d * sine / inertia};
  }
};

/// The energy integral holds to the error of the run: the tolerance in each step, and 2 m g d/(I + m d^2),
/// about 24, times as much in the square of the angular velocity and in its rate.
double error_of(const Trajectory<2>& run) {
  return 1e-10 * static_cast<double>(run.statistics().steps) * 24.0;
}

TEST(Readings, ABodyPointsAccelerationIsThatOfTheRotation) {
  for (const Stepper stepper : both) {
    const CompoundPendulum pendulum;
    const auto run = simulate(pendulum.scene, {.t_end = 2.0, .tolerance = 1e-10, .stepper = stepper});
    for (const auto& now : run) {
      const auto s = pendulum.at(now);
      const Vec<2> tip = 3.0 * CompoundPendulum::d * (s.rate * s.across - s.square * s.along);
      EXPECT_LT((now.acceleration(pendulum.tip) - tip).norm(), 3.0 * error_of(run));
      EXPECT_LT(now.acceleration(pendulum.pin).norm(), 10.0 * round_off);
    }
  }
}

/// phi'' = torque/inertia.
TEST(Readings, ARotorsAccelerationIsItsTorqueOverItsInertia) {
  Scene<2> scene;
  const auto wheel = scene.add_rotor({.inertia = 0.5}, "wheel");
  const auto motor = scene.add(Torque{wheel, 3.0}, "motor");
  const auto run = simulate(scene, {.t_end = 1.0});
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_DOUBLE_EQ(run.angular_acceleration(wheel, i), 6.0);
    EXPECT_DOUBLE_EQ(run.torque(motor, wheel, i), 3.0);
  }
}

/// Friction moves the accelerations: a block on a plane of slope alpha slides at g (sin - mu cos).
TEST(Readings, AccelerationsContainFriction) {
  const double alpha = 0.6, mu = 0.3;
  Scene<2> scene;
  const auto block =
      scene.add_particle({.mass = 2.0, .velocity = {std::cos(alpha), -std::sin(alpha)}}, "block");
  const auto weight = scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto slope =
      scene.add(OnCurve{block, Plane<2>{{0.0, 0.0}, {std::sin(alpha), std::cos(alpha)}}}, "slope");
  const auto friction = scene.add(
      friction_law(slope, points(block),
                   [mu](auto lambda, auto, auto v) { return (-mu * lambda * v.normalized()).eval(); }),
      "friction");
  const double size = 9.81 * (std::sin(alpha) - mu * std::cos(alpha));
  for (const Stepper stepper : both) {
    for (const auto& now : simulate(scene, {.t_end = 1.0, .stepper = stepper})) {
      EXPECT_NEAR(now.acceleration(block).norm(), size, round_off);
      EXPECT_NEAR(now.force(friction, block).norm(), mu * 2.0 * 9.81 * std::cos(alpha), round_off);
      const Vec<2> all = now.force(weight, block) + now.force(friction, block) + now.constraint_force(block);
      EXPECT_LT((all - 2.0 * now.acceleration(block)).norm(), round_off);
    }
  }
}

/// Against each law written out here, in a scene with one element of each kind.
TEST(Readings, ForcesAreThoseOfTheirLaws) {
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

/// Also where a constraint yields, from nearly rigid to a soft spring: its multiplier and the accelerations
/// obey Newton together.
TEST(Readings, AccelerationsContainCompliantConstraints) {
  for (const Stepper stepper : both) {
    for (const double compliance : {1e-8, 1e-4, 1e-2, 1.0}) {
      Scene<2> scene;
      const auto weight = scene.add(UniformGravity<2>{{0.0, -9.81}});
      const auto bob = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}}, "bob");
      scene.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, compliance), "yields");
      const auto run = simulate(scene, {.t_end = 1.0, .samples = 11, .stepper = stepper});
      for (const auto& now : run) {
        const Vec<2> all = now.constraint_force(bob) + now.force(weight, bob);
        EXPECT_LT((all - 2.0 * now.acceleration(bob)).norm(), round_off) << compliance;
      }
    }
  }
}

/// A parallelogram of massless rods, 1 m and 2 m, with 1 kg at either joint, passes the position in which all
/// are in line. There the rods' forces are not determined, but each joint moves like a pendulum. An
/// acceleration is that pendulum's, to the root of the tolerance as forces are, or cannot be read. (The way
/// there is that of a pendulum from there, backwards.)
TEST(Readings, AccelerationsCloseToASingularPositionAreRightOrCannotBeRead) {
  const double tolerance = 1e-8, way = 0.3, rate = 3.0;
  Scene<2> single;
  single.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = single.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, rate}});
  single.add(Distance{Fixed<2>{}, bob, 1.0});
  const auto back =
      simulate(single, {.t_end = way, .samples = 2, .tolerance = 1e-12, .stepper = Stepper::erk});
  const Vec<2> r = back.position(bob, 1), v = -back.velocity(bob, 1);

  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const Vec<2> pivot{2.0, 0.0};
  const auto a = scene.add_particle({.mass = 1.0, .position = r, .velocity = v}, "a");
  const auto b = scene.add_particle({.mass = 1.0, .position = r + pivot, .velocity = v}, "b");
  scene.add(Distance{Fixed<2>{}, a, 1.0});
  scene.add(Distance{Fixed<2>{pivot}, b, 1.0});
  scene.add(Distance{a, b, 2.0});
  const std::vector<double> off{-1e-2, -1e-3, -1e-4, -1e-5, -1e-6, 0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
  std::vector<double> times;
  for (const double d : off) times.push_back(way + d);
  for (const Stepper stepper : both) {
    const auto run =
        simulate(scene, {.t_end = 1.0, .times = times, .tolerance = tolerance, .stepper = stepper});
    std::size_t readable = 0;
    for (const auto& now : run) {
      const Vec<2> q = now.position(a), u = now.velocity(a), g{0.0, -9.81};
      const Vec<2> expected = -u.squaredNorm() * q + g - g.dot(q) * q;
      try {
        EXPECT_LT((now.acceleration(a) - expected).norm(), std::sqrt(tolerance) * expected.norm())
            << now.time() - way;
        ++readable;
      } catch (const UndeterminedForce&) {
      }
    }
    EXPECT_GE(readable, 2U) << "10 ms away, where the rods are 0.03 from in line, at least";
  }
}

/// A spring at the tip of a body: its resultant on the body is the spring's force.
TEST(Readings, AForceOnABodyIsItsResultant) {
  CompoundPendulum pendulum;
  const auto spring = pendulum.scene.add(Spring{Fixed<2>{{2.0, 0.0}}, pendulum.tip, 7.0}, "spring");
  for (const auto& now : simulate(pendulum.scene, {.t_end = 1.0, .samples = 11})) {
    const Vec<2> expected = 7.0 * (Vec<2>{2.0, 0.0} - now.position(pendulum.tip));
    EXPECT_LT((now.force(spring, pendulum.body) - expected).norm(), round_off);
  }
}

TEST(Readings, AForceThatThrowsIsAnErrorThatNamesIt) {
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
TEST(Readings, AHingeExertsOnBodyAndGroundWhatNewtonAndEulerSay) {
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
TEST(Readings, ABallJointInSpaceExertsAForceThroughItself) {
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
TEST(Readings, OnlyWhatIsHeldByTheGroundActsOnIt) {
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

TEST(Readings, FixedAndDrivenPointsAreReadLikeParticles) {
  const Pendulum pendulum;
  const auto shaker = driven([](auto t) { return vec(0.1 * sin(5.0 * t), t * t); });
  const Fixed<2> nail{{1.0, 2.0}};
  const auto run = simulate(pendulum.scene, {.t_end = 1.0});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double t = run.times()[i];
    EXPECT_EQ(run.position(nail, i), nail.position);
    EXPECT_EQ(run.velocity(nail, i), Vec<2>::Zero());
    EXPECT_EQ(run.acceleration(nail, i), Vec<2>::Zero());
    EXPECT_LT((run.position(shaker, i) - Vec<2>{0.1 * std::sin(5.0 * t), t * t}).norm(), 4.0 * epsilon);
    EXPECT_LT((run.velocity(shaker, i) - Vec<2>{0.5 * std::cos(5.0 * t), 2.0 * t}).norm(), 4.0 * epsilon);
    EXPECT_LT((run.acceleration(shaker, i) - Vec<2>{-2.5 * std::sin(5.0 * t), 2.0}).norm(), 8.0 * epsilon);
  }
}

TEST(Readings, APathWithoutAValueCannotBeRead) {
  const auto run = simulate(Pendulum().scene, {.t_end = 1.0, .samples = 3});
  const auto away = driven([](auto t) { return vec(1.0 / t, 0.0); });
  const auto kinked =
      driven([](auto t) { return vec(t * sqrt(t), 0.0); });  // its second derivative begins at infinity
  const auto refused =
      ThrowsMessage<EquationFault>(HasSubstr("driven point has no finite value or derivative at t = 0"));
  EXPECT_THAT([&] { (void)run.position(away, 0); }, refused);
  EXPECT_THAT([&] { (void)run.acceleration(kinked, 0); }, refused);
  EXPECT_EQ(run.position(away, 1), Vec<2>(2.0, 0.0));
}

TEST(Readings, AllTimesAreTheSamplesOneByOne) {
  const EachKind each;
  const auto run = simulate(each.scene, {.t_end = 1.0, .samples = 11});
  const auto pin = each.scene.constraint<2>("pin");
  ASSERT_EQ(run.positions(each.bead).cols(), 11);
  Eigen::Index column = 0;
  for (const auto& now : run) {
    EXPECT_EQ(now.time(), run.times()[static_cast<std::size_t>(column)]);
    EXPECT_EQ(run.positions(each.bead).col(column), now.position(each.bead));
    EXPECT_EQ(run.velocities(each.bead).col(column), now.velocity(each.bead));
    EXPECT_EQ(run.accelerations(each.skate).col(column), now.acceleration(each.skate));
    EXPECT_EQ(run.multipliers(each.upper_rod)[column], now.multiplier(each.upper_rod));
    EXPECT_EQ(run.multipliers(pin).col(column), now.multiplier(pin));
    ++column;
  }
  EXPECT_EQ(column, 11);
  EXPECT_THROW((void)run.positions(Pendulum().bob), InvalidArgument);
}

TEST(Readings, RotorsHaveAllTimesToo) {
  Scene<2> scene;
  const auto wheel = scene.add_rotor({.inertia = 0.5, .angle = 1.0, .angular_velocity = 2.0}, "wheel");
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 3});
  EXPECT_DOUBLE_EQ(run.angles(wheel)[1], 2.0);
  EXPECT_DOUBLE_EQ(run.angular_velocities(wheel)[2], 2.0);
  EXPECT_EQ(run.angular_accelerations(wheel).maxCoeff(), 0.0);
}

/// What can be read of a sample can be read of a run and of a simulation, and is the same.
TEST(Readings, AreTheSameOfSampleTrajectoryAndSimulation) {
  const CompoundPendulum p;
  const Options options{.t_end = 1.0, .samples = 3};
  const auto run = simulate(p.scene, options);
  Simulation<2> simulation(p.scene, options);
  const auto gravity = p.scene.force("UniformGravity0");
  for (std::size_t i = 0; i < run.size(); ++i) {
    simulation.advance_to(run.times()[i]);
    const auto now = run.sample(i);
    const auto same = [](const auto& a, const auto& b, const auto& c) { EXPECT_TRUE(a == b && b == c); };
    same(now.energy(), run.energy(i), simulation.energy());
    same(now.position(p.tip), run.position(p.tip, i), simulation.position(p.tip));
    same(now.velocity(p.tip), run.velocity(p.tip, i), simulation.velocity(p.tip));
    same(now.acceleration(p.tip), run.acceleration(p.tip, i), simulation.acceleration(p.tip));
    same(now.multiplier(p.hinge), run.multiplier(p.hinge, i), simulation.multiplier(p.hinge));
    same(now.is_determined(p.hinge), run.is_determined(p.hinge, i), simulation.is_determined(p.hinge));
    same(now.is_unique(p.hinge), run.is_unique(p.hinge, i), simulation.is_unique(p.hinge));
    same(now.is_unique(p.hinge, 1), run.is_unique(p.hinge, 1, i), simulation.is_unique(p.hinge, 1));
    same(now.constraint_force(p.body), run.constraint_force(p.body, i), simulation.constraint_force(p.body));
    const auto particle = p.body.particles[0];
    same(now.constraint_force(p.hinge, particle), run.constraint_force(p.hinge, particle, i),
         simulation.constraint_force(p.hinge, particle));
    same(now.constraint_moment(p.hinge, p.body, {1.0, 0.0}),
         run.constraint_moment(p.hinge, p.body, {1.0, 0.0}, i),
         simulation.constraint_moment(p.hinge, p.body, {1.0, 0.0}));
    same(now.constraint_moment(p.body, {1.0, 0.0}), run.constraint_moment(p.body, {1.0, 0.0}, i),
         simulation.constraint_moment(p.body, {1.0, 0.0}));
    same(now.ground_force(p.hinge), run.ground_force(p.hinge, i), simulation.ground_force(p.hinge));
    same(now.ground_moment(p.hinge, {1.0, 0.0}), run.ground_moment(p.hinge, {1.0, 0.0}, i),
         simulation.ground_moment(p.hinge, {1.0, 0.0}));
    same(now.force(gravity, p.body), run.force(gravity, p.body, i), simulation.force(gravity, p.body));
  }
}

/// In a chain two rods touch a bead, four slots for its two coordinates, however long the chain is.
TEST(Readings, TheForceOnAParticleLooksAtWhatTouchesItOnly) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  std::vector<Particle<2>> beads;
  std::vector<Constraint<1>> rods;
  for (int i = 0; i < 50; ++i) {
    const Vec<2> r{0.0, -0.1 * (i + 1)};
    beads.push_back(scene.add_particle({.mass = 0.1, .position = r, .velocity = {0.01 * (i + 1), 0.0}}));
    rods.push_back(i == 0 ? scene.add(Distance{Fixed<2>{}, beads[0], 0.1})
                          : scene.add(Distance{beads[beads.size() - 2], beads.back(), 0.1}));
  }
  const auto run = simulate(scene, {.t_end = 0.1, .samples = 2});
  const auto now = run.sample(1);
  for (std::size_t i = 0; i < beads.size(); ++i) {
    EXPECT_EQ(now.layout().touching_slots(beads[i].coordinate).size(), i + 1 < beads.size() ? 2U : 1U);
    Vec<2> all = Vec<2>::Zero();
    for (const auto& rod : rods) all += now.constraint_force(rod, beads[i]);
    EXPECT_EQ(now.constraint_force(beads[i]), all);
  }
}

/// r = cos(w t) on a spring; each step errs by no more than the tolerance, and an oscillator does not enlarge
/// that.
TEST(Restart, GoesOnWithinTheToleranceOfTheRun) {
  for (const Stepper stepper : both) {
    Scene<2> scene;
    const auto cart = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "cart");
    scene.add(Spring{Fixed<2>{}, cart, 9.0});
    const Options options{.t_end = 2.0, .samples = 21, .tolerance = 1e-9, .stepper = stepper};
    const auto first = simulate(scene, options);
    Options later = options;
    later.t_end = 4.0;
    const auto rest = simulate(scene, first.sample(10), later);
    EXPECT_EQ(rest.times().front(), 1.0);
    EXPECT_EQ(rest.times().back(), 4.0);
    const double bound = 1e-9 * static_cast<double>(first.statistics().steps + rest.statistics().steps) *
                         first.statistics().length;
    for (const auto& now : rest) EXPECT_NEAR(now.position(cart).x(), std::cos(3.0 * now.time()), bound);
  }
}

/// Where constraints depend on time a restart at another time would violate them.
TEST(Restart, BeginsAtTheTimeOfItsSampleWithItsForces) {
  const EachKind each;
  const auto run = simulate(each.scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-8});
  for (const std::size_t i : {0U, 3U, 10U}) {
    const Simulation<2> again(each.scene, run.sample(i), {.t_end = 2.0, .tolerance = 1e-8});
    EXPECT_EQ(again.time(), run.times()[i]);
    // Both are put onto the constraints, to round-off.
    EXPECT_LT((again.position(each.lower) - run.position(each.lower, i)).norm(), round_off);
    EXPECT_NEAR(again.multiplier(each.upper_rod), run.multiplier(each.upper_rod, i), round_off);
  }
}

TEST(Restart, ACopyWithOtherParametersStartsFromASampleOfTheOriginal) {
  const Pendulum pendulum;
  const auto run = simulate(pendulum.scene, {.t_end = 1.0});
  Scene<2> moon = pendulum.scene;
  moon.replace(moon.force("UniformGravity0"), UniformGravity<2>{{0.0, -1.62}});
  const Simulation<2> simulation(moon, run.sample(50), {.t_end = 2.0});
  // Tension: m v^2/L + m g cos.
  const Vec<2> r = run.position(pendulum.bob, 50), v = run.velocity(pendulum.bob, 50);
  EXPECT_NEAR(-simulation.multiplier(pendulum.rod), v.squaredNorm() - 1.62 * r.y(), round_off);
}

TEST(Restart, RefusesASampleOfSomethingElseAndAnotherTime) {
  const Pendulum pendulum, other;
  const auto run = simulate(other.scene, {.t_end = 1.0});
  EXPECT_THAT([&] { Simulation<2>(pendulum.scene, run.sample(1), {.t_end = 2.0}); },
              ThrowsMessage<InvalidArgument>(HasSubstr("cannot start from a sample of scene \"pendulum\"")));
  EXPECT_THAT([&] { Simulation<2>(other.scene, run.sample(1), {.t_end = 2.0, .t_start = 0.5}); },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("t_start = 0.5"), HasSubstr("leave it out"))));
  Scene<2> more = other.scene;
  more.add_particle({.mass = 1.0});
  EXPECT_THROW((void)simulate(more, run.sample(1), {.t_end = 2.0}), InvalidArgument);
}

/// Both say the same, and neither has moved anything.
TEST(Simulation, StepAndAdvanceEndAlike) {
  for (const Stepper stepper : both) {
    const Pendulum pendulum;
    Simulation<2> simulation(pendulum.scene, {.t_end = 1.0, .stepper = stepper});
    simulation.advance_to(1.0);
    simulation.advance_to(1.0);
    const double energy = simulation.energy();
    EXPECT_THROW(simulation.step(), InvalidArgument);
    EXPECT_THROW(simulation.advance_to(1.5), InvalidArgument);
    EXPECT_EQ(simulation.time(), 1.0);
    EXPECT_EQ(simulation.energy(), energy);
  }
}

/// The stepper may have reached t_end while the simulation stands before it.
TEST(Simulation, StepsToTheEndFromAnywhereBefore) {
  for (const Stepper stepper : both) {
    const Pendulum pendulum;
    Simulation<2> simulation(pendulum.scene, {.t_end = 0.5, .stepper = stepper});
    simulation.advance_to(std::nextafter(0.5, 0.0));
    simulation.step();
    EXPECT_EQ(simulation.time(), 0.5);
    EXPECT_THROW(simulation.step(), InvalidArgument);
  }
}

}  // namespace
}  // namespace dalembert
