#include "dalembert/solvers/manifold/start.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/manifold/first_scales.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/singular_start.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dalembert {

namespace {

/// The equations at a state whose springs are as long as it says: compliant rows are satisfied there.
void evaluate_relaxed(const System& system, const Instant& at, System::Evaluation& e) {
  system.evaluate(at, e);
  for (auto* residual : {&e.g, &e.psi}) {
    for (std::size_t r = 0; r < residual->size(); ++r) {
      if (system.law(r).compliant()) (*residual)[r] = 0.0;
    }
  }
}

/// The entries of a row add where it acts on a coordinate twice; whether they cancel to round-off on all.
bool cancels(const System& system, std::span<const double> w, std::size_t row) {
  const Places own = system.row(row);
  const auto columns = system.w_columns();
  for (const std::size_t k : own) {
    double sum = 0.0, size = 0.0;
    for (const std::size_t other : own) {
      if (columns[other] != columns[k]) continue;
      sum += w[other];
      size += std::abs(w[other]);
    }
    if (std::abs(sum) > static_cast<double>(own.size()) * epsilon * size) return false;
  }
  return true;
}

void require_gradients(const System& system, const System::Evaluation& e, double t) {
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (!system.in_force(r) || !cancels(system, e.w, r)) continue;
    const auto own = std::span(e.w).subspan(system.row(r).front(), system.row(r).size());
    const bool none = std::ranges::all_of(own, [](double w) { return w == 0.0; });
    std::ostringstream what;
    what << system.row_label(r) << " has no gradient: "
         << (none ? system.singular_hint(r)
                  : "it acts on the same point twice, and what it does there cancels")
         << " (t = " << t << ')';
    throw InconsistentStart(what.str());
  }
}

/// Squares of lengths and their inverses occur everywhere.
void require_size(double length) {
  if (std::isnormal(length * length) && std::isnormal(1.0 / (length * length))) return;
  std::ostringstream what;
  what << "The size of this scene, " << length
       << ", is beyond what double precision computes with; choose other units, or correct the position or "
          "speed that makes it so";
  throw InconsistentStart(what.str());
}

/// The loosest tolerance that the options allow.
constexpr double loosest = 0.1;

/// Where a rounding of the positions exceeds the loosest tolerance nothing is known of a motion.
void require_near_origin(const Scales& scales, std::span<const double> q) {
  if (scales.length_from_path || scales.rounding(q) <= loosest * scales.length) return;
  std::ostringstream what;
  what << "The scene, of length " << scales.length
       << ", is so far from the origin that double precision resolves " << scales.largest_rounding(q)
       << " there; choose an origin nearer to it";
  throw InconsistentStart(what.str());
}

enum class Level { position, velocity };

/// The residual as the equation is stated, which its author looks for, and its size as a distance or speed.
[[noreturn]] void refuse(const System& system, const Violation& violation, const System::Evaluation& e,
                         Level level, double t, const char* fault, const char* remedy) {
  const bool of_position = level == Level::position;
  const bool rate = !of_position && violation.row < system.holonomic_rows();
  std::ostringstream what;
  what << system.row_label(violation.row) << ' ' << fault << ": at t = " << t
       << (rate ? " the rate of its equation is " : " its equation gives ")
       << (of_position ? e.g : e.psi)[violation.row] << " in place of 0, off by a "
       << (of_position ? "distance" : "speed") << " of " << violation.size << "; " << remedy;
  throw InconsistentStart(what.str());
}

/// Per coordinate, the sum of what the forces and each compliant constraint by itself accelerate it by.
std::vector<double> forced_by_each(const System& system, const System::Evaluation& e,
                                   std::span<const double> lambda) {
  std::vector<double> a(e.force.size());
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::abs(e.force[i]) / system.masses()[i];
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (!system.in_force(r) || !system.law(r).compliant()) continue;
    for (const std::size_t k : system.row(r)) {
      const auto i = system.w_columns()[k];
      a[i] += std::abs(e.w[k] * lambda[r]) / system.masses()[i];
    }
  }
  return a;
}

/// The largest |psi_q| of the rows in terms without signs, a row's divided by the length of its gradient
/// [1/time].
double largest_slope(const System& system, const Instant& at, std::span<const double> w,
                     std::span<const double> lengths) {
  auto slopes = system.linearisation();
  system.linearise_constraints(at, std::vector<double>(system.rows()), slopes);
  double largest = 0.0;
  for (std::size_t r = 0; r < system.rows(); ++r) {
    const double gradient = system.in_force(r) ? gradient_length(system, w, lengths, r) : 0.0;
    if (gradient == 0.0) continue;
    double terms = 0.0;
    for (const std::size_t k : system.row(r))
      terms += std::abs(slopes.psi_q[k]) / lengths[system.w_columns()[k]];
    largest = std::max(largest, terms / gradient);
  }
  return largest;
}

/// Dropped rows follow from the others in position and velocity once they hold at the start. In
/// acceleration they must agree too: two drives of one point may coincide and yet contradict each other.
///
/// Where nothing moves, whatever speeds were given, or all move alike, the terms are round-off and agree in
/// nothing: they are known to the round-off of a term of those speeds, v^2/L, or of its own. A row's terms
/// are divided by the length of its gradient: they are accelerations.
///
/// Accelerations are known to the round-off of the largest that a force gives, also where all forces cancel:
/// those of springs at their natural lengths are the round-off of these, and so is each of their sums.
void require_consistent_accelerations(const System& system, const Manifold& manifold, const Start& start,
                                      std::span<const double> given, double t) {
  const double speed = std::max(start.scales.largest(given), start.scales.largest(start.v));
  const double rounding = epsilon * speed * speed * start.scales.length;
  std::vector<double> residual(system.rows());
  system.bias({t, start.q, start.v}, residual);
  const auto& w = manifold.equations().w;
  const auto forced = forced_by_each(system, manifold.equations(), start.lambda);
  const auto lengths = start.scales.lengths();
  double scale = 0.0;
  for (std::size_t r = 0; r < residual.size(); ++r) {
    if (!system.in_force(r)) continue;
    const double gradient = gradient_length(system, w, lengths, r);
    residual[r] /= gradient;
    for (const std::size_t k : system.row(r)) {
      const auto i = system.w_columns()[k];
      const double term = w[k] * start.a[i] / gradient;
      scale = std::max({scale, std::abs(term), std::abs(residual[r]), std::abs(w[k]) * forced[i] / gradient});
      residual[r] += term;
    }
  }
  const auto first_beyond = [&](double known) {
    std::size_t r = 0;
    while (r < residual.size() && (system.law(r).compliant() || std::abs(residual[r]) <= known)) ++r;
    return r;
  };
  const double known = 1e-6 * scale + rounding;
  if (first_beyond(known) == residual.size()) return;
  // What roundings of velocities leave of a row's bias, psi_q v: where all move alike its terms may cancel,
  // each far larger than v^2/L, as those of a short blade do.
  const std::size_t r = first_beyond(known + converged_to * speed * start.scales.length *
                                                 largest_slope(system, {t, start.q, start.v}, w, lengths));
  if (r == residual.size()) return;
  throw InconsistentStart(
      system.row_label(r) +
      " contradicts the other constraints: no accelerations satisfy all of them; remove or "
      "correct one of those that act on the same particles");
}

/// The largest acceleration that constraints which move by themselves demand of what is at rest, as a drive.
double driven_acceleration(const System& system, const Instant& at, std::span<const double> w,
                           std::span<const double> lengths) {
  const std::vector<double> at_rest(at.v.size());
  std::vector<double> bias(system.rows());
  system.bias({at.t, at.q, at_rest}, bias);
  double largest = 0.0;
  for (std::size_t r = 0; r < bias.size(); ++r) {
    const double gradient = system.in_force(r) ? gradient_length(system, w, lengths, r) : 0.0;
    if (gradient > 0.0) largest = std::max(largest, std::abs(bias[r]) / gradient);
  }
  return largest;
}

/// The speed that the scene has, or that its forces give it over its own length.
double speed_of(const System& system, const System::Evaluation& e, const Start& start) {
  const double forced = std::sqrt(start.scales.largest(forced_acceleration(system, e)));
  return std::max(start.scales.largest(start.v), forced) * start.scales.length;
}

/// Whether rows miss their velocities by more than counts as satisfied. What starts from rest without forces
/// has no speed but that which drives give it over its length, and is known to the roundings of positions.
bool misses(const System& system, const Violation& by, const System::Evaluation& e, const Start& start,
            double t) {
  const Instant at{t, start.q, start.v};
  if (by.size <= start_tolerance * speed_of(system, e, start)) return false;
  const double L = start.scales.length, a = driven_acceleration(system, at, e.w, start.scales.lengths());
  const double rounding =
      start.scales.rounding(start.q) * largest_slope(system, at, e.w, start.scales.lengths());
  return !(by.size <= start_tolerance * std::sqrt(a * L) + rounding);
}

/// After projection: what is left is a contradiction.
[[noreturn]] void refuse_contradiction(const System& system, const Violation& left,
                                       const System::Evaluation& e, Level level, double t) {
  refuse(system, left, e, level, t, "cannot be satisfied together with the other constraints",
         "check lengths and fixed points, or start closer to the intended configuration");
}

/// Rows are told apart only as well as a state is known: rows that depend on each other on the constraints do
/// so only roughly nearby, and must not be solved against each other.
double roughly_dependent(double known) { return std::max(rank_threshold, std::min(known, 1e-3)); }

void start_positions(const Problem& problem, Start& start, const System::Evaluation& e,
                     const Options& options) {
  const System& system = problem.system();
  const double L = start.scales.length;
  const auto lengths = start.scales.lengths();
  const double bound = start_tolerance * L + start.scales.rounding(start.q);
  const Violation given = position_violation(system, e, lengths);
  if (given.size > bound && !options.assemble) {
    refuse(system, given, e, Level::position, options.t_start, "is violated by the initial positions",
           "correct the positions, or set the option assemble to have them moved");
  }
  Manifold manifold(problem, independent_rows(system, e.w, roughly_dependent(10.0 * given.size / L)),
                    lengths);
  const Violation left = manifold.project_positions(options.t_start, start.q, start.v, converged_to * L);
  if (!(left.size <= bound))
    refuse_contradiction(system, left, manifold.equations(), Level::position, options.t_start);
}

void start_velocities(const System& system, const Start& start, const System::Evaluation& e,
                      const Options& options) {
  const Violation given = velocity_violation(system, e, start.scales.lengths());
  if (!options.assemble && misses(system, given, e, start, options.t_start)) {
    refuse(system, given, e, Level::velocity, options.t_start, "is violated by the initial velocities",
           "correct the velocities, or set the option assemble to have them changed");
  }
}

void require_regular(const Problem& problem, const Start& start, double t) {
  const auto row = singular_row(problem, start, t);
  if (!row) return;
  throw InconsistentStart(
      problem.system().row_label(*row) +
      " depends on the other constraints at the start, but not beside it: that is a singular position, where "
      "the "
      "motion has several branches, and its accelerations and forces of constraint are not determined; start "
      "beside it");
}

}  // namespace

Start consistent_start(const Problem& problem, std::span<const double> q, std::span<const double> v,
                       const Options& options, double nearest_contact) {
  const System& system = problem.system();
  const double t = options.t_start;
  const double duration = options.t_end - options.t_start;
  Start start{{q.begin(), q.end()},
              {v.begin(), v.end()},
              std::vector<double>(q.size()),
              std::vector<double>(system.rows()),
              {},
              {}};
  try {
    auto e = system.evaluation();
    evaluate_relaxed(system, {t, q, v}, e);
    require_gradients(system, e, t);
    set_length(system, {t, q, v}, e, options, nearest_contact, start.scales);
    require_size(start.scales.length);
    require_near_origin(start.scales, q);

    start_positions(problem, start, e, options);
    evaluate_relaxed(system, {t, start.q, start.v}, e);
    start_velocities(system, start, e, options);

    start.scales.origin = start.q;
    start.rows = independent_rows(system, e.w);
    Manifold manifold(problem, start.rows, start.scales.lengths());
    const auto left = [&] {
      if (!manifold.solve_motion(t, start.q, start.v, start.a, start.lambda)) {
        throw InconsistentStart(
            "The constraints of this scene are singular at the start, though none is redundant");
      }
      return velocity_violation(system, manifold.equations(), start.scales.lengths());
    };
    Violation violation = left();
    if (start.scales.largest(start.v) * start.scales.length <= start.scales.rounding(v)) {
      std::ranges::fill(start.v, 0.0);  // the constraints took away all but round-off of what was given
      violation = left();
    }
    if (misses(system, violation, manifold.equations(), start, t))
      refuse_contradiction(system, violation, manifold.equations(), Level::velocity, t);
    require_regular(problem, start, t);
    require_consistent_accelerations(system, manifold, start, v, t);
    start.scales.time = time_scale(system, manifold.equations(), start, duration);
  } catch (const EquationFault& fault) {
    throw InconsistentStart(std::string(fault.what()) +
                            ": correct the equation, or start where it is defined");
  }
  return start;
}

namespace {

/// Moves positions that are right to `known` onto the constraints. `e` is what was evaluated at them.
void move_onto(const Problem& problem, const Scales& scales, double t, std::span<double> q,
               std::span<const double> v, double known, const System::Evaluation& e) {
  Manifold(problem, independent_rows(problem.system(), e.w, roughly_dependent(known)), scales.lengths())
      .project_positions(t, q, v, converged_to * scales.length);
}

}  // namespace

Start restart_with_constraints(const Problem& problem, const Start& before, double t,
                               std::span<const double> q, std::span<const double> v, double known) {
  const System& system = problem.system();
  Start start = before;
  start.q.assign(q.begin(), q.end());
  start.v.assign(v.begin(), v.end());
  auto e = system.evaluation();
  system.evaluate({t, q, v}, e);
  move_onto(problem, start.scales, t, start.q, start.v, known, e);
  system.evaluate({t, start.q, start.v}, e);
  start.rows = independent_rows(system, e.w);
  Manifold manifold(problem, start.rows, start.scales.lengths());
  if (!manifold.solve_motion(t, start.q, start.v, start.a, start.lambda)) throw linearly_dependent(t);
  return start;
}

std::vector<double> project_impulsively_onto(const Problem& problem, const Problem& held,
                                             const Scales& scales, double t, std::span<double> q,
                                             std::span<double> v, double known) {
  const System& system = problem.system();
  const auto lengths = scales.lengths();
  auto e = system.evaluation();
  evaluate_relaxed(system, {t, q, v}, e);
  const auto refuse = [&](const Violation& by, const char* what) {
    std::ostringstream text;
    text << system.row_label(by.row) << what << by.size
         << "; state what holds then, wait until it does, or ask for a tighter tolerance if it should";
    throw StepFailure{text.str(), t};
  };
  const double least = std::max(start_tolerance, known);
  const Violation violation = position_violation(system, e, lengths);
  if (violation.size > least * scales.length)
    refuse(violation, " comes into force where it does not hold: it is violated by ");
  // Impulses are those of the state that goes on: to move it behind them would turn what they act on.
  evaluate_relaxed(held.system(), {t, q, v}, e);
  move_onto(held, scales, t, q, v, known, e);
  evaluate_relaxed(system, {t, q, v}, e);
  const double bound = start_tolerance * scales.length;
  if (position_violation(system, e, lengths).size > bound) {
    // What takes the load of a contact over, beside it, is where it holds: the contact opens.
    move_onto(problem, scales, t, q, v, known, e);
    evaluate_relaxed(system, {t, q, v}, e);
    const Violation off = position_violation(system, e, lengths);
    if (off.size > bound) refuse(off, " contradicts the other constraints from here on: it is violated by ");
  }
  std::vector<double> impulses(system.rows()), a(q.size()), lambda(system.rows());
  double fastest = scales.speed();
  for (std::size_t i = 0; i < v.size(); ++i) fastest = std::max(fastest, std::abs(v[i]) * lengths[i]);
  Manifold manifold(problem, independent_rows(system, e.w), lengths);
  if (!manifold.project_impulsively(t, q, v, impulses) || !manifold.solve_motion(t, q, v, a, lambda))
    throw linearly_dependent(t);
  const Violation left = velocity_violation(system, manifold.equations(), lengths);
  if (left.size > least * fastest)
    refuse(left, " contradicts the other constraints from here on: its speed is off by ");
  Start start{{q.begin(), q.end()}, {v.begin(), v.end()}, std::move(a), std::move(lambda), {}, scales};
  try {
    require_consistent_accelerations(system, manifold, start, v, t);
  } catch (const InconsistentStart& contradiction) {
    throw StepFailure{contradiction.what(), t};
  }
  return impulses;
}

Start restart_with_rows(const Problem& problem, const Start& before, double t, std::span<const double> q,
                        std::span<const double> v) {
  const System& system = problem.system();
  Start start = before;
  start.q.assign(q.begin(), q.end());
  start.v.assign(v.begin(), v.end());
  auto e = system.evaluation();
  system.evaluate({t, q, v}, e);
  start.rows = independent_rows(system, e.w, before.rows);
  Manifold manifold(problem, start.rows, start.scales.lengths());
  manifold.project_positions(t, start.q, start.v, converged_to * start.scales.length);
  if (!manifold.solve_motion(t, start.q, start.v, start.a, start.lambda)) throw linearly_dependent(t);
  return start;
}

}  // namespace dalembert
