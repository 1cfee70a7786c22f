// A tension with its error, and one that errs by no more than is asked for.
#include <dalembert/dalembert.h>

#include <cmath>

int main() {
  using namespace dalembert;
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  const auto rod = scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0});

  const auto certificate = certify(scene, {.t_end = 10.0, .tolerance = 1e-6});
  const auto asked = simulate_to(scene, {.t_end = 10.0, .force_error = 1e-9});

  const double off = std::abs(certificate.run().multiplier(rod, 100) - asked.run().multiplier(rod, 100));
  const double error = certificate.multiplier_error(rod, 100);
  return asked.outcome.met && off > 0.8 * error && off < 1.25 * error ? 0 : 1;
}
