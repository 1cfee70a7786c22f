// A copy of a scene with another parameter: the period of a swing at four spring constants.
#include <dalembert/dalembert.h>

#include <cmath>
#include <numbers>

using namespace dalembert;

int main() {
  Scene<2> scene("cart");
  const auto cart = scene.add_particle({.mass = 2.0, .position = {1.0, 0.0}}, "cart");
  const auto spring = scene.add(Spring{Fixed<2>{}, cart, 1.0}, "spring");

  double worst = 0.0;
  for (const double k : {1.0, 4.0, 9.0, 16.0}) {
    Scene<2> stiffer = scene;
    stiffer.replace(spring, Spring{Fixed<2>{}, cart, k});
    const double period = 2.0 * std::numbers::pi * std::sqrt(2.0 / k);
    const auto run = simulate(stiffer, {.t_end = period, .tolerance = 1e-9});
    worst = std::max(worst, std::abs(run.position(cart, run.size() - 1).x() - 1.0));
  }
  return worst < 1e-6 ? 0 : 1;  // it is back where it was; 1e-9 a step, some hundred steps
}
