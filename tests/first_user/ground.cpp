// What a machine does to its foundation: the force of a hinge on the ground, and its moment about a bolt.
#include <dalembert/dalembert.h>

#include <cmath>

using namespace dalembert;

int main() {
  Scene<2> scene("sign");
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto sign = add_body(scene, BodyState<2>{.mass = 3.0, .inertia = 0.2, .centre = {0.4, 0.0}}, "sign");
  const auto hinge = scene.add(Coincident{Fixed<2>{}, sign.point({-0.4, 0.0})}, "hinge");
  const auto stay = scene.add(Distance{Fixed<2>{{0.0, 1.0}}, sign.centre(), std::hypot(0.4, 1.0)}, "stay");

  const auto run = simulate(scene, {.t_end = 1.0});
  const Vec<2> bolt{0.0, -1.0};
  const Vec<2> force = run.ground_force(hinge, 0) + run.ground_force(stay, 0);
  const double moment = run.ground_moment(hinge, bolt, 0) + run.ground_moment(stay, bolt, 0);
  // The sign rests: the ground carries its weight, 30 N at an arm of 0.4 m.
  return (force - Vec<2>{0.0, -30.0}).norm() < 1e-10 && std::abs(moment + 12.0) < 1e-10 ? 0 : 1;
}
