#include <dalembert/bench/sweeps/examples.h>
#include <dalembert/dalembert.h>
#include <dalembert/models/double_pendulum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert::bench {

namespace {

constexpr double longest = 50.0;  ///< in sqrt(l/g)

/// A rod's angle from the downward vertical, followed over the top, and its rate.
struct Turn {
  double angle = 0.0, rate = 0.0;
  void follow(const Vec<2>& rod, const Vec<2>& velocity) {
    const double now = std::atan2(rod.x(), -rod.y());
    angle += std::remainder(now - angle, 2.0 * std::numbers::pi);  // a step is less than half a turn
    rate = (rod.x() * velocity.y() - rod.y() * velocity.x()) / rod.squaredNorm();
  }
};

/// When the angle is half a turn, within a step: of the cubic through both ends and their rates, whose error
/// is h^4/384 of the fourth derivative (beside events found to the tolerance: 3e-5 in the median of 4,600
/// flips before t = 8, 1e-2 at most, for a third of the time).
double top(const Turn& before, const Turn& after, double start, double end) {
  const double h = end - start;
  const auto angle = [&](double s) {
    return (1 - s) * (1 - s) * ((1 + 2 * s) * before.angle + s * h * before.rate) +
           s * s * ((3 - 2 * s) * after.angle - (1 - s) * h * after.rate);
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (std::abs(angle(middle)) < std::numbers::pi ? low : high) = middle;
  }
  return start + h * low;
}

RowResult flip(const Row& row) {
  const models::DoublePendulum pendulum{.gravity = 1.0, .angle1 = row["angle1"], .angle2 = row["angle2"]};
  const models::HangingRods rods = pendulum.scene();
  const auto upper = rods.beads[0], lower = rods.beads[1];
  Simulation<2> run(rods.scene, {.t_end = longest, .samples = 2, .tolerance = 1e-7, .stepper = Stepper::erk});
  std::array<Turn, 2> now{Turn{row["angle1"]}, Turn{row["angle2"]}};
  while (run.time() < longest) {
    const double start = run.time();
    const std::array<Turn, 2> before = now;
    run.step();
    now[0].follow(run.position(upper), run.velocity(upper));
    now[1].follow(run.position(lower) - run.position(upper), run.velocity(lower) - run.velocity(upper));
    double first = std::numeric_limits<double>::infinity();
    for (std::size_t rod = 0; rod < 2; ++rod)
      if (std::abs(now[rod].angle) > std::numbers::pi)
        first = std::min(first, top(before[rod], now[rod], start, run.time()));
    if (std::isfinite(first)) return {{first}, {}};
  }
  return {{std::numeric_limits<double>::infinity()}, {}};
}

}  // namespace

Example flips(std::size_t points) {
  // Pairs of angles in the middle of a raster, so that no rod stands exactly upright.
  const double edge = std::numbers::pi * (1.0 - 1.0 / static_cast<double>(points));
  return {
      grid({{"angle1", "rad", -edge, edge, points}, {"angle2", "rad", -edge, edge, points}}),
      {{{"flip", "sqrt(l/g)"}}, {}, flip, "first flip of a double pendulum from rest, within 50 sqrt(l/g)"}};
}

}  // namespace dalembert::bench
