#include <dalembert/bench/sweeps/examples.h>
#include <dalembert/dalembert.h>
#include <dalembert/models/plane_pendulum.h>

#include <stdexcept>

namespace dalembert::bench {

namespace {

RowResult pendulum(const Row& row, std::size_t bad) {
  models::HangingRods rods = models::PlanePendulum{.amplitude = row["angle"]}.scene();
  if (bad > 0 && row.index() % bad == bad - 1)
    rods.scene.add(force_law(points(rods.beads[0]), [](auto t, auto, auto v) {
      if (t > 0.5) throw std::runtime_error("a gale");
      return (-0.1 * v).eval();
    }));
  const auto run =
      simulate(rods.scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-8, .stepper = Stepper::erk});
  return {{-run.multipliers(rods.rods[0]).minCoeff(), run.position(rods.beads[0], run.size() - 1).x()}, {}};
}

}  // namespace

Example pendulums(std::size_t rows, std::size_t bad) {
  return {grid({{"angle", "rad", 0.1, 3.0, rows}}),
          {{{"tension", "N"}, {"x", "m"}},
           {},
           [bad](const Row& row) { return pendulum(row, bad); },
           "a second of a plane pendulum" + (bad > 0 ? ", each " + std::to_string(bad) + "th fails" : "")}};
}

}  // namespace dalembert::bench
