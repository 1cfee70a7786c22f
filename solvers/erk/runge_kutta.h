#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/erk/friction_switches.h>
#include <dalembert/solvers/erk/node.h>
#include <dalembert/solvers/erk/singular_passage.h>
#include <dalembert/solvers/erk/stages.h>
#include <dalembert/solvers/erk/step_errors.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <array>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// Steps by the pair from node to node, and how long they are. The stages of a step, its errors, and what it
/// may have to pass have classes of their own.
struct ErkStepper::RungeKutta {
  static constexpr auto& pair = Stages::pair;
  static constexpr long check_interval = 8;  // steps

  RungeKutta(const Problem& problem, const Start& start, const Options& options);

  static void require(bool regular);
  /// Stages 2 to `last` of a step from `start`.
  void run_stages(const Node& start, double step, std::size_t last, bool onto_constraints);
  void run_stage(std::size_t i, double t, bool onto_constraints);
  void record_comparisons_of_stage(std::size_t i, double t, bool onto_constraints);
  [[nodiscard]] bool close_to_singular(double step) const;
  void find_sine(Node& node);
  void note_sine(Node& node) const;
  void find_middle();

  [[nodiscard]] double project();
  [[nodiscard]] double round_off_of_projection() const;
  [[nodiscard]] double attempt(double step);
  void accept(bool by_extrapolation);

  [[nodiscard]] double shortest() const;
  [[nodiscard]] double shorter(double step, double factor) const;
  [[nodiscard]] std::string cause() const;
  [[nodiscard]] double step_towards(double wanted) const;

  const System* system;
  std::size_t n;
  double t_end;
  Manifold manifold;
  Stages stages;
  StepErrors errors;
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
  bool strayed = false;  // at a stage that was noted, see Branches
  double usual;          // step, however near the end of the run is
  double longest;        // that is allowed
  double h;              // to try next
  long steps = 0, failures = 0, stability_limited = 0;

  std::string fault;  // of the last attempt that failed

  SingularPassage singular;
  FrictionSwitches switching;
};

}  // namespace dalembert
