#include "dalembert/solvers/erk/runge_kutta.h"

#include <dalembert/solvers/base/constants.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

/// The 13th stage serves the error estimate only.
constexpr std::size_t last_stage_of_step = verner87.stages - 2;

/// Newton's iteration converges if over its first step the gradients change by no more than this part
/// (Kantorovich); after a step of the method they change by the part that its error is of their radius.
constexpr double most_turned = 0.5;

}  // namespace

ErkStepper::RungeKutta::RungeKutta(const Problem& problem, const Start& start, const Options& options)
    : system(&problem.system()),
      n(start.q.size()),
      t_end(options.t_end),
      manifold(problem, start.rows, start.scales.lengths()),
      stages(n),
      errors(*system, start, options),
      usual(constants.first_explicit_step * std::pow(options.tolerance, 1.0 / pair.order) *
            start.scales.time),
      longest(longest_step(options)),
      h(std::min(usual, longest)),
      singular(*this, n),
      switching(*this, *system) {
  for (Node* node : {&from, &to, &middle, &next}) {
    node->t = options.t_start;
    node->x.reserve(3 * n);
    for (const auto* part : {&start.q, &start.v, &start.a})
      node->x.insert(node->x.end(), part->begin(), part->end());
  }
  switching.make_room(problem, start);
  singular.remember(to.t, start.a);
  find_sine(to);
}

void ErkStepper::RungeKutta::require(bool regular) {
  if (!regular) throw EquationFault("the constraints became linearly dependent");
}

void ErkStepper::RungeKutta::find_sine(Node& node) {
  (void)manifold.sine(node.instant());
  note_sine(node);
}

/// Where the matrix was factored last.
void ErkStepper::RungeKutta::note_sine(Node& node) const {
  node.sine = manifold.sine();
  node.rows = manifold.exchanges();
}

/// Whether the angle between constraints changes much in a step. An error e of a stage off the manifold is
/// one of e/sin^2 in its accelerations; projected stages do not have it.
bool ErkStepper::RungeKutta::close_to_singular(double step) const {
  const bool known = steps > 0 && from.rows == to.rows;
  const double rate = known ? std::abs(to.sine - from.sine) / (to.t - from.t) : 0.0;
  return to.sine < constants.close_to_dependent && step * rate > constants.changing_angle * to.sine;
}

void ErkStepper::RungeKutta::run_stage(std::size_t i, double t, bool onto_constraints) {
  const auto [q, v, v_dot] = stages[i];
  require(onto_constraints ? manifold.project(t, q, v, v_dot) : manifold.accelerate({t, q, v}, v_dot));
}

/// Of an attempt.
void ErkStepper::RungeKutta::record_comparisons_of_stage(std::size_t i, double t, bool onto_constraints) {
  const auto its = std::ranges::find(noted, i);
  if (its == noted.end()) return run_stage(i, t, onto_constraints);
  Compared& here = compared[static_cast<std::size_t>(its - noted.begin())];
  here.t = t;
  const Branches listening(&here.sides, held);
  run_stage(i, t, onto_constraints);
  strayed = strayed || Branches::strayed();
}

void ErkStepper::RungeKutta::run_stages(const Node& start, double step, std::size_t last,
                                        bool onto_constraints) {
  stages.start(start);
  singular.start_step(start);
  for (std::size_t i = 1; i <= last; ++i) {
    stages.move(i, start, step);
    const double t = start.t + pair.c[i] * step;
    if (held != nullptr && &start == &to)
      record_comparisons_of_stage(i, t, onto_constraints);
    else
      run_stage(i, t, onto_constraints);
    singular.note_angle(i, t);
    if (&start == &to && switching.any()) switching.check_switch(i, t);
  }
}

/// Projects `next` onto the constraint manifold. Returns the correction over the tolerance; infinite where
/// one step of Newton's does not say where the manifold is: a state beyond the apex of a cone is moved onto
/// it.
double ErkStepper::RungeKutta::project() {
  errors.keep(next);
  require(manifold.project(next.t, next.q(), next.v(), next.a()));
  return manifold.turned() > most_turned ? std::numeric_limits<double>::infinity() : errors.moved(next);
}

/// Half a step of the method itself from where the last step began; on the constraints, if on its way their
/// angle was smaller than at its ends.
void ErkStepper::RungeKutta::find_middle() {
  if (has_middle) return;
  const double half = 0.5 * (to.t - from.t);
  const Angle& least = singular.least_angle();
  const bool dips = least.sine < (1.0 - constants.changing_angle) * std::min(from.sine, to.sine);
  const bool on = projected || (dips && least.sine < constants.close_to_dependent);
  run_stages(from, half, last_stage_of_step, on);
  stages.finish(from, half, middle);
  require(on ? manifold.project(middle.t, middle.q(), middle.v(), middle.a())
             : manifold.accelerate(middle.instant(), middle.a()));
  has_middle = true;
}

}  // namespace dalembert
