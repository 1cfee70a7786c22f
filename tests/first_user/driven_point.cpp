// Fixed, driven and body points are read like particles: how far a crank's end is from the pin that shakes
// it.
#include <dalembert/dalembert.h>

using namespace dalembert;

int main() {
  Scene<2> scene("shaken");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto pin = driven([](auto t) { return vec(0.1 - 0.1 * cos(5.0 * t), 0.0); });
  const auto crank =
      add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 0.1, .centre = {0.0, -0.5}}, "crank");
  const auto end = crank.point({0.0, 0.5});
  scene.add(Coincident{pin, end}, "hinge");

  const auto run = simulate(scene, {.t_end = 2.0});
  double apart = 0.0;
  for (const auto& now : run) {
    apart = std::max(apart, (now.position(pin) - now.position(end)).norm());
    apart = std::max(apart, (now.acceleration(pin) - now.acceleration(end)).norm());
  }
  return apart < 1e-9 ? 0 : 1;
}
