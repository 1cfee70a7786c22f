#include <dalembert/dalembert.h>
#include <dalembert/testing/laws.h>

#include <cmath>
#include <iostream>
#include <string>

int main() {
  using namespace dalembert;

  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 0.0}});
  const auto rod = scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0});

  const Trajectory<2> run = simulate(scene, {.t_end = 10.0, .samples = 101, .tolerance = 1e-8});

  const std::string broken = broken_laws(scene);
  if (!broken.empty()) std::cout << broken << '\n';

  const auto last = run.times().size() - 1;
  std::cout << "tension at " << run.times()[last] << " s: " << -run.multiplier(rod, last) << " N\n";
  return broken.empty() && std::abs(run.position(bob, last).norm() - 1.0) <= 1e-9 ? 0 : 1;
}
