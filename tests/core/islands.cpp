#include <dalembert/constraints/distance.h>
#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/scene/scene.h>

#include <gtest/gtest.h>

namespace dalembert::islands_test {
namespace {

TEST(Islands, NeitherRodNorForceConnectsThem) {
  Scene<2> scene;
  std::vector<Particle<2>> p;
  for (int i = 0; i < 5; ++i) p.push_back(scene.add_particle({.mass = 1.0, .position = {1.0 * i, 0.0}}));
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add(Distance{p[0], p[3], 3.0});
  scene.add(Spring{p[1], p[4], 10.0, 3.0});
  const System system = scene.system();
  const Islands found = islands(system);
  EXPECT_EQ(found.count, 4);  // {0, 3}, {1, 4} and the coordinates of 2, that nothing connects
  EXPECT_EQ(found.of_coordinate, (std::vector<std::size_t>{0, 0, 1, 1, 2, 3, 0, 0, 1, 1}));
  EXPECT_EQ(found.of_row(system, 0), 0);
}

}  // namespace
}  // namespace dalembert::islands_test
