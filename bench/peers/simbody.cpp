#include "dalembert/bench/peers/peers.h"
#include <dalembert/bench/peers/simbody_rods.h>

#include <limits>

namespace dalembert::bench {

namespace {

MethodRun<2> converted(const simbody::Run& run) {
  MethodRun<2> result;
  for (const simbody::Sample& sample : run.samples) {
    models::Observation<2> seen{.positions = {}, .forces = sample.tensions};
    for (const auto& [x, y] : sample.positions) seen.positions.emplace_back(x, y);
    result.seen.push_back(std::move(seen));
  }
  result.statistics.steps = run.steps;
  result.statistics.evaluations = run.evaluations;
  result.statistics.run_time = run.run_time;
  result.statistics.residual_position = std::numeric_limits<double>::quiet_NaN();
  result.statistics.residual_velocity = std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace

std::vector<Method> peers() { return {Method::simbody_pin, Method::simbody_rod}; }

Methods<2> peers(double gravity, const std::vector<models::RodAndBead>& given) {
  std::vector<simbody::Rod> rods;
  for (const models::RodAndBead& rod : given) rods.push_back({rod.mass, rod.length, rod.angle});
  const auto method = [&](simbody::Coordinates coordinates) {
    return [=](std::span<const double> times, double tolerance) {
      return converted(simbody::run(rods, gravity, coordinates, {times.begin(), times.end()}, tolerance));
    };
  };
  return {{Method::simbody_pin, method(simbody::Coordinates::minimal)},
          {Method::simbody_rod, method(simbody::Coordinates::cartesian)}};
}

}  // namespace dalembert::bench
