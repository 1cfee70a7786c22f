// Two ways: is the Lagrangian that I derived by hand that of my scene, and are the forces the same?
#include <dalembert/dalembert.h>

using namespace dalembert;

int main() {
  constexpr double g = 9.81;
  Scene<2> scene("pendulum");
  scene.add(UniformGravity<2>{{0.0, -g}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}, .velocity = {3.0, 0.0}}, "bob");
  scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");

  const LagrangianSystem<1> derived(
      {.velocity = Vec<1>(3.0), .names = {"phi"}},
      [](const auto& q, const auto& rate) { return 0.5 * rate[0] * rate[0] + g * cos(q[0]); });
  Embedding<2, 1> where;
  where.add(bob, [](const auto& q) { return vec(sin(q[0]), -cos(q[0])); });

  const CrossCheck check =
      cross_check(scene, derived, where, {.t_end = 5.0, .samples = 51, .tolerance = 1e-8});
  return check.position.relative() < 1e-6 && check.force.relative() < 1e-6 ? 0 : 1;
}
