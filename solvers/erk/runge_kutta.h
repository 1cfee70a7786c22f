#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/erk/friction_switches.h>
#include <dalembert/solvers/erk/node.h>
#include <dalembert/solvers/erk/round_off.h>
#include <dalembert/solvers/erk/singular_passage.h>
#include <dalembert/solvers/erk/stages.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/run/accumulated_error.h>

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The pair and what a step of it needs.
struct ErkStepper::RungeKutta {
  static constexpr auto& pair = Stages::pair;
  static constexpr long check_interval = 8;  // steps

  RungeKutta(const Problem& problem, const Start& start, const Options& options);

  /// Of positions and of velocities.
  [[nodiscard]] std::pair<std::span<double>, std::span<double>> halves(std::span<double> x) const {
    return {x.first(n), x.subspan(n)};
  }
  static void require(bool regular);
  /// Stages 2 to `last` of a step from `start`.
  void run_stages(const Node& start, double step, std::size_t last, bool onto_constraints);
  void run_stage(std::size_t i, double t, bool onto_constraints);
  void record_comparisons_of_stage(std::size_t i, double t, bool onto_constraints);
  [[nodiscard]] bool close_to_singular(double step) const;
  void find_sine(Node& node);
  void note_sine(Node& node) const;
  void find_middle();

  void weigh(const Node& at, double step, double allowed);
  void adopt(const PathExtent& extent);
  [[nodiscard]] double root_mean(double sum) const;
  [[nodiscard]] double weighted_norm() const;
  [[nodiscard]] std::array<double, 4> estimates(double step);
  [[nodiscard]] double error(double step, double doubt);
  void estimate(double step, double of_order_8);
  [[nodiscard]] double error_of_compliant_forces(std::span<const double> dq) const;
  [[nodiscard]] double project();
  [[nodiscard]] double disagreement(double step);

  [[nodiscard]] double round_off_of_projection() const;
  [[nodiscard]] double attempt(double step);
  void accept(bool by_extrapolation);

  [[nodiscard]] double shortest() const;
  [[nodiscard]] double shorter(double step, double factor) const;
  [[nodiscard]] std::string cause() const;
  [[nodiscard]] double step_towards(double wanted) const;

  const System* system;
  std::size_t n;
  Scales scales;
  std::vector<double> lengths;  // see Scales
  double tolerance, t_end;
  Manifold manifold;
  Stages stages;
  Node from, to;  // the last step; before the first, both are the start
  Node middle;    // of that step, if `has_middle`
  bool has_middle = false;
  bool starts_at_switch = false;
  bool projected = false;     // the stages of the last attempt
  bool extrapolated = false;  // the last step passed a singular position
  Node next;                  // where a step goes until it is accepted
  /// Stages 4, 5 and 9 at 0.16, 0.39 and 0.90 of the step, whose comparisons are noted.
  static constexpr std::array<std::size_t, 3> noted{3, 4, 8};
  const Branches::Sides* held = nullptr;  // that the steps are taken on, if anything is compared
  std::array<Compared, noted.size()> compared;
  bool strayed = false;                    // at a stage that was noted, see Branches
  std::vector<double> difference, weight;  // of positions and velocities
  RoundOff round_off;
  StepError estimated, reached;         // of an attempt; of the last step
  std::vector<double> force_of_spring;  // per row, 0 in rigid ones; empty if all are
  PathExtent covered;                   // by the steps taken; `scales` may be those of one that is tried
  double usual;                         // step, however near the end of the run is
  double longest;                       // that is allowed
  double h;                             // to try next
  long steps = 0, failures = 0, stability_limited = 0;

  std::string fault;  // of the last attempt that failed

  SingularPassage singular;
  FrictionSwitches switching;
};

}  // namespace dalembert
