#include "failure_of.h"
#include "lagrangians.h"
#include <dalembert/tests/both_steppers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace dalembert::lagrangian_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LagrangianMotions : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end = 2.0) {
    return {.t_end = t_end, .samples = 21, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, LagrangianMotions, both_steppers, stepper_name);

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

TEST_P(LagrangianMotions, FollowARheonomicConstraint) {
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

TEST_P(LagrangianMotions, ObeyTheNonholonomicConstraintsOfARollingDisk) {
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

TEST_P(LagrangianMotions, CanBeReadBetweenSamples) {
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

TEST_P(LagrangianMotions, StopWhereDryFrictionHoldsThem) {
  // q'' = -q -+ 0.3 from rest at 1: half-periods about +-0.3, to -0.4 and -0.2, where friction holds.
  LagrangianSystem<1> block(
      {.position = Vec<1>(1.0)},
      [](const auto& q, const auto& v) { return 0.5 * (v[0] * v[0] - q[0] * q[0]); }, "block");
  block.apply([](double, const Vec<1>&, const Vec<1>& v) {
    return Vec<1>(v[0] > 0.0 ? -0.3 : v[0] < 0.0 ? 0.3 : 0.0);
  });
  const auto failure = failure_of([&] { (void)simulate(block, options(20.0)); });
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->what(),
              HasSubstr("the force of Lagrangian \"block\" jumps where q1 has the velocity 0 and drives"));
  const double rests = 2.0 * std::numbers::pi;
  EXPECT_GT(failure->time(), rests - bound);
  const LagrangianMotion<1> motion(block, failure->trajectory<2>(), tolerance);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double t = motion.times()[i];
    EXPECT_NEAR(motion.position(i)[0],
                t < std::numbers::pi ? 0.3 + 0.7 * std::cos(t)
                : t < rests          ? -0.3 + 0.1 * std::cos(t)
                                     : -0.2,
                bound);
  }
}

TEST_P(LagrangianMotions, NameOnceAConstraintThatThrows) {
  LagrangianSystem<2> circle({.position = {1.0, 0.0}},
                             [](const auto& q, const auto& v) { return 0.5 * v.squaredNorm() - q[1]; });
  circle.constrain(
      [](const auto& t, const auto& q) {
        if (t > 1.0) throw std::runtime_error("torn");
        return q.squaredNorm() - 1.0;
      },
      "ring");
  const auto failure = failure_of([&] { (void)simulate(circle, options()); });
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->what(), HasSubstr(": Holonomic \"ring\" threw \"torn\" (t = 1"));
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

}  // namespace
}  // namespace dalembert::lagrangian_test
