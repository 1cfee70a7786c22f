#include "dalembert/core/scene/system.h"

#include "../equations.h"
#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/core/scene/scene.h>

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace dalembert::system_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// One element of every kind, added so that neither batches nor rows come in the order of adding.
class MixedScene : public testing::Test {
 protected:
  Scene<2> scene{"mixed"};
  Particle<2> a = scene.add_particle({.mass = 1.0}, "a");
  Particle<2> b = scene.add_particle({.mass = 2.0}, "b");
  Particle<2> c = scene.add_particle({.mass = 4.0}, "c");
  Constraint<1> skate = scene.add(
      nonholonomic(points(b), [](auto t, auto r, auto v) { return v.y() - (r.x() + sin(t)) * v.x(); }),
      "skate");
  Constraint<1> rod = scene.add(Distance{a, b, 1.5}, "rod");
  Constraint<2> pin = scene.add(Coincident{c, driven([](auto t) { return vec(sin(t), t * t); })}, "pin");
  Constraint<1> wire =
      scene.add(holonomic(points(a), [](auto t, auto r) { return r.y() - t * sin(r.x()); }), "wire");
  Constraint<1> bar = scene.add(Distance{b, c, 2.0}, "bar");

  MixedScene() {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    scene.add(Damper{a, c, 0.7});
    scene.add(Spring{b, c, 5.0, 0.3});
    scene.add(potential(points(a), [](auto t, auto r) { return t * r.x() * r.x() * r.y(); }));
  }

  State state{0.7, (Eigen::VectorXd(6) << 0.5, -0.2, 1.7, 0.9, -0.4, 1.3).finished(),
              (Eigen::VectorXd(6) << 0.4, 1.1, -0.6, 0.3, 0.8, -0.9).finished()};
  Eigen::VectorXd lambda = (Eigen::VectorXd(6) << 1.0, -2.0, 0.5, 3.0, -1.5, 0.7).finished();
};

TEST_F(MixedScene, DerivativesAreConsistent) { expect_consistent(scene.system(), state, lambda); }

TEST_F(MixedScene, HolonomicRowsComeFirst) {
  const auto system = scene.system();
  EXPECT_EQ(system.coordinates(), 6);
  EXPECT_EQ(system.holonomic_rows(), 5);
  EXPECT_EQ(system.rows(), 6);
  EXPECT_TRUE(system.rheonomic());
  const auto& constraints = system.layout()->constraints;
  EXPECT_EQ(constraints[static_cast<std::size_t>(skate.index)].first_row, 5);
  for (const auto& constraint : constraints) {
    for (int k = 0; k < constraint.rows; ++k) {
      const auto row = static_cast<std::size_t>(constraint.first_row + k);
      EXPECT_EQ(system.row_label(row), constraint.label());
    }
  }
}

TEST_F(MixedScene, EveryRowReadsTheCoordinatesOfItsOwnParticles) {
  const auto system = scene.system();
  const auto columns = [&](auto constraint) {
    const auto row = static_cast<std::size_t>(
        system.layout()->constraints[static_cast<std::size_t>(constraint.index)].first_row);
    std::vector<std::size_t> own;
    for (const std::size_t k : system.row(row)) own.push_back(system.w_columns()[k]);
    return own;
  };
  EXPECT_THAT(columns(skate), ElementsAre(2, 3));
  EXPECT_THAT(columns(rod), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(columns(pin), ElementsAre(4, 5));
  EXPECT_THAT(columns(wire), ElementsAre(0, 1));
  EXPECT_THAT(columns(bar), ElementsAre(2, 3, 4, 5));
}

TEST_F(MixedScene, ForcesOfConstraintAddUpToWTransposedTimesLambda) {
  const auto system = scene.system();
  auto e = system.evaluation();
  system.evaluate(state.instant(), e);
  std::vector<double> slots(system.layout()->slot_coordinate.size());
  system.constraint_forces(e.w, {lambda.data(), 6}, slots);
  Eigen::VectorXd Z = Eigen::VectorXd::Zero(6);
  for (std::size_t k = 0; k < slots.size(); ++k) Z[system.layout()->slot_coordinate[k]] += slots[k];
  const Eigen::VectorXd expected = by_rows(system, e.w).transpose() * lambda;
  // Six products and sums in another order.
  EXPECT_LE((Z - expected).lpNorm<Eigen::Infinity>(),
            6.0 * 2.3e-16 * expected.lpNorm<Eigen::Infinity>() * 6.0);
}

// (1 (0.4^2 + 1.1^2) + 2 (0.6^2 + 0.3^2) + 4 (0.8^2 + 0.9^2)) / 2
TEST_F(MixedScene, KineticEnergyIsHalfTheSumOfMassTimesSpeedSquared) {
  EXPECT_DOUBLE_EQ(scene.system().kinetic_energy(state.instant().v),
                   0.5 * (0.16 + 1.21 + 2.0 * (0.36 + 0.09) + 4.0 * (0.64 + 0.81)));
}

// Gravity 9.81 sum m y, spring 5 (|b - c| - 0.3)^2 / 2 with |b - c| = |(2.1, -0.4)|, t x^2 y.
TEST_F(MixedScene, PotentialEnergyIsThatOfGravitySpringAndPotential) {
  const double height = -0.2 + 2.0 * 0.9 + 4.0 * 1.3;
  const double stretch = std::hypot(2.1, 0.4) - 0.3;
  const double expected = 9.81 * height + 2.5 * stretch * stretch + 0.7 * 0.25 * -0.2;
  EXPECT_NEAR(scene.system().forces().energy(state.instant()), expected, 10.0 * 2.3e-16 * 100.0);
}

TEST_F(MixedScene, TwoSystemsOfOneSceneGiveTheSameBits) {
  const Values once = values(scene.system(), state);
  const Values again = values(scene.system(), state);
  EXPECT_EQ(once.F, again.F);
  EXPECT_EQ(once.g, again.g);
  EXPECT_EQ(once.psi, again.psi);
  EXPECT_EQ(once.W, again.W);
  EXPECT_EQ(once.gamma, again.gamma);
}

TEST_F(MixedScene, LessOfItInForceIsRowsOfZerosOverTheSameEquations) {
  const auto all = scene.system();
  const auto& its = all.layout()->constraints[static_cast<std::size_t>(rod.index)];
  const auto less = all.without(std::vector<std::size_t>{static_cast<std::size_t>(rod.index)});
  EXPECT_EQ(less.layout(), all.layout());
  EXPECT_EQ(less.w_columns().data(), all.w_columns().data());
  EXPECT_EQ(less.rows_in_force(), all.rows_in_force() - 1);
  auto e = all.evaluation(), e_less = e;
  all.evaluate(state.instant(), e);
  less.evaluate(state.instant(), e_less);
  for (std::size_t r = 0; r < all.rows(); ++r) {
    const bool out = r == its.own_rows().front();
    EXPECT_EQ(less.in_force(r), !out);
    EXPECT_EQ(e_less.psi[r], out ? 0.0 : e.psi[r]);
    for (const std::size_t k : all.row(r)) EXPECT_EQ(e_less.w[k], out ? 0.0 : e.w[k]);
  }
}

TEST_F(MixedScene, DescriptionCountsWhatThereIs) {
  EXPECT_THAT(scene.system().describe(),
              AllOf(HasSubstr("\"mixed\": 3 particles in 2 dimensions, 6 coordinates"),
                    HasSubstr("1 Coincident, 2 Distance, 1 Holonomic, 1 Nonholonomic"),
                    HasSubstr("5 holonomic and 1 nonholonomic equations, rheonomic"),
                    HasSubstr("1 of position, 0 of velocity"), HasSubstr("1 Damper, 1 Potential, 1 Spring"),
                    HasSubstr("index-2 equations: 23"), HasSubstr("planar"), Not(HasSubstr("damping block")),
                    Not(HasSubstr("mu:")), Not(HasSubstr("time derivatives"))));
}

// Rods between three atoms in a line are to first order redundant, and let it bend. But the longest is as
// long as the others together: the line is rigid, with 3 + 2 degrees of freedom. With a longest one between
// the ends of two others in its place nothing changes, and a fourth atom in line is held likewise.
TEST(System, DescriptionCountsALineOfAtomsAsRigid) {
  for (const int atoms : {3, 4}) {
    Scene<3> scene("line");
    std::vector<Particle<3>> p;
    for (int i = 0; i < atoms; ++i)
      p.push_back(scene.add_particle({.mass = 1.0 + i, .position = {0.6 * i, 0.8 * i, 1.0}}));
    for (int i = 0; i < atoms; ++i)
      for (int j = 0; j < i; ++j)
        scene.add(Distance{p[static_cast<std::size_t>(i)], p[static_cast<std::size_t>(j)], 1.0 * (i - j)});
    EXPECT_THAT(scene.describe(), AllOf(HasSubstr(" 5 of position"), HasSubstr("singular position")))
        << atoms;
  }
}

// A parallelogram in line can go on in two ways, and a bar more makes another one redundant: neither holds
// anything to second order.
TEST(System, DescriptionLeavesBranchesAndRedundantRowsFree) {
  for (const double angle : {0.0, 1.0}) {
    Scene<2> scene("parallelogram");
    const Vec<2> arm(std::cos(angle), std::sin(angle));
    const auto a = scene.add_particle({.mass = 1.0, .position = arm});
    const auto b = scene.add_particle({.mass = 1.0, .position = arm + Vec<2>::UnitX()});
    scene.add(Distance{Fixed<2>{}, a, 1.0});
    scene.add(Distance{Fixed<2>{Vec<2>::UnitX()}, b, 1.0});
    scene.add(Distance{a, b, 1.0});
    scene.add(Distance{Fixed<2>{}, a, 1.0});
    EXPECT_THAT(scene.describe(), Not(HasSubstr("singular position"))) << angle;
    EXPECT_THAT(scene.describe(), HasSubstr(angle == 0.0 ? " 2 of position" : " 1 of position"));
  }
}

TEST(System, DescriptionCountsNoFreedomOfWhatIsHeldTwice) {
  Scene<2> scene("held");
  const auto p = scene.add_particle({.mass = 1.0});
  for (const double angle : {0.0, 1.0, 2.0})
    scene.add(Distance{Fixed<2>{{std::cos(angle), std::sin(angle)}}, p, 1.0});
  EXPECT_THAT(scene.describe(), HasSubstr(" 0 of position"));
}

TEST(System, DescriptionSaysWhatAFreeParticleLeavesOut) {
  Scene<3> scene;
  scene.add_particle({.mass = 1.0});
  EXPECT_THAT(scene.system().describe(),
              AllOf(HasSubstr("1 particle in 3 dimensions"), HasSubstr("constraints: none"),
                    HasSubstr("forces: none"), HasSubstr("stiffness block"), HasSubstr("damping block"),
                    HasSubstr("mu:"), HasSubstr("there is no constraint"), Not(HasSubstr("planar")),
                    HasSubstr("index-2 equations: 6")));
}

TEST(System, DescriptionAtAStateOfAFreeParticleCountsAllItsFreedom) {
  Scene<3> scene;
  scene.add_particle({.mass = 1.0});
  EXPECT_THAT(scene.describe(),
              HasSubstr("0 of 0 constraint equations independent, 3 degrees of freedom of velocity"));
}

TEST(System, DescriptionSaysThatNothingDependsOnTime) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{Fixed<2>{}, bob, 1.0});
  EXPECT_THAT(scene.system().describe(), AllOf(HasSubstr("scleronomic"), HasSubstr("time derivatives")));
}

TEST(System, ABadNumberOrAnExceptionNamesTheConstraintAndTheTime) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(holonomic(points(a), [](auto r) { return r.x() - 1.0; }), "good");
  scene.add(holonomic(points(a), [](auto r) { return log(r.y() - 1.0); }), "bad");
  const State s{0.25, Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d::Zero()};
  EXPECT_THAT([&] { (void)values(scene.system(), s); },
              ThrowsMessage<EquationFault>(AllOf(HasSubstr("Holonomic \"bad\""),
                                                 HasSubstr("not a finite number"), HasSubstr("t = 0.25"))));
}

TEST(System, DescriptionCountsRotors) {
  Scene<2> scene;
  const auto a = scene.add_rotor({.inertia = 1.0});
  const auto b = scene.add_rotor({.inertia = 2.0});
  scene.add(holonomic(points(a, b), [](auto x, auto y) { return x[0] - y[0]; }));
  EXPECT_THAT(scene.describe(), HasSubstr("0 particles and 2 rotors in 2 dimensions"));
}

// Eight equations for two coordinates: no count of freedom is below 0, and the rank is what counts.
TEST(System, DescriptionOfTooManyEquationsHasNoNegativeFreedom) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  for (int i = 0; i < 8; ++i) scene.add(Distance{Fixed<2>{}, p, 1.0});
  const std::string text = scene.describe();
  EXPECT_THAT(scene.system().describe(), HasSubstr("undetermined (6 equations more than coordinates)"));
  EXPECT_THAT(text, Not(HasSubstr("undetermined")));  // the rank tells
  EXPECT_THAT(text, HasSubstr("1 of 8 constraint equations independent, 1 degrees of freedom"));
  EXPECT_EQ(text.find(": -"), std::string::npos);
}

// A parallelogram whose coupler is said to stay level, too: by count it has no freedom, by rank one.
TEST(System, DescriptionAtAStateDoesNotContradictItself) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  const auto b = scene.add_particle({.mass = 1.0, .position = {1.0, 1.0}});
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, a, 1.0});
  scene.add(Distance{Fixed<2>{{1.0, 0.0}}, b, 1.0});
  scene.add(Distance{a, b, 1.0});
  scene.add(holonomic(points(a, b), [](auto x, auto y) { return y.y() - x.y(); }));
  EXPECT_THAT(scene.system().describe(), HasSubstr("0 of position, 0 of velocity"));
  EXPECT_THAT(scene.describe(),
              AllOf(HasSubstr("3 of 4 constraint equations independent, 1 degrees of freedom"),
                    Not(HasSubstr("0 of position"))));
}

}  // namespace
}  // namespace dalembert::system_test
