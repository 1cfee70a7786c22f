// max, min, cbrt, copysign, ... in an equation: a ball on a floor that only pushes.
#include <dalembert/dalembert.h>

#include <cmath>

using namespace dalembert;

int main() {
  Scene<2> scene("bounce");
  const auto ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}}, "ball");
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto push = [](auto r) { return 5e3 * pow(max(-r.y(), 0.0), 2); };
  const auto floor = scene.add(potential(points(ball), push), "floor");

  const auto run =
      simulate(scene, {.t_end = 2.0, .samples = 2001, .tolerance = 1e-9, .stepper = Stepper::erk});
  double highest = 0.0;
  for (const auto& now : run) highest = std::max(highest, now.force(floor, ball).y());
  // All energy in the spring, k d^2/2 = g (1 + d); samples 1 ms apart see its force k d within (w dt)^2/8.
  const double d = (10.0 + std::sqrt(100.0 + 2.0 * 1e4 * 10.0)) / 1e4;
  return std::abs(highest / (1e4 * d) - 1.0) < 0.1 * 0.1 / 8.0 ? 0 : 1;
}
