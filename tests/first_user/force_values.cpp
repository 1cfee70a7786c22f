// The value of a force that was added: the drag of a falling ball grows until it carries its weight.
#include <dalembert/dalembert.h>

#include <iostream>

using namespace dalembert;

int main() {
  Scene<2> scene("ball");
  const auto ball = scene.add_particle({.mass = 0.1}, "ball");
  const auto weight = scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto drag = scene.add(QuadraticDrag{ball, 0.02}, "drag");

  const auto run = simulate(scene, {.t_end = 10.0});
  for (const auto& now : run) {
    std::cout << now.time() << " s: drag " << now.force(drag, ball).y() << " N, weight "
              << now.force(weight, ball).y() << " N\n";
  }
  const auto last = run.sample(run.size() - 1);
  return (last.force(drag, ball) + last.force(weight, ball)).norm() < 1e-4 ? 0 : 1;
}
