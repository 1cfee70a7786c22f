#include <dalembert/dalembert.h>
#include <dalembert/solvers/contact/complementarity.h>
#include <dalembert/tests/both_steppers.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace dalembert {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81, tolerance = 1e-10;
/// As in the tests of events.
constexpr double met = 100.0 * tolerance;

TEST(Complementarity, IsSolvedForRandomPositiveSemidefiniteMatrices) {
  // What a solution is needs no other solver. Ranks below the size, and rows repeated, make ties.
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + trial % 12, rank = 1 + trial % n;
    Eigen::MatrixXd A(n, rank);
    for (double& x : A.reshaped()) x = normal(generator);
    if (n > 2) A.row(n - 1) = A.row(0);
    const Eigen::MatrixXd M = A * A.transpose();
    Eigen::VectorXd x(rank);
    for (double& y : x) y = normal(generator);
    const Eigen::VectorXd q = A * x;  // feasible: w = A (A^T z + x), and 0 is a minimum of |A^T z + x|
    const auto z = complementary_solution(M, q);
    ASSERT_TRUE(z) << trial;
    const Eigen::VectorXd w = M * *z + q;
    const double round_off = 1e-11 * (1.0 + q.cwiseAbs().maxCoeff() + (M * *z).cwiseAbs().maxCoeff());
    EXPECT_GE(z->minCoeff(), 0.0) << trial;
    EXPECT_GE(w.minCoeff(), -round_off) << trial;
    EXPECT_LE(std::abs(w.dot(*z)), round_off * (1.0 + z->sum())) << trial;
  }
}

TEST(Complementarity, WithoutSolutionSaysSo) {
  EXPECT_FALSE(complementary_solution(Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Constant(1, -1.0)));
  Eigen::MatrixXd M(2, 2);
  M << 1.0, -1.0, -1.0, 1.0;
  EXPECT_FALSE(complementary_solution(M, Eigen::Vector2d(-1.0, -1.0)));
  EXPECT_TRUE(complementary_solution(M, Eigen::Vector2d(-1.0, 1.0)));
}

class Contacts : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] static Options options(double t_end) {
    return {.t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = GetParam()};
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, Contacts, both_steppers, stepper_name);

TEST_P(Contacts, OpenWhereTheirForceVanishes) {
  // A particle slides off a sphere of radius 1 from the angle 0.1 off its top, at rest: it leaves at cos
  // theta = (2/3) cos 0.1, see the tests of events for the time, and flies on along a parabola.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto particle = scene.add_particle({.mass = 1.0, .position = {std::sin(0.1), std::cos(0.1)}});
  const auto sphere = scene.add(unilateral(OnSurface{particle, Sphere<2>{.radius = 1.0}}));
  const auto run = simulate(scene, options(1.2));
  ASSERT_EQ(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].what, Happened::opened);
  const double c = 2.0 / 3.0 * std::cos(0.1), s = std::sqrt(1.0 - c * c), left = 1.2 - run.events()[0].time;
  EXPECT_NEAR(run.event_sample(0).position(particle).y(), c, met);
  const double v = std::sqrt(g * c);
  EXPECT_NEAR(run.position(particle, 10).x(), s + v * c * left, met);
  EXPECT_NEAR(run.position(particle, 10).y(), c - v * s * left - g * left * left / 2.0, met);
  EXPECT_EQ(run.multiplier(sphere, 10), 0.0);
  EXPECT_TRUE(run.is_unique(sphere, 10));
}

TEST_P(Contacts, OfAStringOpenAndCatch) {
  // Sent off below at v0^2 = 4 g l a string is slack where sin a = 2/3 above the pivot, with v^2 = g l sin a.
  // The parabola from there osculates the circle and meets it again at the angle -3 a (the angles of the four
  // points in which a parabola with an upright axis meets it add up to 0).
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bob =
      scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}, .velocity = {std::sqrt(4.0 * g), 0.0}});
  const auto string =
      scene.add(unilateral(Distance{Fixed<2>{}, bob, 1.0}, {.allowed = Allowed::negative}), "string");
  const auto run = simulate(scene, options(2.0));
  ASSERT_GE(run.events().size(), 2U);
  const double a = std::asin(2.0 / 3.0), v = std::sqrt(g * std::sin(a));
  EXPECT_EQ(run.events()[0].what, Happened::opened);
  EXPECT_NEAR(run.event_sample(0).position(bob).y(), std::sin(a), met);
  EXPECT_EQ(run.events()[1].what, Happened::struck);
  const double flight = (std::cos(a) - std::cos(3.0 * a)) / (v * std::sin(a));
  EXPECT_NEAR(run.events()[1].time - run.events()[0].time, flight, met);
  const auto caught = run.event_sample(1), after = run.sample_after(1);
  EXPECT_NEAR(caught.position(bob).x(), std::cos(3.0 * a), met);
  EXPECT_NEAR(caught.position(bob).y(), -std::sin(3.0 * a), met);
  // The string takes the part of the velocity along it.
  const double along = caught.velocity(bob).dot(caught.position(bob));
  EXPECT_NEAR(after.energy(), caught.energy() - along * along / 2.0, met * g);
  EXPECT_NEAR(-run.impulse(string, 1), along, met * g);
  EXPECT_NEAR(after.velocity(bob).dot(after.position(bob)), 0.0, met);
}

TEST_P(Contacts, OfASlidingLadderLeaveTheWall) {
  // A thin rod of length 1 between wall and floor, from rest at the angle 0.3 from the wall: phi'' = (3/2) g
  // sin phi, phi'^2 = 3 g (cos 0.3 - cos phi); the wall's force vanishes at cos phi = (2/3) cos 0.3.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto ladder = add_thin_rod(
      scene, {.mass = 1.0, .start = {0.0, std::cos(0.3)}, .end = {std::sin(0.3), 0.0}}, "ladder");
  const auto wall =
      scene.add(unilateral(holonomic(points(ladder.start()), [](auto r) { return r.x(); })), "wall");
  const auto floor =
      scene.add(unilateral(holonomic(points(ladder.end()), [](auto r) { return r.y(); })), "floor");
  const auto run = simulate(scene, options(0.6));
  ASSERT_GE(run.events().size(), 1U);
  EXPECT_EQ(run.events()[0].what, Happened::opened);
  EXPECT_EQ(run.events()[0].event, static_cast<std::size_t>(wall.index));
  const double leaves = std::acos(2.0 / 3.0 * std::cos(0.3));
  boost::math::quadrature::tanh_sinh<double> integrator;
  const double time = integrator.integrate(
      [](double u) {  // phi = 0.3 + u^2, and cos 0.3 - cos phi = 2 sin(0.3 + u^2/2) sin(u^2/2)
        if (u < 1e-8) return 2.0 / std::sqrt(3.0 * g * std::sin(0.3));
        return 2.0 * u / std::sqrt(6.0 * g * std::sin(0.3 + u * u / 2.0) * std::sin(u * u / 2.0));
      },
      0.0, std::sqrt(leaves - 0.3));
  EXPECT_NEAR(run.events()[0].time, time, met);
  EXPECT_GT(run.multiplier(floor, 10), 0.0);
}

TEST_P(Contacts, OfAVibratingTableThrowItsLoadOff) {
  // y = A sin(w t): the load leaves where A w^2 sin(w t) = g, at A w cos(w t).
  constexpr double A = 0.1, w = 20.0;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto load = scene.add_particle({.mass = 1.0, .velocity = {0.0, A * w}});
  const auto table = scene.add(
      unilateral(holonomic(points(load), [](auto t, auto r) { return r.y() - A * sin(w * t); })), "table");
  const double leaves = std::asin(g / (A * w * w)) / w;
  const auto run = simulate(scene, options(leaves + 0.05));
  ASSERT_GE(run.events().size(), 1U);
  EXPECT_NEAR(run.events()[0].time, leaves, met);
  EXPECT_NEAR(run.multiplier(table, 0), g, met * g);
  EXPECT_NEAR(run.position(load, 10).y(),
              A * std::sin(w * leaves) + A * w * std::cos(w * leaves) * 0.05 - g * 0.05 * 0.05 / 2.0, met);
}

TEST_P(Contacts, ThatShareALoadInManyWaysPushAll) {
  // A table on four legs, the load over one of them: the least squares would pull at the leg across.
  Scene<3> scene("table");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const std::vector<Vec<3>> places{
      {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, {0.1, 0.1, 0.3}};
  std::vector<Particle<3>> parts;
  for (const Vec<3>& r : places) {
    parts.push_back(scene.add_particle({.mass = parts.size() < 4 ? 0.01 : 1.0, .position = r}));
    for (std::size_t k = 0; k + 1 < parts.size(); ++k)
      scene.add(Distance{parts[k], parts.back(), (places[k] - r).norm()});
  }
  std::vector<Constraint<1>> legs;
  for (std::size_t i = 0; i < 4; ++i)
    legs.push_back(scene.add(unilateral(holonomic(points(parts[i]), [](auto r) { return r.z(); }))));
  const auto run = simulate(scene, options(0.1));
  double sum = 0.0, about_x = 0.0, about_y = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double force = run.multiplier(legs[i], 10);
    EXPECT_GE(force, 0.0);
    sum += force;
    about_x += force * places[i].y();
    about_y += force * places[i].x();
  }
  EXPECT_NEAR(sum, 1.04 * g, met * g);
  EXPECT_NEAR(about_x, (0.1 + 0.02) * g, met * g);
  EXPECT_NEAR(about_y, (0.1 + 0.02) * g, met * g);
  EXPECT_FALSE(run.is_unique(legs[0], 10));
  EXPECT_TRUE(run.events().empty());
}

TEST_P(Contacts, OfAStackCarryWhatLiesOnThem) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto lower = scene.add_particle({.mass = 1.0}),
             upper = scene.add_particle({.mass = 2.0, .position = {0.0, 1.5}});
  const auto floor = scene.add(unilateral(holonomic(points(lower), [](auto r) { return r.y(); })));
  const auto between = scene.add(
      unilateral(holonomic(points(lower, upper), [](auto a, auto b) { return b.y() - a.y() - 1.0; })));
  const auto run = simulate(scene, options(1.0));
  ASSERT_EQ(run.events().size(), 2U);  // both struck, at once
  EXPECT_NEAR(run.events()[0].time, std::sqrt(1.0 / g), met);
  EXPECT_NEAR(run.impulse(floor, 0), 2.0 * std::sqrt(g), met * g);
  EXPECT_NEAR(run.impulse(between, 0), 2.0 * std::sqrt(g), met * g);
  EXPECT_NEAR(run.multiplier(floor, 10), 3.0 * g, met * g);
  EXPECT_NEAR(run.multiplier(between, 10), 2.0 * g, met * g);
}

TEST_P(Contacts, ThatAreGrazedChangeNothing) {
  // The top of a parabola touches a ceiling, y = 1/2.
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto ball = scene.add_particle({.mass = 1.0, .velocity = {0.3, 1.0}});
  scene.add(unilateral(holonomic(points(ball), [](auto r) { return 0.5 - r.y(); }), {.restitution = 1.0}));
  const auto run = simulate(scene, options(2.0));
  EXPECT_NEAR(run.position(ball, 10).y(), 0.0, 1e-4);  // of a height known to tolerance the speed is its root
  EXPECT_NEAR(run.energy(10), run.energy(0), met);
}

TEST_P(Contacts, ThatCannotBeObeyedAreErrorsByName) {
  const auto scene = [](double height) {
    Scene<2> s("press");
    const auto load = s.add_particle({.mass = 1.0, .position = {0.0, height}}, "load");
    s.add(unilateral(holonomic(points(load), [](auto r) { return r.y(); })), "floor");
    return std::pair(s, load);
  };
  EXPECT_THAT([&] { (void)simulate(scene(-0.5).first, options(1.0)); },
              ThrowsMessage<InconsistentStart>(AllOf(HasSubstr("\"floor\""), HasSubstr("0.5"))));
  auto press = scene(1.0);
  press.first.add(holonomic(points(press.second), [](auto t, auto r) { return r.y() - (1.0 - t * t); }),
                  "drive");
  EXPECT_THAT([&] { (void)simulate(press.first, options(2.0)); },
              ThrowsMessage<IntegrationFailure>(AllOf(HasSubstr("\"floor\""), HasSubstr("t = 1"))));
}

TEST(Unilateral, RefusesWhatItIsNotFor) {
  Scene<2> scene;
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  const auto height = [](auto r) { return r.y(); };
  EXPECT_THAT([&] { scene.add(unilateral(holonomic(points(ball), height), {.restitution = 1.5})); },
              ThrowsMessage<InvalidScene>(HasSubstr("restitution = 1.5")));
  const auto floor = scene.add(unilateral(holonomic(points(ball), height)), "floor");
  EXPECT_THAT([&] { (void)equilibrium(scene); }, ThrowsMessage<InvalidScene>(HasSubstr("\"floor\"")));
  EXPECT_THAT([&] { (void)floquet(scene, 1.0); }, ThrowsMessage<InvalidScene>(HasSubstr("\"floor\"")));
  scene.add(
      friction_law(floor, points(ball), [](auto lambda, auto, auto v) { return (-0.1 * lambda * v).eval(); }),
      "rough");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InvalidScene>(AllOf(HasSubstr("\"rough\""), HasSubstr("\"floor\""))));
}

}  // namespace
}  // namespace dalembert
