#include "dalembert/bench/modes.h"

#include <dalembert/models/hanging_rods.h>
#include <dalembert/models/small_motions.h>
#include <dalembert/models/two_formulations.h>

#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
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

int modes(const ModesTable& options) {
  require_writable(options.report);
  auto all = models::small_motions();
  long_chain(options.beads, all);
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
