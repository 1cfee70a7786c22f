// Lets go: when does a particle leave the sphere that it slides off, and where?
#include <dalembert/dalembert.h>

#include <cmath>

using namespace dalembert;

int main() {
  Scene<2> scene("sphere");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto particle =
      scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}, .velocity = {0.2, 0.0}}, "particle");
  const auto sphere = scene.add(OnSurface{particle, Sphere<2>{.radius = 1.0}}, "sphere");

  const auto push = [=](const Sample<2>& now) { return now.multiplier(sphere); };
  const auto run =
      simulate(scene, {.t_end = 5.0, .tolerance = 1e-9},
               {{.name = "lets go", .function = push, .crossing = Crossing::falling, .ends = true}});

  // Energy, v^2 = v0^2 + 2 g (1 - cos), and m v^2 = m g cos: cos = 2/3 + v0^2/(3 g).
  const double cosine = run.event_sample(0).position(particle).y();
  return std::abs(cosine - (2.0 / 3.0 + 0.04 / (3.0 * 9.81))) < 1e-7 ? 0 : 1;
}
