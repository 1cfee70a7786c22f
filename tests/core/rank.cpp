#include "dalembert/core/analysis/rank.h"

#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/core/scene/scene.h>

#include <gtest/gtest.h>

#include <array>

namespace dalembert::rank_test {
namespace {

/// Two rods hold p, and so what is asked of its velocity is one too many; q is held in one direction.
class RodsAndVelocities : public testing::Test {
 protected:
  RodsAndVelocities() {
    const auto p = scene.add_particle({.mass = 1.0}), q = scene.add_particle({.mass = 1.0});
    scene.add(Distance{Fixed<2>{{0.0, 0.0}}, p, 1.0});
    scene.add(Distance{Fixed<2>{{2.0, 0.0}}, p, 1.0});
    scene.add(nonholonomic(points(p), [](auto, auto v) { return v.x() + 2.0 * v.y(); }));
    scene.add(nonholonomic(points(q), [](auto, auto v) { return v.x() - v.y(); }));
  }
  /// With p at x, y.
  [[nodiscard]] static std::vector<double> gradients(const System& system, double x, double y) {
    const std::array q{x, y, 0.0, 3.0}, v{0.0, 0.0, 0.0, 0.0};
    auto e = system.evaluation();
    system.evaluate({0.0, q, v}, e);
    return {e.w.begin(), e.w.end()};
  }

  Scene<2> scene;
};

// Between the two fixed points the rods' gradients are parallel; which rows are in force does not change in
// number there, whatever rows of velocities take their place.
TEST_F(RodsAndVelocities, KeepTheirNumberWhereRodsAreInLine) {
  const System system = scene.system();
  const ActiveRows before = independent_rows(system, gradients(system, 1.0, 0.5));
  ASSERT_EQ(before.size(), 3U);
  for (const double y : {0.1, 1e-3, 1e-6, 0.0}) {
    const ActiveRows now = independent_rows(system, gradients(system, 1.0, y), before);
    EXPECT_EQ(now.size(), 3U) << y;
    EXPECT_EQ(now.holonomic, 2U) << y;
  }
}

}  // namespace
}  // namespace dalembert::rank_test
