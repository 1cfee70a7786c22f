#include "dalembert/constraints/disk_on_plane.h"

#include <dalembert/constraints/bodies/lamina.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/simulation.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace dalembert::disk_on_plane_test {
namespace {

constexpr double g = 9.81, mass = 2.0, radius = 0.5;

/// A thin uniform disk, its axis along y, on the plane z = 0 tilted by gravity.
struct UprightOnAPlane {
  Scene<3> scene;
  Lamina disk;
  Constraint<1> contact;
  Constraint<2> rolling;

  explicit UprightOnAPlane(double slope) {
    scene.add(UniformGravity<3>{g * Vec<3>(std::sin(slope), 0.0, -std::cos(slope))});
    Eigen::Matrix3d axes;
    axes << Vec<3>::UnitZ(), Vec<3>::UnitX(), Vec<3>::UnitY();
    const double across = mass * radius * radius / 4.0;
    disk = add_lamina(scene,
                      {.mass = mass, .inertia = {across, across}, .centre = {0.0, 0.0, radius}, .axes = axes},
                      "disk");
    const auto a = disk.point({radius, 0.0}), b = disk.point({0.0, radius});
    contact = scene.add(DiskContact{disk.centre(), a, b, radius});
    rolling = scene.add(DiskRolling{disk.centre(), a, b, radius});
  }
};

// m g cos(slope) from the plane; down the slope m x'' = m g sin(slope) - f with f r = (m r^2/2) x''/r:
// x'' = 2/3 g sin(slope), f = m g sin(slope)/3 up the slope. With the normal z and the axis y the heading
// z x y is -x, up the slope.
TEST(DiskOnPlane, RollsDownASlopeWithTwoThirdsOfTheAcceleration) {
  const double slope = 0.4, t = 0.8;
  const UprightOnAPlane built(slope);
  const auto run = simulate(built.scene, {.t_end = t, .samples = 2, .tolerance = 1e-8});
  const double bound = 1e-5 * mass * g;  // far above what the tolerance leaves after a fraction of a turn
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_NEAR(run.multiplier(built.contact, i), mass * g * std::cos(slope), bound);
    EXPECT_NEAR(run.multiplier(built.rolling, i)[0], mass * g * std::sin(slope) / 3.0, bound);
    EXPECT_NEAR(run.multiplier(built.rolling, i)[1], 0.0, bound);
  }
  EXPECT_NEAR(run.position(built.disk.centre(), 1).x(), g * std::sin(slope) * t * t / 3.0, 1e-6);
}

TEST(DiskOnPlane, SaysWhatIsWrong) {
  Scene<3> scene;
  const auto a = scene.add_particle({.mass = 1.0}), b = scene.add_particle({.mass = 1.0}),
             c = scene.add_particle({.mass = 1.0});
  EXPECT_NE((DiskContact{a, b, c, 0.0}).fault().find("radius"), std::string::npos);
  EXPECT_NE((DiskRolling{a, b, c, NAN}).fault().find("radius"), std::string::npos);
  const Plane<3> no_normal{.normal = Vec<3>::Zero()};
  EXPECT_NE((DiskContact{a, b, c, 1.0, no_normal}).fault().find("normal"), std::string::npos);
}

}  // namespace
}  // namespace dalembert::disk_on_plane_test
