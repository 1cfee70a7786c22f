// Restart from a sample: half way the air is let in, and the swing goes on from there.
#include <dalembert/dalembert.h>

using namespace dalembert;

int main() {
  Scene<2> scene("pendulum");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  const auto air = scene.add(LinearDrag{bob, 0.0}, "air");

  const auto vacuum = simulate(scene, {.t_end = 5.0});
  scene.replace(air, LinearDrag{bob, 0.5});
  const auto rest = simulate(scene, vacuum.sample(50), {.t_end = 10.0});

  const bool goes_on =
      rest.times().front() == 2.5 && rest.position(bob, 0).isApprox(vacuum.position(bob, 50));
  return goes_on && rest.energy(100) < vacuum.energy(100) ? 0 : 1;
}
