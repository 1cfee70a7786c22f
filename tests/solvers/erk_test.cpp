#include "dalembert/solvers/erk/erk.h"

#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/erk/verner.h>
#include <dalembert/solvers/simulation.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

namespace dalembert::erk_test {
namespace {

constexpr double g = 9.81;

/// A rooted tree as its children; trees of each order are built from smaller ones. They index the
/// order conditions of a Runge-Kutta method (Butcher; Hairer, Norsett, Wanner, Solving ODEs I, II.2).
struct Tree {
  std::vector<Tree> children;
  int order = 1;
};

/// All multisets of trees, in non-increasing position in `pool`, with orders adding up to `order`.
void forests(const std::vector<Tree>& pool, std::size_t first, int order, std::vector<Tree>& chosen,
             const std::function<void(const std::vector<Tree>&)>& visit) {
  if (order == 0) return visit(chosen);
  for (std::size_t i = first; i < pool.size(); ++i) {
    if (pool[i].order > order) continue;
    chosen.push_back(pool[i]);
    forests(pool, i, order - pool[i].order, chosen, visit);
    chosen.pop_back();
  }
}

std::vector<Tree> trees_up_to(int order) {
  std::vector<Tree> all{Tree{}};
  for (int k = 2; k <= order; ++k) {
    const std::vector<Tree> smaller = all;
    std::vector<Tree> chosen;
    forests(smaller, 0, k - 1, chosen, [&](const std::vector<Tree>& children) {
      all.push_back({children, k});
    });
  }
  return all;
}

double density(const Tree& tree) {
  double product = tree.order;
  for (const Tree& child : tree.children) product *= density(child);
  return product;
}

/// The elementary weight's stage vector: product over children of A times theirs.
std::array<double, 13> stage_weights(const Tree& tree) {
  std::array<double, 13> phi;
  phi.fill(1.0);
  for (const Tree& child : tree.children) {
    const auto below = stage_weights(child);
    for (std::size_t i = 0; i < 13; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < 13; ++j) sum += verner87.a[i][j] * below[j];
      phi[i] *= sum;
    }
  }
  return phi;
}

double defect(const std::array<double, 13>& weights, const Tree& tree) {
  const auto phi = stage_weights(tree);
  double sum = 0.0;
  for (std::size_t i = 0; i < 13; ++i) sum += weights[i] * phi[i];
  return std::abs(sum - 1.0 / density(tree));
}

/// Entries of the table reach 124 and weights 32; a sum of products keeps 16 digits of those.
constexpr double table_round_off = 1e-12;

TEST(Verner87, StepSatisfiesAll200OrderConditionsOfOrder8) {
  const auto trees = trees_up_to(8);
  ASSERT_EQ(trees.size(), 200U);
  for (const Tree& tree : trees) EXPECT_LT(defect(verner87.b, tree), table_round_off);
}

TEST(Verner87, EstimateComesFromASolutionOfOrder7AndNotOfOrder8) {
  std::array<double, 13> lower{};
  for (std::size_t i = 0; i < 13; ++i) lower[i] = verner87.b[i] - verner87.d[i];
  double eighth = 0.0;
  for (const Tree& tree : trees_up_to(8)) {
    if (tree.order <= 7) {
      EXPECT_LT(defect(lower, tree), table_round_off);
    } else {
      eighth = std::max(eighth, defect(lower, tree));
    }
  }
  EXPECT_GT(eighth, 1e-6);
}

/// What a sum of stages keeps of a tree.
double kept(const std::array<double, 13>& weights, const Tree& tree) {
  const auto phi = stage_weights(tree);
  return std::abs(std::inner_product(weights.begin(), weights.end(), phi.begin(), 0.0));
}

TEST(Verner87, NullRulesKeepNothingUpToTheirOrder) {
  const std::vector<std::pair<std::array<double, 13>, int>> rules{
      {null_rules.third, 3}, {null_rules.fourth, 4}, {null_rules.sixth, 6}};
  for (const auto& [rule, order] : rules) {
    double next = 0.0;
    for (const Tree& tree : trees_up_to(order + 1)) {
      if (tree.order <= order)
        EXPECT_LT(kept(rule, tree), table_round_off) << order;
      else
        next = std::max(next, kept(rule, tree));
    }
    EXPECT_GT(next, 1e-6) << order;
    EXPECT_NEAR(std::inner_product(rule.begin(), rule.end(), rule.begin(), 0.0), 1.0, 1e-15) << order;
  }
}

/// A step of length h from 1 of the motion x = (1 - t)^p, x'' = p (p - 1) x^(1 - 2/p): positions and
/// velocities of its stages.
using Stages = std::array<std::array<long double, 2>, 13>;
Stages stages_towards_singularity(long double p, long double h) {
  Stages k{};
  for (std::size_t i = 0; i < 13; ++i) {
    long double x = 1.0L, v = -p;
    for (std::size_t j = 0; j < i; ++j) {
      x += h * verner87.a[i][j] * k[j][0];
      v += h * verner87.a[i][j] * k[j][1];
    }
    k[i] = {v, p * (p - 1.0L) * std::pow(x, 1.0L - 2.0L / p)};
  }
  return k;
}

/// The constant of the estimate near a singularity is the least that bounds the error of every such step.
/// Their distance from the singularity is 1, and so are units of length and time. Below h = 0.15 the estimate
/// of order 7 is the larger one.
TEST(Verner87, NullRulesTellTheErrorNearASingularity) {
  const auto sum = [](const std::array<double, 13>& weights, const Stages& k, std::size_t part) {
    long double total = 0.0L;
    for (std::size_t i = 0; i < 13; ++i) total += weights[i] * k[i][part];
    return total;
  };
  long double most = 0.0L, least = 1e3L;
  for (long double p = 0.2L; p < 0.91L; p += 0.05L)
    for (long double h = 0.15L; h < 0.705L; h += 0.01L) {
      const Stages k = stages_towards_singularity(p, h);
      const auto size = [&](const std::array<double, 13>& weights) {
        return h * std::hypot(sum(weights, k, 0), sum(weights, k, 1));
      };
      const long double error = std::hypot(1.0L + h * sum(verner87.b, k, 0) - std::pow(1.0L - h, p),
                                           -p + h * sum(verner87.b, k, 1) + p * std::pow(1.0L - h, p - 1.0L));
      const long double of_estimate =
          std::sqrt(std::inner_product(verner87.d.begin(), verner87.d.end(), verner87.d.begin(), 0.0L));
      const long double told = std::hypot(size(null_rules.sixth), size(verner87.d) / of_estimate) *
                               std::pow(size(null_rules.fourth) / size(null_rules.third), 3);
      most = std::max(most, error / told);
      least = std::min(least, error / told);
    }
  EXPECT_NEAR(static_cast<double>(most), 58.0, 0.5);
  EXPECT_NEAR(static_cast<double>(least), 20.0, 0.5);
  EXPECT_LT(most, constants.quickening);
}

TEST(Verner87, TimesOfStagesAreRowSums) {
  for (std::size_t i = 0; i < 13; ++i) {
    double sum = 0.0;
    for (const double a : verner87.a[i]) sum += a;
    EXPECT_NEAR(sum, verner87.c[i], 1e-13);  // entries up to 124
  }
}

Options explicit_run(double t_end, double tolerance, int samples = 11) {
  Options o;
  o.t_end = t_end;
  o.tolerance = tolerance;
  o.samples = samples;
  o.stepper = Stepper::erk;
  return o;
}

struct Pendulum {
  Scene<2> scene;
  Particle<2> bob;
  Constraint<1> rod;
};

Pendulum pendulum() {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}});
  const auto rod = scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0});
  return {std::move(scene), bob, rod};
}

/// phi'' = -g sin phi from the horizontal, by the classical Runge-Kutta method in steps so short that
/// its error, (t_end h^4) times derivatives of order 100, is below 1e-10.
Vec<2> pendulum_by_hand(double t_end) {
  const int steps = static_cast<int>(std::ceil(t_end * 5000.0));
  const double h = t_end / steps;
  double phi = 0.5 * std::numbers::pi;
  double omega = 0.0;
  const auto f = [](double p) { return -g * std::sin(p); };
  for (int i = 0; i < steps; ++i) {
    const double k1 = omega, l1 = f(phi);
    const double k2 = omega + 0.5 * h * l1, l2 = f(phi + 0.5 * h * k1);
    const double k3 = omega + 0.5 * h * l2, l3 = f(phi + 0.5 * h * k2);
    const double k4 = omega + h * l3, l4 = f(phi + h * k3);
    phi += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    omega += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
  }
  return {std::sin(phi), -std::cos(phi)};
}

TEST(Erk, FollowsAPendulumAndItsTension) {
  const Pendulum p = pendulum();
  const auto run = simulate(p.scene, explicit_run(10.0, 1e-10, 101));
  // 10 s are 4 periods; an error of one step grows like the number of steps, 200, times a few.
  EXPECT_LT((run.position(p.bob, 100) - pendulum_by_hand(10.0)).norm(), 1e-10 * 200 * 10);
  for (std::size_t i = 0; i < run.size(); ++i) {
    // Energy gives v^2 = -2 g y, so the tension is m (v^2 - g y) = -3 m g y.
    const double tension = -3.0 * 2.0 * g * run.position(p.bob, i).y();
    EXPECT_NEAR(-run.multiplier(p.rod, i), tension, 3.0 * 2.0 * g * 1e-10 * 200 * 10);
  }
}

/// Errors at samples inside steps are no larger than at the ends of steps: with 1,000 samples some 15
/// fall into each step, and are compared with a run at a far tighter tolerance.
TEST(Erk, SamplesInsideStepsAreAsAccurateAsSteps) {
  const Pendulum p = pendulum();
  for (const double tolerance : {1e-5, 1e-8, 1e-11}) {
    const auto run = simulate(p.scene, explicit_run(5.0, tolerance, 1001));
    const auto best = simulate(p.scene, explicit_run(5.0, 1e-13, 1001));
    ASSERT_LT(run.statistics().steps, 200);
    double before = 0.0;
    for (std::size_t i = 1; i < run.size(); ++i) {
      const double error = (run.position(p.bob, i) - best.position(p.bob, i)).norm();
      // Errors grow smoothly along a run: between two samples by at most the tolerance of a step.
      EXPECT_LT(error, before + 10.0 * tolerance) << "sample " << i << ", tolerance " << tolerance;
      before = std::max(before, error);
      EXPECT_LT((run.velocity(p.bob, i) - best.velocity(p.bob, i)).norm(),
                10.0 * (before + 10.0 * tolerance));
    }
  }
}

TEST(Erk, ErrorFollowsTheTolerance) {
  const Pendulum p = pendulum();
  const Vec<2> end = pendulum_by_hand(5.0);
  const auto error = [&](double tolerance) {
    return (simulate(p.scene, explicit_run(5.0, tolerance, 2)).position(p.bob, 1) - end).norm();
  };
  // Local errors of order 8 give global errors proportional to the tolerance, to its power 7/8.
  const double ratio = error(1e-5) / error(1e-9);
  EXPECT_GT(ratio, 1e2);
  EXPECT_LT(ratio, 1e6);
}

/// A bead on a wheel that turns uniformly about the vertical axis of a plane: r(t) = cosh(w t) along
/// the turning line, from r = 1 at rest; the line's force on it is 2 m w r'.
TEST(Erk, HandlesRheonomicConstraints) {
  const double w = 1.3;
  Scene<2> scene;
  const auto bead = scene.add_particle({.mass = 0.7, .position = {1.0, 0.0}, .velocity = {0.0, w}});
  const auto line = scene.add(
      holonomic(points(bead), [w](auto t, auto r) { return r.y() * cos(w * t) - r.x() * sin(w * t); }));
  const double t = 2.0;
  const auto run = simulate(scene, explicit_run(t, 1e-10, 2));
  const double r = std::cosh(w * t);
  // The motion is unstable: errors of steps grow by cosh(w t) = 6.8 on the way.
  EXPECT_LT((run.position(bead, 1) - r * Vec<2>(std::cos(w * t), std::sin(w * t))).norm(), 1e-10 * 100 * r);
  EXPECT_NEAR(run.multiplier(line, 1), 2.0 * 0.7 * w * w * std::sinh(w * t), 1e-10 * 1000 * r);
}

/// y' = x x' integrates to y = x^2/2, but is stated as a constraint on velocities only.
TEST(Erk, HandlesNonholonomicConstraints) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto p = scene.add_particle({.mass = 1.0, .position = {1.0, 0.5}});
  scene.add(nonholonomic(points(p), [](auto r, auto v) { return v.y() - r.x() * v.x(); }));
  const auto run = simulate(scene, explicit_run(3.0, 1e-10, 31));
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<2> r = run.position(p, i);
    const Vec<2> v = run.velocity(p, i);
    // The integral of the constraint is not imposed, so it drifts with the error of the steps.
    EXPECT_NEAR(r.y(), 0.5 * r.x() * r.x(), 1e-10 * 100);
    EXPECT_NEAR(0.5 * v.squaredNorm() + g * r.y(), g * 0.5, 1e-10 * 100 * 10 * g);
  }
}

TEST(Erk, SaysThatAStiffSceneIsStiff) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto p = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, p, 1.0});
  scene.add(Damper{Fixed<2>{{0.0, 3.0}}, p, 1e4});  // rate 1e4 / s
  const auto run = simulate(scene, explicit_run(1.0, 1e-4));
  EXPECT_GT(2 * run.statistics().stability_limited, run.statistics().steps);
  EXPECT_NE(run.statistics().report().find("Stepper::ida has no such limit"), std::string::npos);
  const Pendulum soft = pendulum();
  const auto easy = simulate(soft.scene, explicit_run(10.0, 1e-6)).statistics();
  EXPECT_LT(2 * easy.stability_limited, easy.steps);
  EXPECT_EQ(easy.report().find("stiff"), std::string::npos);
}

TEST(Erk, StopsWhereAnEquationFailsAndNamesIt) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}, .velocity = {1.0, 0.0}});
  scene.add(force_law(points(p), [](auto r, auto /*v*/) { return (0.0 * sqrt(0.5 - r.x()) * r).eval(); }),
            "wall");
  try {
    (void)simulate(scene, explicit_run(1.0, 1e-8, 101));
    FAIL() << "passed the wall";
  } catch (const IntegrationFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("\"wall\""), std::string::npos) << failure.what();
    EXPECT_NEAR(failure.time(), 0.5, 1e-9);
    EXPECT_GE(failure.trajectory<2>().size(), 50U);
  }
}

TEST(Erk, SameSceneInNanometresAndGigametresTakesTheSameSteps) {
  const auto steps = [](double unit) {
    Scene<2> scene;
    scene.add(UniformGravity<2>{{0.0, -g * unit}});
    const auto bob = scene.add_particle({.mass = 1.0, .position = {unit, 0.0}});
    scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, unit});
    return simulate(scene, explicit_run(5.0, 1e-8)).statistics().steps;
  };
  // Powers of two scale without rounding, so the steps are the same to the bit.
  EXPECT_EQ(steps(1.0), steps(std::ldexp(1.0, -30)));
  EXPECT_EQ(steps(1.0), steps(std::ldexp(1.0, 30)));
}

TEST(Erk, FirstFewStepsEndWhereTheyAreAskedTo) {
  const Pendulum p = pendulum();
  Options o = explicit_run(1.0, 1e-8);
  Simulation<2> simulation(p.scene, o);
  simulation.advance_to(0.3);
  EXPECT_EQ(simulation.time(), 0.3);
  EXPECT_LT((simulation.position(p.bob) - pendulum_by_hand(0.3)).norm(), 1e-7);
  simulation.advance_to(1.0);
  EXPECT_EQ(simulation.time(), 1.0);
  EXPECT_LT((simulation.position(p.bob) - pendulum_by_hand(1.0)).norm(), 1e-7);
}

}  // namespace
}  // namespace dalembert::erk_test
