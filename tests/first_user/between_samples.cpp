// Between samples: when is the rod pulled hardest, to a thousandth of a second, without another run?
#include <dalembert/dalembert.h>

#include <cmath>
#include <vector>

using namespace dalembert;

int main() {
  Scene<2> scene("pendulum");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
  const auto rod = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");

  const auto run = simulate(scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-8, .dense = true});
  std::vector<double> times;
  for (int i = 0; i <= 1000; ++i) times.push_back(i / 1000.0);
  const auto fine = run.at(times);
  const double hardest = -fine.multipliers(rod).minCoeff();

  return std::abs(hardest - 3.0 * 9.81) < 1e-3 ? 0 : 1;  // at the lowest point, 3 m g
}
