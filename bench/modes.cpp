#include "dalembert/bench/modes.h"

#include <dalembert/dalembert.h>
#include <dalembert/models/hanging_rods.h>
#include <dalembert/models/small_motions.h>
#include <dalembert/models/two_formulations.h>

#include <boost/math/special_functions/bessel.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
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

/// The first bifurcation, or flutter, of a branch.
double first_of(const std::vector<BranchPoint<Equilibrium<2>>>& points) {
  return points.empty() ? std::numeric_limits<double>::quiet_NaN() : points.front().parameter;
}

/// Two rotors of unit inertia under -K(p) x - x^3.
Diagram<Equilibrium<2>> follow_linear(const std::function<Eigen::Matrix2d(double)>& stiffness,
                                      const BranchOptions& options) {
  return follow_branches<2>(
      [&](double p) {
        Scene<2> scene("linear");
        const auto a = scene.add_rotor({.inertia = 1.0}), b = scene.add_rotor({.inertia = 1.0});
        const Eigen::Matrix2d K = stiffness(p);
        scene.add(force_law(points(a, b), [K](auto x, auto y, auto, auto) {
          return std::make_tuple(vec(-K(0, 0) * x[0] - K(0, 1) * y[0] - x[0] * x[0] * x[0]),
                                 vec(-K(1, 0) * x[0] - K(1, 1) * y[0] - y[0] * y[0] * y[0]));
        }));
        return Posed<2>{std::move(scene)};
      },
      options);
}

/// Ziegler's column: links and springs of 1, masses 2 and 1, a load along the last link; it flutters from
/// 7/2 - sqrt(2) on.
Diagram<Equilibrium<2>> ziegler() {
  return follow_branches<2>(
      [](double P) {
        Scene<2> scene("Ziegler");
        const auto knee = scene.add_particle({.mass = 2.0, .position = {0.0, 1.0}}),
                   tip = scene.add_particle({.mass = 1.0, .position = {0.0, 2.0}});
        scene.add(Distance{Fixed<2>{}, knee, 1.0});
        scene.add(Distance{knee, tip, 1.0});
        scene.add(potential(points(knee, tip), [](auto a, auto b) {
          const auto first = atan2(a.x(), a.y()), second = atan2(b.x() - a.x(), b.y() - a.y());
          return 0.5 * (first * first + (second - first) * (second - first));
        }));
        scene.add(force_law(points(knee, tip), [P](auto a, auto b, auto, auto) {
          const auto along = ((b - a) / (b - a).norm()).eval();
          return std::make_tuple((0.0 * along).eval(), (-P * along).eval());
        }));
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.5, .to = 3.0});
}

/// A mass on two bars from (+-1, 0), at rest at (0, 3): it moves sideways at l^3 - l0 l^2 + l0 = 0, l < l0.
Diagram<Equilibrium<2>> steep_truss(double to) {
  return follow_branches<2>(
      [](double load) {
        Scene<2> scene("truss");
        scene.add(UniformGravity<2>{{0.0, -load}});
        const auto top = scene.add_particle({.mass = 1.0, .position = {0.0, 3.0}});
        for (const double side : {1.0, -1.0})
          scene.add(Spring{Fixed<2>{{side, 0.0}}, top, 100.0, std::sqrt(10.0)});
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.0, .to = to});
}

/// Where equilibria lose their stability. Points are located to some 1e-12.
void branches(std::vector<models::Compared>& all) {
  constexpr double located = 1e-11;
  const auto follower = follow_linear(
      [](double P) {
        return Eigen::Matrix2d{{2.0 - P, P - 1.0}, {-1.0, 1.0}};
      },
      {.from = 0.5, .to = 3.0});
  all.push_back(
      {"follower-load", "bifurcations", static_cast<double>(follower.bifurcations.size()), 0.0, 0.0});
  all.push_back({"follower-load", "flutter", first_of(follower.flutters), 1.0, located});
  const auto sheared = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{2.0, 4.0}, {-2.0, p}};
      },
      {.from = -6.0, .to = 2.0, .step = 0.05});
  all.push_back({"circulatory", "bifurcation", first_of(sheared.bifurcations), -4.0, located});
  const auto exchange = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{p - 1.0, 0.0}, {0.0, 1.0 - p}};
      },
      {.from = 0.0, .to = 2.2});
  all.push_back({"exchange", "bifurcation", first_of(exchange.bifurcations), 1.0, located});
  const double l0 = std::sqrt(10.0);
  double l = l0;
  for (int i = 0; i < 60; ++i) l -= (l * l * l - l0 * l * l + l0) / (3.0 * l * l - 2.0 * l0 * l);
  const double load = 200.0 * std::sqrt(l * l - 1.0) * (l0 / l - 1.0);
  all.push_back({"truss", "bifurcation", first_of(steep_truss(1.3 * load).bifurcations), load, located});
  all.push_back({"ziegler", "flutter", first_of(ziegler().flutters), 3.5 - std::sqrt(2.0), located});
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
  damped_line(options.beads, all);
  branches(all);
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
