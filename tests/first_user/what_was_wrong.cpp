// What was wrong: the scene, or an argument; a loop that steps to the end needs neither.
#include <dalembert/dalembert.h>

#include <iostream>

using namespace dalembert;

int main() try {
  Scene<2> scene("stone");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  scene.add_particle({.mass = 1.0}, "stone");
  Simulation<2> simulation(scene, {.t_end = 1.0});
  while (simulation.time() < 1.0) simulation.step();
  simulation.advance_to(1.0);  // where it is
  simulation.step();           // beyond
  return 1;
} catch (const InvalidScene& error) {
  std::cerr << "state the scene otherwise: " << error.what() << '\n';
  return 1;
} catch (const InvalidArgument& error) {
  std::cerr << "ask for something else: " << error.what() << '\n';
}
