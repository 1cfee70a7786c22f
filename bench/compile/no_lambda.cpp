#include <dalembert/dalembert.h>

int main() {
  using namespace dalembert;

  Scene<2> scene;
  scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}});
  scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  return simulate(scene, {.t_end = 1.0, .samples = 2}).size() == 2 ? 0 : 1;
}
