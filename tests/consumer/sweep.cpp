// The frequency of a mass on springs: a row each. Usage: consumer-sweep <file>
#include <dalembert/dalembert.h>
#include <dalembert/sweep/runs.h>
#include <dalembert/sweep/sweep.h>

#include <cmath>
#include <iostream>

struct Cart {
  dalembert::Scene<2> scene{"cart"};
  dalembert::Particle<2> cart = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "cart");
};

int main(int argc, char** argv) {
  using namespace dalembert;
  if (argc < 2) return 2;
  const auto make = [](const Row& row) {
    Cart built;
    built.scene.add(Spring{Fixed<2>{}, built.cart, row["stiffness"]});
    return built;
  };
  const auto end = observing({{"x", "m"}}, [](const Cart& built, const Trajectory<2>& run) {
    return run.position(built.cart, run.size() - 1).x();
  });
  std::cout << sweep(grid({{"stiffness", "N/m", 1.0, 4.0, 4}}), make, end,
                     {.file = argv[1], .run = {.t_end = 1.0, .tolerance = 1e-8}})
                   .report()
            << '\n';
  const auto x = read_column(argv[1], "x");
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i] - std::cos(std::sqrt(1.0 + static_cast<double>(i)))) > 1e-6) return 1;
  return 0;
}
