#include "dalembert/core/forces/friction.h"

#include "../equations.h"
#include <dalembert/core/analysis/islands.h>
#include <dalembert/dalembert.h>

#include <Eigen/Core>
#include <gmock/gmock.h>

#include <stdexcept>

namespace dalembert::friction_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Two particles on a slope and on a pin, whose multipliers, of one and two equations, are the test's.
class Friction : public testing::Test {
 protected:
  Scene<2> scene{"friction"};
  Particle<2> a = scene.add_particle({.mass = 1.0});
  Particle<2> b = scene.add_particle({.mass = 2.0});
  Constraint<2> pin = scene.add(Coincident{Fixed<2>{{1.0, 1.0}}, b}, "pin");
  Constraint<1> slope = scene.add(OnCurve{a, Plane<2>{{0.0, 0.0}, {0.6, 0.8}}}, "slope");
  State state{0.3, Eigen::Vector4d(0.5, -0.2, 1.7, 0.9), Eigen::Vector4d(3.0, 4.0, -0.6, 0.3)};

  /// lambda as the system counts it: `on_slope` and the two of the pin.
  [[nodiscard]] static Eigen::VectorXd multipliers(const System& system, double on_slope,
                                                   const Vec<2>& on_pin) {
    Eigen::VectorXd lambda(3);
    for (const auto& c : system.layout()->constraints) {
      if (c.name == "slope") lambda[c.first_row] = on_slope;
      if (c.name == "pin") lambda.segment<2>(c.first_row) = Eigen::Vector2d(on_pin);
    }
    return lambda;
  }
  void add_sliding() {
    scene.add(
        friction_law(slope, points(a),
                     [](auto lambda, auto, auto v) { return (-0.5 * abs(lambda) * v.normalized()).eval(); }),
        "sliding");
  }
};

// mu |lambda| = 0.5 * 7, against the direction (3, 4)/5, whatever the sign of lambda.
TEST_F(Friction, ReadsTheMultiplierOfItsConstraintAndActsAgainstTheMotion) {
  add_sliding();
  const System system = scene.system();
  for (const double lambda : {7.0, -7.0}) {
    const auto F = dalembert::friction(system, state, multipliers(system, lambda, {100.0, 200.0}));
    EXPECT_TRUE(F.isApprox(Eigen::Vector4d(-2.1, -2.8, 0.0, 0.0), 1e-15)) << F.transpose();
  }
}

// Evaluate knows no multipliers: its force is the others' alone.
TEST_F(Friction, IsNotPartOfTheForcesThatReadNoMultiplier) {
  add_sliding();
  EXPECT_EQ(values(scene.system(), state).F, Eigen::Vector4d::Zero());
}

TEST_F(Friction, TakesAVectorOfSeveralEquationsTimeAndSeveralPoints) {
  scene.add(friction_law(pin, points(a, b), [](auto t, auto lambda, auto, auto, auto, auto) {
    return std::tuple{(t * lambda).eval(), (-1.0 * lambda).eval()};
  }));
  const System system = scene.system();
  const auto F = dalembert::friction(system, state, multipliers(system, 7.0, {10.0, 20.0}));
  EXPECT_TRUE(F.isApprox(Eigen::Vector4d(3.0, 6.0, -10.0, -20.0), 1e-15)) << F.transpose();
}

TEST_F(Friction, DerivativesAreConsistent) {
  add_sliding();
  scene.add(friction_law(pin, points(a, driven([](auto t) { return vec(sin(t), t); }), b),
                         [](auto t, auto lambda, auto r_a, auto, auto r_b, auto v_a, auto v_d, auto v_b) {
                           const auto f = (lambda.norm() * (v_b - v_d) * r_a.dot(r_b)).eval();
                           return std::tuple{f, f, (t * lambda[0] * lambda[1] * v_a).eval()};
                         }));
  const System system = scene.system();
  for (const double lambda : {1.3, -1.3}) {
    expect_consistent(system, state, multipliers(system, lambda, {0.7, -0.4}));
  }
}

// On a point of a body, F and its derivatives go through that point's map.
TEST_F(Friction, HasConsistentDerivativesOnAPointOfABody) {
  const auto body = add_body(scene, BodyState<2>{.mass = 2.0, .inertia = 0.5}, "body");
  const auto corner = body.point({0.4, -0.2});
  const auto floor = scene.add(OnCurve{corner, Plane<2>{{0.0, 0.0}, {0.0, 1.0}}}, "floor");
  scene.add(friction_law(floor, points(corner), [](auto lambda, auto r, auto v) {
    return (-0.5 * lambda * v.normalized() * r.squaredNorm()).eval();
  }));
  const System system = scene.system();
  State at{0.0, Eigen::VectorXd(system.coordinates()), Eigen::VectorXd(system.coordinates())};
  Eigen::VectorXd lambda(system.rows());
  for (Eigen::Index i = 0; i < at.q.size(); ++i) {
    at.q[i] = std::sin(1.0 + 2.3 * static_cast<double>(i));
    at.v[i] = std::cos(2.0 + 1.7 * static_cast<double>(i));
  }
  for (Eigen::Index i = 0; i < lambda.size(); ++i) lambda[i] = 1.0 + 0.1 * static_cast<double>(i);
  expect_consistent(system, at, lambda);
}

TEST_F(Friction, RefusesAHandleThatIsNotOfThisScene) {
  Scene<2> other;
  const auto bead = other.add_particle({.mass = 1.0});
  const auto foreign = other.add(OnCurve{bead, Plane<2>{{0.0, 0.0}, {0.0, 1.0}}});
  const auto law = [](auto lambda, auto, auto v) { return (lambda * v).eval(); };
  EXPECT_THAT([&] { scene.add(friction_law(foreign, points(a), law), "rough"); },
              ThrowsMessage<InvalidArgument>(
                  AllOf(HasSubstr("FrictionLaw \"rough\""), HasSubstr("belongs to another scene"))));
  for (const auto& never : {Constraint<1>{}, Constraint<1>{99, slope.scene}, Constraint<1>{0, pin.scene}}) {
    EXPECT_THAT([&] { scene.add(friction_law(never, points(a), law), "rough"); },
                ThrowsMessage<InvalidArgument>(
                    AllOf(HasSubstr("FrictionLaw \"rough\""), HasSubstr("was never added"))));
  }
  scene.add(friction_law(slope, points(a), law), "rough");  // the name is still free
}

TEST_F(Friction, ABadNumberOrAnExceptionNamesIt) {
  scene.add(friction_law(slope, points(a),
                         [](auto lambda, auto, auto v) {
                           if (lambda > 5.0) throw std::runtime_error("too hot");
                           return (v / (lambda - lambda)).eval();
                         }),
            "brake");
  const System system = scene.system();
  const auto at = [&](double lambda) {
    return [&, lambda] { (void)dalembert::friction(system, state, multipliers(system, lambda, {0.0, 0.0})); };
  };
  EXPECT_THAT(at(1.0), ThrowsMessage<EquationFault>(
                           AllOf(HasSubstr("FrictionLaw \"brake\""), HasSubstr("not a finite number"))));
  EXPECT_THAT(at(6.0), ThrowsMessage<EquationFault>(
                           AllOf(HasSubstr("FrictionLaw \"brake\""), HasSubstr("threw \"too hot\""))));
}

TEST_F(Friction, CouplesTheParticlesItActsOnToTheConstraintItReads) {
  EXPECT_EQ(islands(scene.system()).count, 2);  // the pin and the slope
  scene.add(friction_law(slope, points(b), [](auto lambda, auto, auto v) { return (lambda * v).eval(); }));
  EXPECT_EQ(islands(scene.system()).count, 1);
}

TEST_F(Friction, IsDescribed) {
  EXPECT_THAT(scene.system().describe(), HasSubstr("left out: friction"));
  add_sliding();
  EXPECT_THAT(scene.system().describe(), AllOf(HasSubstr("1 FrictionLaw that read multipliers"),
                                               testing::Not(HasSubstr("left out: friction"))));
}

// A block of 2 kg slides on a table at 3 m/s: N = 20, power -0.25 * 20 * 3.
TEST(FrictionPower, IsNamed) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto block = scene.add_particle({.mass = 2.0, .velocity = {3.0, 0.0}});
  const auto table = scene.add(OnCurve{block, Plane<2>{{0.0, 0.0}, {0.0, 1.0}}});
  scene.add(friction_law(table, points(block),
                         [](auto lambda, auto, auto v) { return (-0.25 * lambda * v.normalized()).eval(); }),
            "rough");
  const VirtualWork at = virtual_work(scene, Simulation<2>(scene, {.t_end = 0.1}).sample());
  ASSERT_EQ(at.forces.size(), 2U);
  EXPECT_EQ(at.forces[1].name, "FrictionLaw \"rough\"");
  EXPECT_NEAR(at.forces[1].power, -15.0, 1e-14);  // a few roundings
  EXPECT_NEAR(at.constraints[0].power, 0.0, 1e-14);
}

TEST(FrictionPower, OfAForceThatThrowsIsAnErrorByName) {
  bool broken = false;
  Scene<2> scene;
  const auto block = scene.add_particle({.mass = 2.0, .velocity = {3.0, 0.0}});
  const auto table = scene.add(OnCurve{block, Plane<2>{}});
  scene.add(friction_law(table, points(block),
                         [&broken](auto lambda, auto, auto v) {
                           if (broken) throw std::runtime_error("no more");
                           return (-0.25 * lambda * v.normalized()).eval();
                         }),
            "rough");
  const Simulation<2> run(scene, {.t_end = 0.1});
  broken = true;
  EXPECT_THAT([&] { (void)virtual_work(scene, run.sample()); },
              ThrowsMessage<EquationFault>(
                  AllOf(HasSubstr("FrictionLaw \"rough\" threw \"no more\""), HasSubstr("(t = 0)"))));
}

}  // namespace
}  // namespace dalembert::friction_test
