#include "dalembert/models/chain_over_edge.h"

#include <dalembert/tests/both_steppers.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace dalembert::models::chain_over_edge_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double tolerance = 1e-8;
/// A run errs by some tens of its tolerance, and so do its times.
constexpr double bound = 100.0 * tolerance;

Trajectory<2> run(const ChainOverEdge& system, const GuidedChain& chain, const Options& options,
                  std::vector<Event<2>> others = {}) {
  others.insert(others.begin(), system.leaves(chain));
  return simulate(chain.scene, options, others);
}

/// When the last bead leaves, as a part of the closed form's T too late.
double late(const ChainOverEdge& system, Stepper stepper, double accuracy = tolerance) {
  const auto result =
      run(system, system.scene(),
          {.t_end = 2.0 * system.time(), .samples = 2, .tolerance = accuracy, .stepper = stepper});
  return result.events().empty() ? NAN : result.events()[0].time / system.time() - 1.0;
}

TEST(RoundedEdge, HasItsLengthAndCurvatureInClosedForm) {
  const RoundedEdge edge{0.7};
  EXPECT_NEAR(edge.along({0.0, -30.0}), 30.0, 1e-13);
  EXPECT_NEAR(edge.along({-30.0, 0.0}), -30.0 + 0.7 * RoundedEdge::shortcut(), 1e-13);
  // Chords of an arc are shorter by (curvature step)^2/24, here 1e-8; slopes turn by curvature times length.
  const double step = 1e-3;
  double squares = 0.0, beyond_corner = 0.0;
  for (double d = -36.0; d < 36.0; d += step) {
    const Vec<2> from = edge.position(d), to = edge.position(d + step);
    const double length = edge.along(to) - edge.along(from);
    ASSERT_NEAR(edge(from), 0.0, 1e-14) << d;
    ASSERT_NEAR(length / (to - from).norm(), 1.0, 1e-7) << d;
    const double curvature = (std::atan(std::exp(d + step)) - std::atan(std::exp(d))) / length;
    squares += curvature * curvature * length;
    if (edge.along(from) > 0.0) beyond_corner += curvature * curvature * length;
  }
  EXPECT_NEAR(squares, 2.0 / (3.0 * 0.7), step * step);
  EXPECT_NEAR(beyond_corner / squares, RoundedEdge::curved_beyond_corner, step);
}

class ChainOverEdgeBy : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(const ChainOverEdge& system, int samples) {
    const double t_end = system.friction > 0.0 ? system.time() : system.time_of_links();
    return {.t_end = t_end, .samples = samples, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, ChainOverEdgeBy, both_steppers, stepper_name);
/// Against the continuum: too long for sanitizers, see the preset `debug`.
class ChainsOfManyLinks : public ChainOverEdgeBy {};
INSTANTIATE_TEST_SUITE_P(Steppers, ChainsOfManyLinks, both_steppers, stepper_name);

TEST_P(ChainsOfManyLinks, LeavesAtTheTimeOfTheContinuumWithOrderFiveQuartersOfTheLinks) {
  const int finest = GetParam() == Stepper::erk ? 400 : 100;
  double before = 0.0;
  for (int links = 25; links <= finest; links *= 2) {
    const ChainOverEdge system{.links = links};
    const double error = late(system, GetParam()), derived = system.time_of_links() / system.time() - 1.0;
    // Of the next order: the chords' is (link/radius)^2 of it, at most a hundredth, and R over A.
    EXPECT_NEAR(error, derived, (0.01 + 4.0 / links) * derived + bound) << links;
    if (links >= 100) {
      EXPECT_NEAR(std::log2(before / error), 1.25, 0.06) << links;
    }
    before = error;
  }
}

TEST_P(ChainsOfManyLinks, LeavesARoughTableAtTheOneWithFrictionAsWell) {
  const int finest = GetParam() == Stepper::erk ? 400 : 100;
  double before = 0.0;
  for (int links = 50; links <= finest; links *= 2) {
    const ChainOverEdge system{.links = links, .friction = 0.2};
    const double error = late(system, GetParam()), derived = system.time_of_links() / system.time() - 1.0;
    EXPECT_GT(error, derived) << links;  // the bend only brakes
    EXPECT_LT(error, 1.5 * derived) << links;
    if (links > 50) {
      EXPECT_GT(std::log2(before / error), 1.25) << links;  // what is of order 3 still shows
    }
    before = error;
  }
}

TEST_P(ChainsOfManyLinks, FourHundredAreWithinHalfAPercentOfTheContinuum) {
  for (const double mu : {0.0, 0.2})
    EXPECT_LT(std::abs(late({.links = 400, .friction = mu}, GetParam(), 1e-6)), 0.005) << mu;
}

/// The chain as one degree of freedom, by the depth h of its end.
struct AtDepth {
  double fallen = 0.0;   // sum of m (-y), over mass
  double inertia = 0.0;  // sum of m (velocity over h')^2, over mass
  double last = 0.0;     // s of the last bead
};
AtDepth at_depth(const ChainOverEdge& system, double h) {
  const RoundedEdge edge = system.edge();
  const double link = system.link() / edge.radius;
  const auto tangent = [&](double d) {
    return Vec<2>(edge.radius / (1.0 + std::exp(d)), -edge.radius / (1.0 + std::exp(-d)));
  };
  AtDepth all;
  double d = std::log(std::expm1(h / edge.radius)), rate = -1.0 / tangent(d).y();
  for (int i = 0; i <= system.links; ++i) {
    const double m = (i == 0 || i == system.links ? 0.5 : 1.0) / system.links;
    const Vec<2> here = edge.position(d), velocity = rate * tangent(d);
    all.fallen -= m * here.y();
    all.inertia += m * velocity.squaredNorm();
    all.last = edge.along(here);
    double other = d - link;
    for (int newton = 0; newton < 20; ++newton) {
      const Vec<2> rod = edge.position(other) - here;
      other -= (rod.norm() - system.link()) * rod.norm() / rod.dot(tangent(other));
    }
    const Vec<2> rod = edge.position(other) - here;
    rate = rod.dot(velocity) / rod.dot(tangent(other));
    d = other;
  }
  return all;
}

TEST_P(ChainOverEdgeBy, LeavesWhenTheEnergyOfItsLinksSays) {
  // Of these very links, T = int sqrt(inertia/(2 g (fallen - fallen at the start))) dh; h = B + q^2 takes the
  // root out. Gauss's rule with two points on so many intervals to each link errs by 1e-9.
  const ChainOverEdge system{.links = 50};
  double until = system.length;  // Newton's method, ds/dh = 1
  for (int newton = 0; newton < 20; ++newton) until -= at_depth(system, until).last;
  const double start = at_depth(system, system.hanging).fallen;
  const int intervals = 40 * system.links;
  const double step = std::sqrt(until - system.hanging) / intervals;
  double time = 0.0;
  for (int i = 0; i < 2 * intervals; ++i) {
    const double q = (i / 2 + 0.5 + (i % 2 - 0.5) / std::numbers::sqrt3) * step;
    const AtDepth now = at_depth(system, system.hanging + q * q);
    time += q * step * std::sqrt(now.inertia / (2.0 * system.gravity * (now.fallen - start)));
  }
  EXPECT_NEAR((late(system, GetParam()) + 1.0) * system.time(), time, bound * time);
}

/// The tension at the edge: that on the wall, which is linear in the depth, continued to s = 0. (In the bend
/// rods carry more, tension over the cosine of half of what they turn by, and what bends it also weighs.)
double tension_at_edge(const ChainOverEdge& system, const GuidedChain& chain, const Sample<2>& now) {
  const auto depth = [&](std::size_t i) {
    return -0.5 * (now.position(chain.beads[i]).y() + now.position(chain.beads[i + 1]).y());
  };
  const auto tension = [&](std::size_t i) { return -now.multiplier(chain.rods[i]); };
  std::size_t i = 1;  // the last rod ten R below the edge, where the bend is e^-10
  while (depth(i + 1) > 10.0 * system.edge().radius) ++i;
  return tension(i) + (tension(i) - tension(i - 1)) * depth(i) / (depth(i - 1) - depth(i));
}

TEST_P(ChainsOfManyLinks, HasTheTensionOfTheContinuumAtTheEdge) {
  for (const double mu : {0.0, 0.2}) {
    for (const int links : {50, 100}) {
      const ChainOverEdge system{.links = links, .friction = mu};
      const GuidedChain chain = system.scene();
      const auto result = run(system, chain, options(system, 12));
      // Of leading order: by some D, and by what is smooth between the rough part and the edge.
      const double D = system.length / (27.0 * std::pow(links, 1.25));
      const double limit =
          (5.0 * D - (1.0 + mu) * system.origin()) * system.mass * system.gravity / system.length;
      for (std::size_t i = 1; i + 1 < result.size(); ++i) {  // sliding
        const auto now = result.sample(i);
        const double h = -now.position(chain.beads.front()).y() - system.origin();
        EXPECT_NEAR(tension_at_edge(system, chain, now), system.tension(h), limit) << links << " " << mu;
      }
    }
  }
}

TEST_P(ChainOverEdgeBy, HasToBeHeldDownFromWhereTheTensionNoLongerTurnsIt) {
  for (const double mu : {0.0, 0.2}) {
    const ChainOverEdge system{.links = 100, .friction = mu};
    const GuidedChain chain = system.scene();
    const auto towards_table = [&chain](const auto& now) {
      double sum = 0.0;
      for (std::size_t i = 0; i < chain.beads.size(); ++i)
        sum -= now.constraint_force(chain.guides[i], chain.beads[i]).x();
      return sum;
    };
    const auto result = run(system, chain, options(system, 2), {{"pulls", towards_table}});
    ASSERT_FALSE(result.events().empty());
    ASSERT_EQ(result.events()[0].source, 1U);
    // Without friction, sigma R more in (A - h) h = h^2 - B^2 moves h by h sigma R/(4 h - A), on to its
    // second order; less with friction, for what is braked is less.
    const double sharp = system.time_of_pulling(), rate = std::sqrt(system.gravity / system.length);
    const double h = system.hanging * std::cosh(rate * sharp);
    const double more = RoundedEdge::shortcut() * system.edge().radius;
    const double later = h * more / (4.0 * h - system.length) / (rate * std::sqrt(h * h - 0.25));
    if (mu == 0.0) {
      EXPECT_NEAR(result.events()[0].time, sharp + later, more / system.length * later);
    } else {
      EXPECT_NEAR(result.events()[0].time, sharp, later);
    }
  }
}

TEST_P(ChainOverEdgeBy, KeepsItsEnergyOrLosesTheWorkOfFriction) {
  for (const double mu : {0.0, 0.2}) {
    const ChainOverEdge system{.links = 100, .friction = mu};
    const GuidedChain chain = system.scene();
    const auto result = run(system, chain, options(system, 201));
    const double turned_over = system.mass * system.gravity * system.length;
    double work = 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {  // Simpson's rule
      const double weight = i == 0 || i + 1 == result.size() ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      for (std::size_t k = 0; k < chain.friction.size(); ++k)
        work +=
            weight / 3.0 * system.time() / 200.0 *
            result.sample(i).force(chain.friction[k], chain.beads[k]).dot(result.velocity(chain.beads[k], i));
    }
    const double gained = result.sample(result.size() - 1).energy() - result.sample(0).energy();
    EXPECT_NEAR(gained, work, mu == 0.0 ? bound * turned_over : 1e-4 * turned_over) << mu;
    // The bend takes 0.08 mu tau/N^(5/4) over a way of A/2, tau being a third of the weight at most.
    EXPECT_NEAR(-gained, system.energy_lost(),
                bound * turned_over + 0.02 * mu * turned_over * std::pow(system.links, -1.25));
  }
}

TEST_P(ChainOverEdgeBy, DoesNotStartIfFrictionIsTheStronger) {
  // c = 0 at mu = B/(A - B) = 1.
  const auto start = [](double mu) {
    return [mu] {
      const ChainOverEdge system{.links = 50, .friction = mu};
      (void)run(system, system.scene(), {.t_end = 0.1, .tolerance = tolerance, .stepper = GetParam()});
    };
  };
  for (const double mu : {1.02, 1.5, 3.0})
    EXPECT_THAT(start(mu),
                ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("FrictionLaw"), HasSubstr("would stick"))));
  EXPECT_NO_THROW(start(0.98)());
}

}  // namespace
}  // namespace dalembert::models::chain_over_edge_test
