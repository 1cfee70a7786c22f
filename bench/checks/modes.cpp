#include <dalembert/bench/checks/bicycle_in_time.h>
#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/checks/stability_limits.h>
#include <dalembert/dalembert.h>
#include <dalembert/models/hanging_rods.h>
#include <dalembert/models/small_motions.h>
#include <dalembert/models/two_formulations.h>

#include <boost/math/special_functions/bessel.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>

namespace dalembert::bench {

namespace {

/// The ten lowest modes of a hanging chain of N beads at rest, against the rope's, which the chain's are up
/// to a factor: with j the zeros of the Bessel function J_0, n = 4 N + 2 and L the length
///
///   omega^2 = (g/L) N x,   x = (j^2/n)(1 + (j^2 - 2)/(3 n^2) + ...)        (Tricomi; Szego, 6.31)
///   omega = (j/2) sqrt(g/L) / sqrt(1 + 1/(2 N)) (1 + (j^2 - 2)/(6 n^2) + ...).
///
/// A chain's omega^2 is known to some roundings of the highest, 4 g N^2/L.
void long_chain(int beads, std::vector<models::Compared>& all) {
  constexpr double g = 9.81;
  const double N = beads, n = 4.0 * N + 2.0;
  std::vector<models::RodAndBead> rods(static_cast<std::size_t>(beads), {1.0 / N, 1.0 / N, 0.0});
  const auto hung = models::hang("chain", g, rods);
  const auto found = normal_modes(hung.scene, equilibrium(hung.scene), {.lowest = 10});
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double j = boost::math::cyl_bessel_j_zero(0.0, static_cast<int>(k + 1));
    const double rope = j / 2.0 * std::sqrt(g / (1.0 + 1.0 / (2.0 * N)));
    const double rounding = 10.0 * std::numeric_limits<double>::epsilon() * 4.0 * g * N * N / (rope * rope);
    all.push_back({"chain-" + std::to_string(beads), "omega " + std::to_string(k + 1), found.frequency(k),
                   rope, j * j / (6.0 * n * n) + rounding});
  }
}

/// The ten lowest of N rotors in a line with damping a M + b K: s^2 + (a + b omega^2) s + omega^2 = 0. An s
/// is known to some roundings of the largest K over 2 |s|. Time, and the peak memory of the process so far,
/// are printed.
void damped_line(int rotors, std::vector<models::Compared>& all) {
  const double n = rotors + 1.0, k = n * n, a = 0.3, b = 1e-3;
  Scene<2> scene("damped line");
  std::vector<Rotor> line;
  for (int i = 0; i < rotors; ++i) {
    line.push_back(scene.add_rotor({.inertia = 1.0}));
    const double wall = i == 0 || i + 1 == rotors ? k : 0.0, drag = a + b * wall;
    scene.add(force_law(points(line.back()),
                        [wall, drag](auto x, auto v) { return vec(-wall * x[0] - drag * v[0]); }));
    if (i == 0) continue;
    scene.add(force_law(points(line[line.size() - 2], line.back()), [k, b](auto x, auto y, auto v, auto w) {
      const auto force = k * (y[0] - x[0]) + b * k * (w[0] - v[0]);
      return std::make_tuple(vec(force), vec(-force));
    }));
  }
  const auto rest = equilibrium(scene);
  const auto start = std::chrono::steady_clock::now();
  const auto found = normal_modes(scene, rest, {.lowest = 10});
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::cout << "ten damped modes of " << rotors << " coordinates: " << time.count() << " s, "
            << static_cast<double>(usage.ru_maxrss) / 1024.0 << " MiB\n";
  for (std::size_t j = 0; j < found.size(); ++j) {
    const double omega = 2.0 * n * std::sin(static_cast<double>(j + 1) * std::acos(-1.0) / (2.0 * n));
    const double d = (a + b * omega * omega) / 2.0, vibration = std::sqrt(omega * omega - d * d);
    const double rounding = 100.0 * std::numeric_limits<double>::epsilon() * 4.0 * k / (omega * vibration);
    all.push_back({"damped-line-" + std::to_string(rotors), "omega " + std::to_string(j + 1),
                   found.frequency(j), vibration, rounding});
  }
}

/// Of every system that is stated twice the larger difference of both steppers' runs of 2 s.
void two_formulations(const std::vector<models::TwoFormulations>& systems,
                      std::vector<models::Compared>& all) {
  for (const auto& two : systems) {
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      double difference = 0.0;
      for (const Stepper stepper : {Stepper::ida, Stepper::erk})
        difference = std::max(
            difference,
            two.difference({.t_end = 2.0, .samples = 21, .tolerance = tolerance, .stepper = stepper}));
      std::ostringstream what;
      what << two.what << " at " << tolerance;
      all.push_back({two.model, what.str(), difference, 0.0, 100.0 * tolerance});
    }
  }
}

}  // namespace

int modes(const ModesOptions& options) {
  require_writable(options.report);
  auto all = models::small_motions();
  long_chain(options.beads, all);
  damped_line(options.beads, all);
  stability_limits(all);
  bicycle_in_time(all);
  two_formulations(models::cross_checks(), all);
  two_formulations(models::equivalent_lagrangians(), all);
  Table table{.columns = {"model", "quantity", "value", "reference", "error", "limit"}, .rows = {}};
  int wrong = 0;
  for (const models::Compared& row : all) {
    const bool within = row.error() <= row.limit;
    if (!within) {
      ++wrong;
      std::cerr << "modes: " << row.model << ", " << row.quantity << " is not within its limit\n";
    }
    table.rows.push_back({row.model, row.quantity, scientific(row.value, 15), scientific(row.reference, 15),
                          scientific(row.error()), scientific(row.limit)});
  }
  report(
      "Equilibria, forces of constraint and small motions against closed forms, and systems that are stated "
      "twice: "
      "relative errors",
      table, options.report);
  return wrong;
}

}  // namespace dalembert::bench
