#include <dalembert/core/lagrange/accelerations.h>
#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>
#include <dalembert/tests/finite_differences.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dalembert {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;
/// Runs of a few seconds err by some tens of this.
constexpr double tolerance = 1e-10, bound = 100.0 * tolerance;

/// A pendulum in polar coordinates whose rod is a constraint r = 1: lambda = -tension = -(phi'^2 + g cos
/// phi).
LagrangianSystem<2> polar() {
  return LagrangianSystem<2>({.position = {1.0, 1.0}, .names = {"r", "phi"}},
                             [](const auto& q, const auto& v) {
                               return 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1]) + g * q[0] * cos(q[1]);
                             });
}

struct Polar {
  LagrangianSystem<2> system = polar();
  Constraint<1> rod = system.constrain([](const auto& q) { return q[0] - 1.0; }, "rod");

  [[nodiscard]] static double tension(const LagrangianMotion<2>& motion, std::size_t i) {
    const double rate = motion.velocity(i)[1];
    return rate * rate + g * std::cos(motion.position(i)[1]);
  }
};

/// A pendulum of length 1.
LagrangianSystem<1> by_angle() {
  return LagrangianSystem<1>({.position = Vec<1>(1.0)},
                             [](const auto& q, const auto& v) { return 0.5 * v[0] * v[0] + g * cos(q[0]); });
}

class LagrangianMotions : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end = 2.0) {
    return {.t_end = t_end, .samples = 21, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, LagrangianMotions, both_steppers, stepper_name);

TEST(LagrangeTerms, AreTheDerivativesOfTheFunction) {
  const auto function = [](const auto& t, const auto& q, const auto& v) {
    return 0.5 * (1.0 + q[1] * q[1]) * v[0] * v[0] + sin(t * q[0]) * v[1] + exp(0.3 * v[0] * v[1]) -
           q[0] * q[1];
  };
  const LagrangianOf<2, decltype(function)> L(function);
  const double t = 0.7;
  const Vec<2> q(0.4, -1.1), v(0.8, 0.5);
  const auto terms = L.terms(t, q, v);
  EXPECT_EQ(terms.L, function(t, q, v));
  for (int k = 0; k < 2; ++k) {
    const Vec<2> e = Vec<2>::Unit(k);
    const auto at = [&](double s_q, double s_v) { return L.terms(t, q + s_q * e, v + s_v * e); };
    const auto number = [](double x) { return Eigen::VectorXd::Constant(1, x); };
    expect_slope(slope([&](double s) { return number(at(s, 0.0).L); }), number(terms.L_q[k]), "L_q");
    expect_slope(slope([&](double s) { return number(at(0.0, s).L); }), number(terms.L_v[k]), "L_v");
    expect_slope(slope([&](double s) { return Eigen::VectorXd(at(s, 0.0).L_v); }), terms.L_vq.col(k), "L_vq");
    expect_slope(slope([&](double s) { return Eigen::VectorXd(at(0.0, s).L_v); }), terms.L_vv.col(k), "L_vv");
  }
  expect_slope(slope([&](double s) { return Eigen::VectorXd(L.terms(t + s, q, v).L_v); }), terms.L_vt,
               "L_vt");
}

TEST(Accelerations, ObeyTheConstraintsAndLeaveForcesOfConstraintOnly) {
  // Indefinite, in units that differ by nine digits, and with a row that is the sum of two others.
  detail::SmallMatrix M(4, 4), A(3, 4);
  M << 2.0, 0.3, 0.0, 1e-9, 0.3, -1.0, 0.2, 0.0, 0.0, 0.2, 1.5, 0.0, 1e-9, 0.0, 0.0, 1e-18;
  A << 1.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 2.0, 1.0, 0.0;
  detail::SmallVector f(4), gamma(3);
  f << 1.0, 2.0, -1.0, 3e-9;
  gamma << 0.5, -0.3, 0.2;
  const auto found = detail::accelerations(M, f, A, gamma);
  ASSERT_EQ(found.without_inertia.size(), 0);
  constexpr double rounding = 1e-14;  // of numbers near 1, over a handful of operations
  EXPECT_LE((A * found.a + gamma).cwiseAbs().maxCoeff(), rounding);
  const detail::SmallVector reaction = M * found.a - f;  // a combination of the rows of A
  EXPECT_NEAR(reaction[0], reaction[2], rounding);
  EXPECT_NEAR(reaction[3], 0.0, 1e-9 * rounding);
}

TEST(Accelerations, SayAlongWhatThereIsNoInertia) {
  detail::SmallMatrix M(2, 2), none(0, 2), A(1, 2);
  M << 1.0, 1.0, 1.0, 1.0;
  A << 1.0, 0.0;
  detail::SmallVector f(2), zero(1);
  f << 1.0, 0.0;
  zero << 0.0;
  const auto direction = detail::accelerations(M, f, none, detail::SmallVector(0)).without_inertia;
  ASSERT_EQ(direction.size(), 2);
  EXPECT_NEAR(direction[0] + direction[1], 0.0, 1e-15);
  // A constraint that forbids that direction leaves a regular system: a = (0, a_1), a_1 = f_1 = 0.
  EXPECT_EQ(detail::accelerations(M, f, A, zero).without_inertia.size(), 0);
}

TEST_P(LagrangianMotions, HaveTheMultipliersOfNewtonsDerivation) {
  const Polar pendulum;
  const auto motion = simulate(pendulum.system, options());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double tension = Polar::tension(motion, i);
    EXPECT_NEAR(motion.multiplier(pendulum.rod, i), -tension, bound * g);
    EXPECT_NEAR(motion.constraint_force(pendulum.rod, i)[0], -tension, bound * g);
    EXPECT_EQ(motion.constraint_force(pendulum.rod, i)[1], 0.0);
  }
}

TEST_P(LagrangianMotions, ShareForcesOfConstraintsThatAreStatedTwice) {
  Polar pendulum;
  const auto again = pendulum.system.constrain([](const auto& q) { return 2.0 * (q[0] - 1.0); });
  const auto motion = simulate(pendulum.system, options());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Vec<2> together = motion.constraint_force(pendulum.rod, i) + motion.constraint_force(again, i);
    EXPECT_NEAR(together[0], -Polar::tension(motion, i), bound * g);
  }
}

TEST_P(LagrangianMotions, OfARheonomicConstraintFollowIt) {
  // r = 1 + t/10 prescribed: lambda = r'' - r phi'^2 - g cos phi, and the angular momentum changes by
  // gravity.
  LagrangianSystem<2> system({.position = {1.0, 0.5}, .velocity = {0.1, 0.0}},
                             [](const auto& q, const auto& v) {
                               return 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1]) + g * q[0] * cos(q[1]);
                             });
  const auto winch = system.constrain([](const auto& t, const auto& q) { return q[0] - 1.0 - 0.1 * t; });
  const auto motion = simulate(system, options());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Vec<2> q = motion.position(i), v = motion.velocity(i);
    EXPECT_NEAR(q[0], 1.0 + 0.1 * motion.times()[i], bound);
    EXPECT_NEAR(motion.multiplier(winch, i), -q[0] * v[1] * v[1] - g * std::cos(q[1]), bound * g);
  }
}

TEST_P(LagrangianMotions, OfARollingDiskObeyItsNonholonomicConstraints) {
  // mln37: upright disk on a plane tilted by beta, x downhill, heading alpha = Omega t:
  // phi'' = m g r sin(beta) cos(Omega t)/(I + m r^2).
  constexpr double m = 2.0, r = 0.5, I = 0.25, J = 0.125, beta = 0.3, Omega = 1.5;
  LagrangianSystem<4> disk({.velocity = {0.0, 0.0, Omega, 0.0}, .names = {"x", "y", "alpha", "phi"}},
                           [](const auto& q, const auto& v) {
                             return 0.5 * m * (v[0] * v[0] + v[1] * v[1]) + 0.5 * J * v[2] * v[2] +
                                    0.5 * I * v[3] * v[3] + m * g * std::sin(beta) * q[0];
                           });
  const auto roll = disk.constrain_velocities([](const auto& q, const auto& v) {
    return vec(v[0] - r * v[3] * cos(q[2]), v[1] - r * v[3] * sin(q[2]));
  });
  const auto motion = simulate(disk, options());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double t = motion.times()[i], angle = Omega * t,
                 pull = m * g * r * std::sin(beta) / (I + m * r * r);
    const double spin = pull / Omega * std::sin(angle), spin_rate = pull * std::cos(angle);
    EXPECT_NEAR(motion.position(i)[3], pull / (Omega * Omega) * (1.0 - std::cos(angle)), bound);
    EXPECT_NEAR(motion.velocity(i)[3], spin, bound);
    // Newton's law for the centre, x = r phi' (cos, sin) differentiated.
    const Vec<2> force = motion.multiplier(roll, i);
    EXPECT_NEAR(
        force.x(),
        m * r * (spin_rate * std::cos(angle) - spin * Omega * std::sin(angle)) - m * g * std::sin(beta),
        bound * g);
    EXPECT_NEAR(force.y(), m * r * (spin_rate * std::sin(angle) + spin * Omega * std::cos(angle)), bound * g);
  }
}

TEST_P(LagrangianMotions, TakeForcesThatHaveNoPotential) {
  // x'' = -2 c x' - w^2 x from (1, 0): exp(-c t) (cos u t + (c/u) sin u t), u^2 = w^2 - c^2.
  constexpr double c = 0.4, w = 3.0;
  const double u = std::sqrt(w * w - c * c);
  LagrangianSystem<1> spring({.position = Vec<1>(1.0)}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] - 0.5 * w * w * q[0] * q[0];
  });
  spring.apply([](double, const Vec<1>&, const Vec<1>& v) -> Vec<1> { return -2.0 * c * v; });
  const auto motion = simulate(spring, options());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double t = motion.times()[i];
    EXPECT_NEAR(motion.position(i)[0], std::exp(-c * t) * (std::cos(u * t) + c / u * std::sin(u * t)), bound);
  }
}

TEST_P(LagrangianMotions, ConserveTheMomentaOfCyclicCoordinatesAndTheEnergyFunction) {
  // A particle in the field -1/r, in polar coordinates.
  const LagrangianSystem<2> kepler({.position = {1.0, 0.3}, .velocity = {0.2, 0.9}},
                                   [](const auto& q, const auto& v) {
                                     return 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1]) + 1.0 / q[0];
                                   });
  EXPECT_THAT(kepler.cyclic(), ElementsAre(1));
  const auto motion = simulate(kepler, options());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    EXPECT_NEAR(motion.momentum(i)[1], 0.9, bound);
    EXPECT_NEAR(motion.energy_function(i), 0.5 * (0.04 + 0.81) - 1.0, bound);
  }
  // The bead on a turning hoop: h is Jacobi's integral, not the energy.
  const LagrangianSystem<1> hoop({.position = Vec<1>(1.4)}, [](const auto& q, const auto& v) {
    const auto around = 4.5 * sin(q[0]);
    return 0.5 * (v[0] * v[0] + around * around) + g * cos(q[0]);
  });
  EXPECT_TRUE(hoop.cyclic().empty());
  const auto turned = simulate(hoop, options());
  const double jacobi = -0.5 * 4.5 * 4.5 * std::sin(1.4) * std::sin(1.4) - g * std::cos(1.4);
  EXPECT_NEAR(turned.energy_function(20), jacobi, bound * g);
}

TEST_P(LagrangianMotions, TakeTheSameStepsInAnyUnitOfTheirCoordinates) {
  const auto steps = [](double unit) {
    const LagrangianSystem<1> bead({.position = Vec<1>(unit), .scale = Vec<1>(unit)},
                                   [unit](const auto& q, const auto& v) {
                                     const auto x = q[0] / unit;
                                     return 0.5 * (1.0 + x * x) * v[0] * v[0] - g * q[0] * q[0];
                                   });
    const auto motion = simulate(bead, options());
    return std::pair(motion.statistics().steps, motion.position(20)[0] / unit);
  };
  const auto [steps_m, x_m] = steps(1.0);
  const auto [steps_nm, x_nm] = steps(1e-9);
  EXPECT_NEAR(static_cast<double>(steps_m), static_cast<double>(steps_nm),
              0.05 * static_cast<double>(steps_m));
  EXPECT_NEAR(x_m, x_nm, bound);
}

TEST_P(LagrangianMotions, DoNotDependOnTheSizeOfTheInertia) {
  // A crane of 1000 kg on 10 m, a bob in millimetres, in Cartesian coordinates; by the angle for comparison.
  struct Units {
    double mass, length;
  };
  for (const Units u : {Units{1000.0, 10.0}, Units{2.0, 1000.0}, Units{1e-6, 1e-3}, Units{1e6, 1.0}}) {
    const double pull = g * u.length;  // so that all have one period
    LagrangianSystem<2> cartesian(
        {.position = {u.length * std::sin(1.0), -u.length * std::cos(1.0)}, .scale = {u.length, u.length}},
        [=](const auto& q, const auto& v) {
          return 0.5 * u.mass * (v[0] * v[0] + v[1] * v[1]) - u.mass * pull * q[1];
        });
    const auto rope = cartesian.constrain([=](const auto& q) { return q.norm() - u.length; });
    const auto motion = simulate(cartesian, options(5.0));
    const auto angle = simulate(by_angle(), options(5.0));
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const double phi = angle.position(i)[0], rate = angle.velocity(i)[0];
      EXPECT_NEAR(motion.position(i)[0] / u.length, std::sin(phi), bound);
      EXPECT_NEAR(-motion.multiplier(rope, i) / (u.mass * u.length), rate * rate + g * std::cos(phi),
                  bound * g);
    }
  }
}

TEST_P(LagrangianMotions, TakeAsManyStepsWhateverLIsMultipliedBy) {
  const auto steps = [](double factor) {
    const LagrangianSystem<1> pendulum({.position = Vec<1>(1.0)}, [factor](const auto& q, const auto& v) {
      return factor * (0.5 * v[0] * v[0] + g * cos(q[0]));
    });
    return static_cast<double>(simulate(pendulum, options()).statistics().steps);
  };
  const double of_one = steps(1.0);
  for (const double factor : {1e-9, 1e9, 1e12}) EXPECT_NEAR(steps(factor), of_one, 0.05 * of_one) << factor;
}

TEST_P(LagrangianMotions, MayBeginWhenTheInertiaIsOfAnotherSignThanAtTimeZero) {
  // cos(t) v^2/2 from t = 2 on: cos(t) v is constant.
  const LagrangianSystem<1> system(
      {.velocity = Vec<1>(1.0)},
      [](const auto& t, const auto& /*q*/, const auto& v) { return 0.5 * cos(t) * v[0] * v[0]; });
  Options later = options(4.0);
  later.t_start = 2.0;
  const auto motion = simulate(system, later);
  for (std::size_t i = 0; i < motion.size(); ++i)
    EXPECT_NEAR(motion.velocity(i)[0], std::cos(2.0) / std::cos(motion.times()[i]), bound);
}

TEST(LagrangianMotion, RefusesForcesWhereConstraintsAreCloseToDependent) {
  // A point at the crossing of a line and a circle that it touches: x = 0 and x^2 + (y - 1)^2 = 1 - 2 c with
  // small c are crossed at an angle of the root of 2 c.
  constexpr double c = 1e-8;
  LagrangianSystem<2> system({.position = {1.0 - std::sqrt(1.0 - 2.0 * c + c * c), c}},
                             [](const auto& /*q*/, const auto& v) { return 0.5 * v.squaredNorm(); });
  const auto circle = system.constrain([](const auto& q) {
    const auto x = q[0] - 1.0;
    return x * x + q[1] * q[1] - 1.0 + 2.0 * c - 2.0 * c * c;
  });
  system.constrain([](const auto& q) {
    const auto x = q[0] - 1.0;
    return x * x + (q[1] - 2e-6) * (q[1] - 2e-6) - 1.0 + 2.0 * c - 2.0 * c * c + 4e-6 * c - 4e-12;
  });
  const auto motion = simulate(system, {.t_end = 1.0, .samples = 2, .tolerance = 1e-8, .assemble = true});
  EXPECT_THROW((void)motion.multiplier(circle, 0), UndeterminedForce);
}

TEST_P(LagrangianMotions, AreReadBetweenSamplesAsWell) {
  const LagrangianSystem<1> spring({.position = Vec<1>(1.0)}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] - 0.5 * q[0] * q[0];
  });
  Options dense = options();
  dense.dense = true;
  const auto motion = simulate(spring, dense).at(std::array{0.123, 1.777});
  EXPECT_NEAR(motion.position(0)[0], std::cos(0.123), bound);
  EXPECT_NEAR(motion.position(1)[0], std::cos(1.777), bound);
}

TEST_P(LagrangianMotions, EndWhereTheInertiaIsLostAndKeepWhatWasComputed) {
  // q v^2/2 with a force towards q = 0, where there is no inertia.
  const LagrangianSystem<1> system(
      {.position = Vec<1>(1.0), .names = {"q"}},
      [](const auto& q, const auto& v) { return 0.5 * q[0] * v[0] * v[0] - 4.0 * q[0]; });
  try {
    (void)simulate(system, options());
    FAIL() << "went through a place without inertia";
  } catch (const IntegrationFailure& failure) {
    const LagrangianMotion<1> motion(system, failure.trajectory<2>(), tolerance);
    ASSERT_GT(motion.size(), 1U);
    EXPECT_GT(motion.position(motion.size() - 1)[0], 0.0);
    EXPECT_NEAR(motion.energy_function(motion.size() - 1), 4.0, 1e3 * bound);
  }
}

TEST_P(LagrangianMotions, StopWhereTheInertiaIsLostOnTheWay) {
  // v^4/4 - v^2/2 - q: (3 v^2 - 1) v' = -1, so that t = v - v^3 from v = 1 on, to v = 1/sqrt 3 at 2/(3 sqrt
  // 3).
  const LagrangianSystem<1> system({.velocity = Vec<1>(1.0)}, [](const auto& q, const auto& v) {
    const auto square = v[0] * v[0];
    return 0.25 * square * square - 0.5 * square - q[0];
  });
  try {
    (void)simulate(system, options(1.0));
    FAIL() << "went on where there is no motion";
  } catch (const IntegrationFailure& failure) {
    EXPECT_NEAR(failure.time(), 2.0 / (3.0 * std::sqrt(3.0)), 1e-6);
    // The explicit stepper sees accelerations without bound only, and no step short enough.
    if (GetParam() == Stepper::ida) {
      EXPECT_THAT(failure.what(), HasSubstr("d^2L/dv^2 is singular"));
    }
  }
}

TEST(LagrangianSystems, SayWhereAndAlongWhatNoAccelerationFollows) {
  const LagrangianSystem<2> together(
      {.position = {1.0, 2.0}},
      [](const auto& q, const auto& v) { return 0.5 * (v[0] + v[1]) * (v[0] + v[1]) - q[0] * q[1]; }, "pair");
  EXPECT_THAT(
      [&] { (void)simulate(together, {.t_end = 1.0}); },
      ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("Lagrangian \"pair\""), HasSubstr("q = (1, 2)"),
                                             HasSubstr("singular"), HasSubstr("t = 0"))));
  const LagrangianSystem<1> still({.position = Vec<1>(1.0)},
                                  [](const auto& q, const auto& /*v*/) { return q[0] * q[0]; });
  EXPECT_THAT([&] { (void)simulate(still, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("has no inertia")));
  const LagrangianSystem<1> undefined(
      {.position = Vec<1>(-1.0)}, [](const auto& q, const auto& v) { return 0.5 * v[0] * v[0] - log(q[0]); });
  EXPECT_THAT([&] { (void)simulate(undefined, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("no finite value")));
}

TEST(LagrangianSystems, RefuseWhatMakesNoSense) {
  const auto free = [](const auto& /*q*/, const auto& v) { return 0.5 * v[0] * v[0]; };
  EXPECT_THAT([&] { LagrangianSystem<1>({.scale = Vec<1>(0.0), .names = {"x"}}, free); },
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"x\""), HasSubstr("scale = 0"))));
  EXPECT_THROW(LagrangianSystem<1>({.position = Vec<1>(std::nan(""))}, free), InvalidScene);
  EXPECT_THAT([&] { LagrangianSystem<1>({}, std::shared_ptr<const Lagrangian<1>>(), "none"); },
              ThrowsMessage<InvalidScene>(HasSubstr("\"none\" has no Lagrangian")));
  LagrangianSystem<1> forced({}, free);
  EXPECT_THROW(forced.apply(nullptr), InvalidArgument);
  LagrangianSystem<1> off({.position = Vec<1>(1.0)}, free);
  off.constrain([](const auto& q) { return q[0] - 2.0; }, "stop");
  EXPECT_THAT([&] { (void)simulate(off, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(HasSubstr("stop")));
}

TEST(LagrangianSystems, GiveTheirDerivativesToNewtonsMatrix) {
  const Polar pendulum;
  const System system = pendulum.system.rotor_scene(0.0).system();
  const std::vector<double> q{1.0, 0.8}, v{0.0, 1.3}, lambda{0.0};
  auto terms = system.linearisation();
  system.linearise_forces({0.0, q, v}, lambda, terms);
  const auto force = [&](std::size_t k, double s_q, double s_v) {
    auto e = system.evaluation();
    std::vector<double> at_q = q, at_v = v;
    at_q[k] += s_q;
    at_v[k] += s_v;
    system.evaluate({0.0, at_q, at_v}, e);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(e.force.data(), 2));
  };
  // Both are differences of steps near 1e-5 of forces near 10: 1e-9 of them.
  constexpr double of_differences = 1e-8;
  for (std::size_t k = 0; k < 2; ++k) {
    const Slope by_q = slope([&](double s) { return force(k, s, 0.0); }),
                by_v = slope([&](double s) { return force(k, 0.0, s); });
    for (std::size_t row = 0; row < 2; ++row) {
      const auto entry = system.stiffness_of_constraints() + 2 * row + k;
      EXPECT_NEAR(terms.stiffness[entry], by_q.value[static_cast<int>(row)], of_differences);
      EXPECT_NEAR(terms.damping[2 * row + k], by_v.value[static_cast<int>(row)], of_differences);
    }
  }
}

TEST(RouthReduction, TellsTheRateOfTheCoordinateLeftOut) {
  // A particle in the field -1/r: of r'' = beta^2/r^3 - 1/r^2 only r is left, and phi' = beta/r^2.
  const LagrangianSystem<2> kepler({.position = {1.0, 0.3}, .velocity = {0.2, 0.9}},
                                   [](const auto& q, const auto& v) {
                                     return 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1]) + 1.0 / q[0];
                                   });
  const auto radial = reduced(kepler, 1);
  EXPECT_EQ(radial.routhian->momentum(), 0.9);
  const Options options{.t_end = 3.0, .samples = 7, .tolerance = tolerance};
  const auto all = simulate(kepler, options);
  const auto one = simulate(radial.system, options);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(one.position(i)[0], all.position(i)[0], bound);
    const double r = one.position(i)[0];
    EXPECT_NEAR(one.acceleration(i)[0], 0.81 / (r * r * r) - 1.0 / (r * r), 1e-12);
    EXPECT_NEAR(radial.routhian->rate(0.0, one.position(i), one.velocity(i)), all.velocity(i)[1], bound);
  }
}

TEST(RouthReduction, FindsRatesOfAMomentumThatIsNotLinearInThem) {
  // p = x' + 4 x'^3 + y: from the rate at the start, through rates near 0.
  const LagrangianSystem<2> system({.velocity = {1.0, 0.0}}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] + v[0] * v[0] * v[0] * v[0] + v[0] * q[1] + 0.5 * v[1] * v[1];
  });
  const auto left = reduced(system, 0);
  for (double y = -10.0; y <= 20.0; y += 0.01) {
    const double x = left.routhian->rate(0.0, Vec<1>(y), Vec<1>(0.0));
    // Round-off of p over its slope, 1 at least.
    EXPECT_NEAR(x + 4.0 * x * x * x + y, 5.0, 1e-13 * 20.0);
  }
}

TEST(LagrangianSystems, AreNotCyclicWhereACoordinateMattersElsewhere) {
  const LagrangianSystem<2> stop({}, [](const auto& q, const auto& v) {
    const auto pressed = max(q[0] - 3.0, 0.0);
    return 0.5 * v.squaredNorm() - pow(pressed, 4.0) + cos(q[1]);
  });
  EXPECT_TRUE(stop.cyclic().empty());
}

TEST(RouthReduction, IsRefusedWhereTheMomentumIsNotConserved) {
  const auto free = [](const auto& q, const auto& v) { return 0.5 * v.squaredNorm() - q[1] * q[1]; };
  LagrangianSystem<2> system({.position = {0.0, 1.0}, .names = {"x", "y"}}, free);
  EXPECT_THAT([&] { (void)reduced(system, 1); },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("\"y\""), HasSubstr("not cyclic"))));
  EXPECT_THROW((void)reduced(system, 2), InvalidArgument);
  system.apply([](double, const Vec<2>&, const Vec<2>& v) -> Vec<2> { return -v; });
  EXPECT_THAT([&] { (void)reduced(system, 0); }, ThrowsMessage<InvalidArgument>(HasSubstr("not conserved")));
}

/// A pendulum of length 1 as a particle on a rod, and by its angle.
struct Twofold {
  Scene<2> scene;
  Particle<2> bob;
  Constraint<1> rod;
  LagrangianSystem<1> system = by_angle();
  Embedding<2, 1> embedding;

  Twofold() {
    scene.add(UniformGravity<2>{{0.0, -g}});
    bob = scene.add_particle({.mass = 1.0, .position = {std::sin(1.0), -std::cos(1.0)}}, "bob");
    rod = scene.add(Distance{Fixed<2>{}, bob, 1.0});
  }
  void embed() {
    embedding.add(bob, [](const auto& q) { return vec(sin(q[0]), -cos(q[0])); });
  }
};

TEST(EmbeddedMotion, HasTheForcesOfConstraintThatNewtonsLawAsksFor) {
  Twofold pendulum;
  pendulum.embed();
  const auto motion = simulate(pendulum.system, {.t_end = 2.0, .samples = 9, .tolerance = tolerance});
  const EmbeddedMotion<2> embedded(pendulum.scene, pendulum.embedding, motion);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double angle = motion.position(i)[0], rate = motion.velocity(i)[0];
    const Vec<2> along(-std::sin(angle), std::cos(angle));
    const Vec<2> force = (rate * rate + g * std::cos(angle)) * along;
    EXPECT_LE((embedded.constraint_force(pendulum.bob, i) - force).norm(), 1e-13 * g);
    EXPECT_LE((embedded.velocity(pendulum.bob, i) - rate * Vec<2>(std::cos(angle), std::sin(angle))).norm(),
              1e-14 * g);
  }
  EXPECT_THROW((void)embedded.position(pendulum.bob, 9), InvalidArgument);
}

TEST(CrossCheck, ReportsTheLargestDifferences) {
  Twofold pendulum;
  pendulum.embed();
  const auto check = cross_check(pendulum.scene, pendulum.system, pendulum.embedding,
                                 {.t_end = 2.0, .samples = 21, .tolerance = 1e-8});
  EXPECT_LE(check.position.relative(), 1e-6);
  EXPECT_LE(check.force.relative(), 1e-6);
  EXPECT_THAT(check.report(), AllOf(HasSubstr("forces of constraint differ by"), HasSubstr("\"bob\"")));
}

TEST(CrossCheck, FindsAWrongLagrangian) {
  Twofold pendulum;
  pendulum.embed();
  const LagrangianSystem<1> wrong({.position = Vec<1>(1.0)}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] + 1.01 * g * cos(q[0]);
  });
  const auto check = cross_check(pendulum.scene, wrong, pendulum.embedding, {.t_end = 2.0, .samples = 21});
  EXPECT_GT(check.position.relative(), 1e-3);
}

TEST(CrossCheck, SaysWhatDoesNotFitTogether) {
  const Options options{.t_end = 1.0, .samples = 3};
  Twofold pendulum;
  const auto check = [&] {
    return cross_check(pendulum.scene, pendulum.system, pendulum.embedding, options);
  };
  EXPECT_THAT(check, ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("embedding"), HasSubstr("\"bob\""))));
  pendulum.embedding.add(pendulum.bob, [](const auto& q) { return vec(sin(q[0]), cos(q[0])); });
  EXPECT_THAT(check, ThrowsMessage<InvalidArgument>(HasSubstr("do not begin in the same state")));
  pendulum.embed();
  EXPECT_NO_THROW((void)check());  // what is added last holds
  pendulum.scene.add(friction_law(pendulum.rod, points(pendulum.bob),
                                  [](auto lambda, auto, auto v) { return (0.01 * lambda * v).eval(); }));
  EXPECT_THAT(check, ThrowsMessage<InvalidArgument>(HasSubstr("reads a multiplier")));
  Scene<2> other;
  const auto stranger = other.add_particle({.mass = 1.0});
  Twofold again;
  again.embed();
  again.embedding.add(stranger, [](const auto& q) { return vec(q[0], q[0]); });
  EXPECT_THROW((void)cross_check(again.scene, again.system, again.embedding, options), InvalidArgument);
}

}  // namespace
}  // namespace dalembert
