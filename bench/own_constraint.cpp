#include <dalembert/bench/commands.h>
#include <dalembert/bench/progress.h>
#include <dalembert/dalembert.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace dalembert::bench {

namespace {

/// A chain of length 1 and mass 1, released from horizontal.
struct Chain {
  Scene<2> scene;
  std::vector<Particle<2>> beads;
};

/// `add_rod(scene, a, b, length)` states each rod.
template <class AddRod>
Chain chain(int beads, const AddRod& add_rod) {
  Chain c;
  c.scene.add(UniformGravity<2>{{0.0, -9.81}});
  const double link = 1.0 / beads;
  for (int i = 0; i < beads; ++i) {
    c.beads.push_back(c.scene.add_particle({.mass = link, .position = {(i + 1) * link, 0.0}}));
    if (i == 0) {
      add_rod(c.scene, Fixed<2>{}, c.beads[0], link);
    } else {
      add_rod(c.scene, c.beads[static_cast<std::size_t>(i) - 1], c.beads.back(), link);
    }
  }
  return c;
}

Chain of_distances(int beads) {
  return chain(beads, [](Scene<2>& scene, const auto& a, const auto& b, double length) {
    scene.add(Distance{a, b, length});
  });
}

Chain of_lambdas(int beads) {
  return chain(beads, [](Scene<2>& scene, const auto& a, const auto& b, double length) {
    scene.add(holonomic(points(a, b), [length](auto r_a, auto r_b) { return (r_b - r_a).norm() - length; }));
  });
}

double difference(const Chain& one, const Trajectory<2>& run, const Chain& other,
                  const Trajectory<2>& other_run) {
  double largest = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    for (std::size_t b = 0; b < one.beads.size(); ++b) {
      largest =
          std::max(largest, (run.position(one.beads[b], i) - other_run.position(other.beads[b], i)).norm());
    }
  }
  return largest;
}

struct OwnComparison {
  double ratio = std::numeric_limits<double>::quiet_NaN();  ///< the median one, and its two run times
  double run_time_distance = ratio, run_time_own = ratio;
  double difference = ratio;  ///< the largest of all positions
};

OwnComparison compare(const Chain& distances, const Chain& lambdas, Stepper stepper, int repeats) {
  const Options run{.t_end = 0.2, .samples = 2, .stepper = stepper};
  std::vector<std::array<double, 3>> pairs;  // ratio, and the two times
  double largest = 0.0;
  for (int i = 0; i < repeats; ++i) {
    const auto by_distance = simulate(distances.scene, run);
    const auto by_lambda = simulate(lambdas.scene, run);
    const double a = by_distance.statistics().run_time;
    const double b = by_lambda.statistics().run_time;
    pairs.push_back({b / a, a, b});
    largest = std::max(largest, difference(distances, by_distance, lambdas, by_lambda));
  }
  std::sort(pairs.begin(), pairs.end());
  const auto& [ratio, distance, own] = pairs[pairs.size() / 2];
  return {ratio, distance, own, largest};
}

}  // namespace

void own_constraint(const OwnConstraintOptions& options) {
  require_writable(options.report);
  Table table{.columns = {"stepper", "beads", "run_time_distance_s", "run_time_own_s", "ratio",
                          "difference_position", "outcome"},
              .rows = {}};
  const Chain distances = of_distances(options.beads);
  const Chain lambdas = of_lambdas(options.beads);
  for (const Stepper stepper : options.steppers) {
    const std::string what = std::string("own-constraint, ") + name(stepper);
    OwnComparison c;
    const Outcome outcome = attempt(what, [&] { c = compare(distances, lambdas, stepper, options.repeats); });
    table.rows.push_back({name(stepper), std::to_string(options.beads), scientific(c.run_time_distance),
                          scientific(c.run_time_own), scientific(c.ratio, 3), scientific(c.difference),
                          outcome.name});
  }
  report("A user's own constraint against Distance: the same chain, runs in turn, median ratio", table,
         options.report);
}

}  // namespace dalembert::bench
