#include "dalembert/constraints/on_surface.h"

#include "../equations.h"
#include <dalembert/constraints/geometry/moving.h>
#include <dalembert/solvers/simulation.h>

#include <gmock/gmock.h>

namespace dalembert::on_surface_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double round_off = 32.0 * std::numeric_limits<double>::epsilon();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// n = (1, 2, 2)/3; (4, 5, 6) - (1, 1, 1) = (3, 4, 5): g = (3 + 8 + 10)/3.
TEST(Plane, IsTheSignedDistanceAlongItsNormal) {
  const Plane<3> plane{{1.0, 1.0, 1.0}, {10.0, 20.0, 20.0}};
  EXPECT_NEAR(plane(Vec<3>(4.0, 5.0, 6.0)), 7.0, 7.0 * round_off);
  EXPECT_NEAR(plane(Vec<3>(-2.0, -3.0, -4.0)), -7.0, 7.0 * round_off);
}

TEST(Sphere, IsTheDistanceFromItsSurfacePositiveOutside) {
  const Sphere<3> sphere{{1.0, 1.0, 1.0}, 5.0};
  EXPECT_DOUBLE_EQ(sphere(Vec<3>(3.0, 4.0, 7.0)), 2.0);
  EXPECT_DOUBLE_EQ(sphere(Vec<3>(2.0, 1.0, 1.0)), -4.0);
}

// About the z axis through (1, 1): (4, 5) is 5 away, whatever its height.
TEST(Cylinder, IsTheDistanceFromItsWallPositiveOutside) {
  const Cylinder cylinder{{1.0, 1.0, 9.0}, {0.0, 0.0, 3.0}, 2.0};
  EXPECT_DOUBLE_EQ(cylinder(Vec<3>(4.0, 5.0, -7.0)), 3.0);
  EXPECT_DOUBLE_EQ(cylinder(Vec<3>(1.0, 2.0, 0.0)), -1.0);
}

// Half angle with sin = 3/5: at height 4 the wall is 3 from the axis; on the axis the wall is
// 4 sin = 2.4 away.
TEST(Cone, IsTheDistanceFromItsWallPositiveInside) {
  const Cone cone{{1.0, 1.0, 1.0}, {0.0, 0.0, 2.0}, std::asin(0.6)};
  EXPECT_NEAR(cone(Vec<3>(4.0, 1.0, 5.0)), 0.0, 4.0 * round_off);
  EXPECT_NEAR(cone(Vec<3>(1.0, 1.0, 5.0)), 2.4, 4.0 * round_off);
  EXPECT_LT(cone(Vec<3>(6.0, 1.0, 5.0)), 0.0);
}

TEST(OnSurface, AFloorCarriesTheWeight) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
  const auto block = scene.add_particle({.mass = 2.0, .position = {1.0, 2.0, 0.0}});
  const auto floor = scene.add(OnSurface{block, Plane<3>{}});
  const Simulation<3> simulation(scene, {.t_end = 1.0});
  EXPECT_NEAR(simulation.multiplier(floor), 20.0, 20.0 * round_off);
  EXPECT_LE((simulation.constraint_force(floor, block) - Vec<3>(0.0, 0.0, 20.0)).norm(), 20.0 * round_off);
}

// Inside a sphere of radius 2 at its lowest point with speed 3: N = m (g + v^2/R) towards the
// centre, that is towards g < 0: lambda = -2 (10 + 4.5).
TEST(OnSurface, ABowlPushesInwards) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
  const auto ball =
      scene.add_particle({.mass = 2.0, .position = {0.0, 0.0, -2.0}, .velocity = {3.0, 0.0, 0.0}});
  const auto bowl = scene.add(OnSurface{ball, Sphere<3>{{0.0, 0.0, 0.0}, 2.0}});
  EXPECT_NEAR(Simulation<3>(scene, {.t_end = 1.0}).multiplier(bowl), -29.0, 29.0 * round_off);
}

// Round a cylinder of radius 2 at speed 4 while climbing at 3: m v^2/R = 8 inwards; climbing costs nothing.
TEST(OnSurface, AHelixNeedsOnlyItsCentripetalForce) {
  Scene<3> scene;
  const auto bead =
      scene.add_particle({.mass = 1.0, .position = {2.0, 0.0, 0.0}, .velocity = {0.0, 4.0, 3.0}});
  const auto tube = scene.add(OnSurface{bead, Cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 2.0}});
  EXPECT_NEAR(Simulation<3>(scene, {.t_end = 1.0}).multiplier(tube), -8.0, 8.0 * round_off);
}

// A horizontal circle in a cone of half angle with sin = 3/5, at height 4, radius 3. The wall pushes
// along its normal (-cos, 0, sin) = (-4, 0, 3)/5: N 3/5 = m g and N 4/5 = m v^2/3, so
// v^2 = 3 g 4/3 = 40 and N = 2 * 10 * 5/3.
TEST(OnSurface, AConeCarriesAHorizontalCircle) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -10.0}});
  const auto ball =
      scene.add_particle({.mass = 2.0, .position = {3.0, 0.0, 4.0}, .velocity = {0.0, std::sqrt(40.0), 0.0}});
  const auto cone = scene.add(OnSurface{ball, Cone{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, std::asin(0.6)}});
  const Simulation<3> simulation(scene, {.t_end = 1.0});
  EXPECT_NEAR(simulation.multiplier(cone), 100.0 / 3.0, 40.0 * round_off);
  EXPECT_LE((simulation.constraint_force(cone, ball) - 100.0 / 3.0 * Vec<3>(-0.8, 0.0, 0.6)).norm(),
            40.0 * round_off);
}

/// That a surface is refused, with its constraint's name and this text.
template <class Surface>
void expect_refused(const Surface& surface, const std::string& text) {
  Scene<3> scene;
  const auto ball = scene.add_particle({.mass = 1.0});
  EXPECT_THAT(
      [&] {
        scene.add(OnSurface{ball, surface}, "wall");
      },
      ThrowsMessage<InvalidScene>(AllOf(HasSubstr("OnSurface \"wall\""), HasSubstr(text))));
}

TEST(OnSurface, RefusesASurfaceThatMakesNoSense) {
  const Vec<3> zero = Vec<3>::Zero();
  const Vec<3> up = Vec<3>::UnitZ();
  const Vec<3> bad(nan, 0.0, 0.0);
  expect_refused(Plane<3>{zero, zero}, "normal must be finite and not zero");
  expect_refused(Plane<3>{zero, bad}, "normal must be finite and not zero");
  for (const double radius : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    expect_refused(Sphere<3>{zero, radius}, "must be finite and > 0");
    expect_refused(Cylinder{zero, up, radius}, "must be finite and > 0");
  }
  expect_refused(Cylinder{zero, zero, 1.0}, "axis must be finite and not zero");
  expect_refused(Cone{zero, zero, 0.5}, "axis must be finite and not zero");
  const auto turning = [](auto t) { return t; };
  expect_refused(RotatingAbout{Sphere<3>{zero, 1.0}, Axis{.direction = zero}, turning},
                 "axis must be finite and not zero");
  expect_refused(RotatingAbout{Sphere<3>{zero, 1.0}, Axis{.point = bad}, turning}, "point must be finite");
  for (const double angle : {0.0, -0.1, 1.6, nan}) {
    expect_refused(Cone{zero, up, angle}, "must lie between 0 and pi/2");
  }
}

TEST(OnSurface, RefusesASurfaceThatLiesNowhere) {
  const Vec<3> bad(nan, 0.0, 0.0);
  expect_refused(Plane<3>{bad, Vec<3>::UnitZ()}, "point must be finite");
  expect_refused(Sphere<3>{bad, 1.0}, "centre must be finite");
  expect_refused(Cylinder{bad, Vec<3>::UnitZ(), 1.0}, "point must be finite");
  expect_refused(Cone{bad, Vec<3>::UnitZ(), 0.5}, "apex must be finite");
}

TEST(OnSurface, APointWithoutNormalIsNamed) {
  Scene<3> scene;
  const auto ball = scene.add_particle({.mass = 1.0});
  scene.add(OnSurface{ball, Cone{}}, "funnel");
  EXPECT_THAT([&] { (void)simulate(scene, {.t_end = 1.0}); },
              ThrowsMessage<InconsistentStart>(
                  AllOf(HasSubstr("OnSurface \"funnel\""), HasSubstr("no gradient"), HasSubstr("an apex"))));
}

}  // namespace
}  // namespace dalembert::on_surface_test
