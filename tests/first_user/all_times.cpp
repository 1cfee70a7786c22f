// All times at once: the highest speed and acceleration of a bob, and the greatest tension.
#include <dalembert/dalembert.h>

#include <cmath>

using namespace dalembert;

int main() {
  Scene<2> scene("pendulum");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
  const auto rod = scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");

  const auto run = simulate(scene, {.t_end = 3.0, .samples = 3001, .tolerance = 1e-9});
  const double speed = run.velocities(bob).largest_norm();
  const double acceleration = run.accelerations(bob).largest_norm();
  const double tension = -run.multipliers(rod).minCoeff();
  // At the bottom v^2 = 2 g, the acceleration v^2, the tension m (g + v^2); samples are 1 ms apart.
  const bool right = std::abs(speed - std::sqrt(2.0 * 9.81)) < 1e-4 &&
                     std::abs(acceleration - 2.0 * 9.81) < 1e-3 && std::abs(tension - 3.0 * 9.81) < 1e-3;
  return right ? 0 : 1;
}
