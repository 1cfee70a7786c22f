// Look-up by name: what was added in another function is read and changed without its handle.
#include <dalembert/dalembert.h>

#include <cmath>

using namespace dalembert;

Scene<2> pendulum() {
  Scene<2> scene("pendulum");
  scene.add(UniformGravity<2>{{0.0, -9.81}}, "gravity");
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.0, -1.0}}, "bob");
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  return scene;
}

int main() {
  Scene<2> scene = pendulum();
  scene.replace(scene.force("gravity"), UniformGravity<2>{{0.0, -1.62}});  // on the moon
  const auto run = simulate(scene, {.t_end = 1.0});
  const double tension = -run.multiplier(scene.constraint("rod"), 0);
  return std::abs(tension - 2.0 * 1.62) < 1e-12 ? 0 : 1;
}
