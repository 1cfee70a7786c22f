// The force on a body, not on its hidden particles, and its moment about a point.
#include <dalembert/dalembert.h>

#include <cmath>

using namespace dalembert;

int main() {
  Scene<3> scene("lamp");
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const BodyState<3> state{.mass = 2.0, .inertia = {0.1, 0.1, 0.05}, .centre = {0.3, 0.0, -0.4}};
  const auto lamp = add_body(scene, state, "lamp");
  const auto hook = scene.add(Coincident{Fixed<3>{}, lamp.point({-0.3, 0.0, 0.4})}, "hook");

  for (const auto& now : simulate(scene, {.t_end = 1.0})) {
    const Vec<3> force = now.constraint_force(hook, lamp);
    const Vec<3> accelerated = 2.0 * (now.acceleration(lamp.centre()) - Vec<3>{0.0, 0.0, -9.81});
    if ((force - accelerated).norm() > 1e-9) return 1;  // Newton
    if (now.constraint_moment(hook, lamp, Vec<3>{0.0, 0.0, 0.0}).norm() > 1e-9)
      return 1;  // it pulls at the hook
  }
  return 0;
}
