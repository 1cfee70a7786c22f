#include <dalembert/dalembert.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <limits>
#include <numbers>

/// Where constraints are redundant the forces are the least squares of those of the constraints that the user
/// stated; what bodies are made of has no effect.
namespace dalembert::stated_forces_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Roundings of the forces, about 10, times the condition of a body of arms 0.1 under loads 1 away.
constexpr double rounding = 1e-11;

/// A coupler hangs on three equal parallel rods at x_i along it from its centre of mass. Their
/// tensions N_i are parallel: with T what the coupler needs along them,
///
///   sum N_i = T,  sum N_i x_i = 0,  sum N_i^2 least:  N_i = a + b x_i with
///   3 a + b S_1 = T,  a S_1 + b S_2 = 0,    S_1 = 0.8, S_2 = 1.5:  N_i = T (S_2 - S_1 x_i)/(3 S_2 - S_1^2).
///
/// As x_i is scaled by the same cosine for all i while the rods swing, these shares stay: T = 10.6
/// gives 5.22, 3.68 and 1.70.
class Coupler : public testing::TestWithParam<double> {
 protected:
  static constexpr std::array<double, 3> x{-0.5, 0.2, 1.1};
  static constexpr double weight = 10.6;
  static double share(double x_i) { return (1.5 - 0.8 * x_i) / (3.0 * 1.5 - 0.8 * 0.8); }

  /// A body of this radius of inertia; the forces do not depend on it.
  void build(double speed) {
    scene.add(UniformGravity<2>{{0.0, -weight}});
    body = add_body<2>(scene, {.mass = 1.0, .inertia = GetParam() * GetParam(), .velocity = {speed, 0.0}},
                       "coupler");
    for (const double at : x)
      rods.push_back(scene.add(Distance{Fixed<2>{{at, 1.0}}, body.point({at, 0.0}), 1.0}));
  }
  Scene<2> scene;
  RigidBody<2> body;
  std::vector<Constraint<1>> rods;
};

INSTANTIATE_TEST_SUITE_P(RadiiOfInertia, Coupler, testing::Values(0.1, 0.6, 4.0));

TEST_P(Coupler, SharesItsLoadByLeastSquaresWhateverItIsMadeOf) {
  build(1.0);
  for (const auto stepper : {Stepper::ida, Stepper::erk}) {
    const auto run = simulate(scene, {.t_end = 2.0, .samples = 5, .tolerance = 1e-8, .stepper = stepper});
    EXPECT_EQ(run.statistics().redundant_equations, 1);
    for (std::size_t i = 0; i < run.size(); ++i) {
      double T = 0.0;
      for (const auto rod : rods) T -= run.multiplier(rod, i);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(-run.multiplier(rods[k], i), share(x[k]) * T, rounding);
        EXPECT_FALSE(run.is_unique(rods[k], i));
      }
    }
    EXPECT_NEAR(-run.multiplier(rods[0], 0), share(x[0]) * (weight + 1.0), rounding);  // + m v^2/length
  }
}

TEST_P(Coupler, CarriesThePublishedForcesAtRest) {
  build(0.0);
  const Simulation<2> now(scene, {.t_end = 1.0});
  constexpr double last_digit = 5e-3;
  EXPECT_NEAR(-now.multiplier(rods[0]), 5.22, last_digit);
  EXPECT_NEAR(-now.multiplier(rods[1]), 3.68, last_digit);
  EXPECT_NEAR(-now.multiplier(rods[2]), 1.70, last_digit);
}

/// A door of mass m = 10 on two hinges 2 h = 2 apart, its centre of mass at w = 0.4 from their axis, turns
/// about it at the rate omega. Each hinge is a ball joint: along the axis n they are redundant. With gravity
/// g along -n, e from the axis to the centre, and A and B the forces of the lower and the upper hinge,
///
///   along n:    A_n + B_n = m g,                             the least squares share it equally
///   along e:    A_e + B_e = -m omega^2 w,  h (A_e - B_e) = m g w      (moment about the middle of the axis)
///   across:     A + B = 0, A - B = 0.
///
/// The second moment is that of gravity alone: e is a principal axis of the door.
struct Door {
  static constexpr double mass = 10.0, gravity = 9.81, w = 0.4, h = 1.0, rate = 0.7;
  Scene<3> scene;
  RigidBody<3> body;
  Constraint<3> lower, upper;
  Vec<3> n;

  Door(const Vec<3>& inertia, const Vec<3>& axis) : n(axis.normalized()) {
    scene.add(UniformGravity<3>{-gravity * n});
    const Vec<3> across = n.unitOrthogonal();
    const Mat<3, 3> axes =
        n == Vec<3>::UnitZ() ? Mat<3, 3>::Identity() : Mat<3, 3>(across, n.cross(across), n);
    const Vec<3> centre = w * axes.col(0);
    body = add_body<3>(scene,
                       {.mass = mass,
                        .inertia = inertia,
                        .centre = centre,
                        .axes = axes,
                        .velocity = rate * n.cross(centre),
                        .angular_velocity = rate * n},
                       "door");
    lower = scene.add(Coincident{Fixed<3>{-h * n}, hinge(-h)}, "lower");
    upper = scene.add(Coincident{Fixed<3>{h * n}, hinge(h)}, "upper");
  }
  [[nodiscard]] BodyPoint<3> hinge(double z) const { return body.point({-w, 0.0, z}); }
  [[nodiscard]] Vec<3> outwards(const Sample<3>& at) const { return at.position(body.centre()).normalized(); }
  [[nodiscard]] Vec<3> lower_force(const Sample<3>& at) const {
    return 0.5 * mass * (gravity * n + (gravity * w / h - rate * rate * w) * outwards(at));
  }
  [[nodiscard]] Vec<3> upper_force(const Sample<3>& at) const {
    return 0.5 * mass * (gravity * n - (gravity * w / h + rate * rate * w) * outwards(at));
  }
};

/// A door, and a stick about a hundred times longer than thick.
const std::array inertias{Vec<3>(0.9, 1.3, 0.5), Vec<3>(1.0, 1.0, 1e-4)};
constexpr double tolerance = 1e-9;
/// Forces are those of states with the error of a few tens of steps.
constexpr double force_error = 1e3 * tolerance * Door::mass * Door::gravity;
/// What the motion does not change is good to round-off, whatever the tolerance: of the weight, after some
/// tens of operations, times the ratio of the inertias, by which a torque turns the body more about one axis
/// than about another.
double round_off(const Vec<3>& inertia) {
  return 100.0 * std::numeric_limits<double>::epsilon() * inertia.maxCoeff() / inertia.minCoeff() *
         Door::mass * Door::gravity;
}

TEST(DoorOnTwoHinges, SharesItsWeightEquallyAndKnowsItsHorizontalForces) {
  for (const auto& inertia : inertias) {
    const Door door(inertia, Vec<3>::UnitZ());
    const auto run = simulate(door.scene, {.t_end = 10.0, .samples = 21, .tolerance = tolerance});
    for (std::size_t i = 0; i < run.size(); ++i) {
      const auto at = run.sample(i);
      EXPECT_NEAR(at.multiplier(door.lower).z(), 49.05, round_off(inertia));
      EXPECT_NEAR(at.multiplier(door.upper).z(), 49.05, round_off(inertia));
      EXPECT_LT((at.multiplier(door.lower) - door.lower_force(at)).norm(), force_error);
      EXPECT_LT((at.multiplier(door.upper) - door.upper_force(at)).norm(), force_error);
      for (const auto& hinge : std::array{door.lower, door.upper}) {
        EXPECT_TRUE(at.is_unique(hinge, 0)) << i;
        EXPECT_TRUE(run.is_unique(hinge, 1, i)) << i;
        EXPECT_FALSE(at.is_unique(hinge, 2));
        EXPECT_FALSE(at.is_unique(hinge));
      }
    }
  }
}

TEST(DoorOnTwoHinges, SharesAlongItsAxisWhereverThatPoints) {
  for (const auto& inertia : inertias) {
    const Door door(inertia, {1.0, 2.0, -0.5});
    const auto run = simulate(door.scene, {.t_end = 10.0, .samples = 21, .tolerance = tolerance});
    for (std::size_t i = 0; i < run.size(); ++i) {
      const auto at = run.sample(i);
      EXPECT_LT((at.multiplier(door.lower) - door.lower_force(at)).norm(), force_error);
      EXPECT_LT((at.multiplier(door.upper) - door.upper_force(at)).norm(), force_error);
      for (int component = 0; component < 3; ++component) EXPECT_FALSE(at.is_unique(door.upper, component));
    }
  }
}

// Far from the origin positions are round to 1e-10: no reason to doubt what the motion determines.
TEST(DoorOnTwoHinges, KnowsItsHorizontalForcesFarFromTheOrigin) {
  const Vec<3> far(3e5, -7e5, 2e5);
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto body = add_body<3>(
      scene, {.mass = 10.0, .inertia = inertias[0], .centre = far + Vec<3>(0.4, 0.0, 0.0)}, "door");
  const auto lower = scene.add(Coincident{Fixed<3>{far - Vec<3>::UnitZ()}, body.point({-0.4, 0.0, -1.0})});
  const auto upper = scene.add(Coincident{Fixed<3>{far + Vec<3>::UnitZ()}, body.point({-0.4, 0.0, 1.0})});
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 3, .tolerance = 1e-6});
  for (std::size_t i = 0; i < run.size(); ++i) {
    for (const auto& hinge : std::array{lower, upper}) {
      EXPECT_TRUE(run.is_unique(hinge, 0, i));
      EXPECT_TRUE(run.is_unique(hinge, 1, i));
      EXPECT_FALSE(run.is_unique(hinge, 2, i));
      EXPECT_NEAR(run.multiplier(hinge, i).z(), 49.05, 1e-6);
    }
  }
}

// The upper hinge in equations of the user's: scaled, and mixed with each other.
TEST(DoorOnTwoHinges, ExertTheSameForcesHoweverTheirEquationsAreWritten) {
  const Door plain(inertias[0], {1.0, 2.0, -0.5});
  Door written(inertias[0], {1.0, 2.0, -0.5});
  Scene<3> scene;
  scene.add(UniformGravity<3>{-Door::gravity * plain.n});
  const Vec<3> across = plain.n.unitOrthogonal();
  const Mat<3, 3> axes(across, plain.n.cross(across), plain.n);
  const auto body = add_body<3>(
      scene, {.mass = Door::mass, .inertia = inertias[0], .centre = Door::w * axes.col(0), .axes = axes},
      "door");
  const auto lower = scene.add(Coincident{Fixed<3>{-plain.n}, body.point({-Door::w, 0.0, -Door::h})});
  const auto upper = scene.add(holonomic(points(body.point({-Door::w, 0.0, Door::h})), [n = plain.n](auto r) {
    const auto d = (r - n.template cast<typename decltype(r)::Scalar>()).eval();
    return vec(1000.0 * d.x(), d.x() + d.y(), 0.01 * (d.z() - 3.0 * d.y()));
  }));
  const Simulation<3> at(scene, {.t_end = 1.0});
  Vec<3> force = Vec<3>::Zero();
  for (const auto& particle : body.particles) force += at.constraint_force(upper, particle);
  EXPECT_NEAR(at.multiplier(lower).dot(plain.n), 49.05, 1e-9);
  EXPECT_NEAR(force.dot(plain.n), 49.05, 1e-9);
}

TEST(DoorOnTwoHinges, HaveNoFourthComponent) {
  const Door door(inertias[0], Vec<3>::UnitZ());
  const Simulation<3> at(door.scene, {.t_end = 1.0});
  for (const int component : {-1, 3}) {
    EXPECT_THAT([&] { (void)at.sample().is_unique(door.upper, component); },
                ThrowsMessage<InvalidArgument>(
                    AllOf(HasSubstr("Coincident \"upper\""), HasSubstr("counted from 0"))));
  }
}

// The hinges' friction reads their horizontal forces, which the motion determines.
TEST(DoorOnTwoHinges, LetFrictionReadTheirHorizontalForces) {
  Door door(inertias[0], Vec<3>::UnitZ());
  door.scene.add(friction_law(door.upper, points(door.body.centre()), [](auto lambda, auto, auto v) {
    return (-0.01 * abs(lambda.x()) * v).eval();
  }));
  const auto run = simulate(door.scene, {.t_end = 0.5, .samples = 3, .tolerance = tolerance});
  EXPECT_LT(run.velocity(door.body.centre(), 2).norm(), Door::rate * Door::w);
}

TEST(DoorOnTwoHinges, RefuseFrictionThatReadsTheirVerticalForcesEvenAtRest) {
  Scene<3> scene;
  const auto body =
      add_body<3>(scene, {.mass = 10.0, .inertia = inertias[0], .centre = {0.4, 0.0, 0.0}}, "door");
  scene.add(Coincident{Fixed<3>{{0.0, 0.0, -1.0}}, body.point({-0.4, 0.0, -1.0})}, "lower");
  const auto upper = scene.add(Coincident{Fixed<3>{{0.0, 0.0, 1.0}}, body.point({-0.4, 0.0, 1.0})}, "upper");
  scene.add(friction_law(upper, points(body.centre()),
                         [](auto lambda, auto, auto v) { return (-0.1 * abs(lambda.z()) * v).eval(); }),
            "rust");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("FrictionLaw \"rust\""),
                                                     HasSubstr("Coincident \"upper\""),
                                                     HasSubstr("does not determine"))));
}

// A rod that repeats one of the body's own carries nothing: that one does not count.
TEST(InternalRods, TakeWhatTheyCanFromRodsThatRepeatThem) {
  Scene<3> scene;
  const auto body = add_body<3>(scene,
                                {.mass = 1.0,
                                 .inertia = {0.2, 0.3, 0.4},
                                 .centre = {0.0, 0.0, 0.0},
                                 .angular_velocity = {1.0, 2.0, 3.0}},
                                "body");
  const auto& p = body.particles;
  Simulation<3> before(scene, {.t_end = 1.0});
  const double length = (before.position(p[0]) - before.position(p[1])).norm();
  const auto repeated = scene.add(Distance{p[0], p[1], length});
  const Simulation<3> at(scene, {.t_end = 1.0});
  EXPECT_NEAR(at.multiplier(repeated), 0.0, rounding);
  EXPECT_FALSE(at.sample().is_unique(repeated));
  EXPECT_NEAR(at.multiplier(body.rods[0]), before.multiplier(body.rods[0]), rounding);
}

// Two identical equations of one constraint: which of them carries it does not matter, and no number grows.
TEST(StatedForces, EquationWrittenTwiceSharesTheForceOfOne) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.6, -0.8}});
  const auto twice = scene.add(holonomic(points(bob), [](auto r) {
    const auto g = r.norm() - 1.0;
    return vec(g, g);
  }));
  const Simulation<2> at(scene, {.t_end = 1.0});
  const Vec<2> lambda = at.multiplier(twice);
  EXPECT_NEAR(-lambda.sum(), 16.0, rounding);
  EXPECT_LT(lambda.norm(), 16.0 + rounding);
}

// A wheel locked twice, once in thousandths of a radian: each lock exerts half the torque 3.
TEST(StatedForces, LocksOfARotorShareItsTorque) {
  Scene<2> scene;
  const auto wheel = scene.add_rotor({.inertia = 0.5});
  scene.add(force_law(points(wheel), [](auto, auto w) { return (0.0 * w + vec(3.0)).eval(); }));
  const auto one = scene.add(holonomic(points(wheel), [](auto angle) { return angle[0]; }));
  const auto two = scene.add(holonomic(points(wheel), [](auto angle) { return 1000.0 * angle[0]; }));
  const Simulation<2> at(scene, {.t_end = 1.0});
  EXPECT_NEAR(at.sample().constraint_torque(one, wheel), -1.5, rounding);
  EXPECT_NEAR(at.sample().constraint_torque(two, wheel), -1.5, rounding);
}

}  // namespace
}  // namespace dalembert::stated_forces_test
