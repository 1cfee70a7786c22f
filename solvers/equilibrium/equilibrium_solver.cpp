#include "dalembert/solvers/equilibrium/equilibrium_solver.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/equilibrium.h>
#include <dalembert/solvers/equilibrium/static_length.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/run/diagnosis.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <sstream>

namespace dalembert {

namespace {

/// In lengths of the scene: leaps over nothing.
constexpr double short_step = 0.1;
constexpr int most_corrections = 60, most_halvings = 6, most_descents = 2000;

RotatingFrame frame_of(double time, const UniformRotation<3>& turning, const Layout& layout) {
  const int dimension = layout.dimension;
  if (!std::isfinite(time)) throw InvalidArgument("Option time of an equilibrium must be finite");
  if (!turning.rate.allFinite() || !turning.centre.allFinite())
    throw InvalidArgument("Option turning of an equilibrium: rate and centre must be finite");
  if (dimension == 2 && turning.rate.head<2>().norm() > 0.0)
    throw InvalidArgument("Option turning of an equilibrium: a planar scene rotates about its normal only");
  return {layout, turning};
}

void require_frictionless(const System& system) {
  const auto refuse = [](const std::string& label, const char* why) {
    throw NoEquilibrium(
        label + why +
        "at rest friction takes any value up to its limit, and equilibria fill a region; leave "
        "it out to find the one without friction, or let a run come to rest");
  };
  if (system.forces().has_friction()) refuse(system.forces().owner_of_friction(0), " reads a multiplier: ");
  if (const auto rough = system.conditions().frictional_constraints(); !rough.empty())
    refuse(system.layout()->constraints[rough.front()].label(), ": ");
}

void require_bilateral(const System& system) {
  const auto label = system.conditional_label();
  if (label.empty()) return;
  for (const std::size_t c : system.conditions().released())
    throw InvalidScene("Equilibria of scene \"" + system.layout()->scene +
                       "\": " + system.layout()->constraints[c].label() +
                       " has been released and is not in force; put it back, or build the scene without it");
  throw InvalidScene("Equilibria of scene \"" + system.layout()->scene + "\": " + label +
                     " does not always hold; state it as a bilateral one, and check the sign of its force");
}

/// Of the guess, put onto the constraints. No run begins here; its time is that of a radian of rotation,
/// where there is one.
Start consistent_guess(const Problem& problem, std::span<const double> guess, double time,
                       const RotatingFrame& frame, double length, double longest) {
  const System& system = problem.system();
  require_frictionless(system);
  require_bilateral(system);
  std::vector<double> v(guess.size());
  frame.velocity(guess, v);
  const double duration = frame.rotates() ? 1.0 / frame.rate() : longest;
  Options options{.t_end = time + duration, .t_start = time, .assemble = true, .length = length};
  Start start = consistent_start(problem, guess, v, options);
  if (!start.scales.length_from_path) return start;
  options.length = static_length(system, frame, time, start.q, start.lambda);
  return consistent_start(problem, guess, v, options);
}

}  // namespace

EquilibriumSolver::EquilibriumSolver(const Problem& problem, std::span<const double> guess, double time,
                                     const UniformRotation<3>& turning, double length)
    : EquilibriumSolver(problem, guess, time, frame_of(time, turning, *problem.system().layout()), length) {}

EquilibriumSolver::EquilibriumSolver(const Problem& problem, std::span<const double> guess, double time,
                                     RotatingFrame frame, double length, double longest)
    : BalanceEquations(problem, time, frame, consistent_guess(problem, guess, time, frame, length, longest)) {
}

EquilibriumSolver EquilibriumSolver::measured_at(const State& s) const {
  EquilibriumSolver same = *this;
  same.measure_stiffness(s);
  return same;
}

EquilibriumSolver EquilibriumSolver::at_time(double t) const {
  EquilibriumSolver same = *this;
  same.set_time(t);
  return same;
}

/// A step (dq, dlambda) of (K + s M) dq - W^T dlambda = R1, W dq + C dlambda = -R2.
bool EquilibriumSolver::step(const State& s, std::span<const double> shift, std::vector<double>& x) const {
  const ActiveRows rows = rows_at(s);
  const LinearTerms terms = linear_terms(system(), frame(), {time(), s.q, s.v}, s.lambda);
  TangentMatrix matrix(system(), rows, terms, shift, tangent_);
  if (!matrix.regular()) return false;
  const std::size_t n = s.q.size();
  std::vector<double> y(n + rows.size());
  std::ranges::copy(s.force, y.begin());
  for (std::size_t a = 0; a < rows.holonomic; ++a) y[n + a] = -s.distance[rows.rows[a]];
  matrix.solve(y);
  x.assign(n + system().rows(), 0.0);
  std::copy_n(y.begin(), n, x.begin());
  for (std::size_t a = 0; a < rows.size(); ++a) x[n + rows.rows[a]] = y[n + a];
  return std::ranges::all_of(x, [](double value) { return std::isfinite(value); });
}

/// The largest part of a step, in units of the coordinates.
double EquilibriumSolver::lengths_of(const std::vector<double>& x) const {
  double most = 0.0;
  for (std::size_t i = 0; i < system().coordinates(); ++i)
    most = std::max(most, std::abs(x[i]) / scales().unit(i));
  return most;
}

/// The part of a step downhill that ends in the valley it leads into: where the forces have turned against
/// it, if they lead on again farther away. It is looked for at distances that grow; a short step leaps over
/// nothing.
double EquilibriumSolver::part_in_the_valley(const State& s, const std::vector<double>& x) const {
  constexpr double growth = 1.25;
  const double length = lengths_of(x);
  if (!(power(s, x) > 0.0)) return 1.0;
  double turned = 1.0;
  for (double part = short_step / length; part < growth; part *= growth) {
    try {
      const double there = power(moved(s, x, std::min(part, 1.0)), x);
      if (there < 0.0) turned = std::min(turned, part);
      if (there > 0.0 && turned < 1.0) return turned;
    } catch (const EquationFault&) {
      break;  // it is shortened for that later
    }
  }
  return 1.0;
}

/// The power of the forces in a state along a step.
double EquilibriumSolver::power(const State& s, const std::vector<double>& x) {
  return std::inner_product(s.force.begin(), s.force.end(), x.begin(), 0.0);
}

/// The state a part of a step away. Throws EquationFault.
EquilibriumSolver::State EquilibriumSolver::moved(const State& s, const std::vector<double>& x,
                                                  double part) const {
  const std::size_t n = s.q.size();
  State there = s;
  for (std::size_t i = 0; i < n; ++i) there.q[i] += part * x[i];
  for (std::size_t r = 0; r < there.lambda.size(); ++r) there.lambda[r] += part * x[n + r];
  evaluate(there);
  return there;
}

/// Line search: as far along a step as the residual falls enough, relative to the forces where the step
/// begins: where a single force acts on a particle the residual relative to its own would always be 1. A step
/// leaves curved constraints by its square, which may be more than the residual where the stiffness vanishes;
/// a short one then counts once it is back on them (Maratos effect: Nocedal, Wright, Numerical
/// Optimization, 15.5).
bool EquilibriumSolver::improve(State& s, const std::vector<double>& x) const {
  double fraction = part_in_the_valley(s, x);
  const bool is_short = fraction * lengths_of(x) <= short_step;
  const auto falls = [&](const State& next) {
    return relative_residual(next, s.acting) <
           (1.0 - constants.sufficient_decrease * fraction) * s.relative_residual;
  };
  for (int halving = 0; halving <= most_halvings; ++halving, fraction *= 0.5) {
    try {
      State next = moved(s, x, fraction);
      const bool left = next.relative_violation > s.relative_violation;
      if (!falls(next) && !(is_short && left && project(next) && falls(next))) continue;
      s = std::move(next);
      return true;
    } catch (const EquationFault&) {
      continue;
    }
  }
  return false;
}

/// Whether a step climbs against the forces without being near what it climbs to: by Newton and Kantorovich's
/// theorem it is, where a full step leaves less than a quarter of the residual; of a step longer than the
/// scene, whose end says less of what lies between, less by the square of its lengths.
bool EquilibriumSolver::leaps_uphill(const State& s, const std::vector<double>& x) const {
  if (power(s, x) >= 0.0 || s.round_off) return false;
  const double lengths = std::max(1.0, lengths_of(x));
  try {
    return relative_residual(moved(s, x, 1.0), s.acting) * lengths * lengths > 0.25 * s.relative_residual;
  } catch (const EquationFault&) {
    return true;
  }
}

void EquilibriumSolver::newton(State& s, std::span<const double> shift) const {
  std::vector<double> x;
  for (int i = 0; i < most_corrections && s.relative_residual > 0.0; ++i)
    if (!step(s, shift, x) || leaps_uphill(s, x) || !improve(s, x)) break;
}

/// Where that leaves more than round-off something may be softer than the shift: the stiffness is measured
/// anew there, and the least shift taken. So it is where the stiffness has fallen to 0 on the way, and what
/// was round-off beside that of the guess no longer is.
bool EquilibriumSolver::solve(State& s) const {
  newton(s, shift());
  const EquilibriumSolver here = measured_at(s);
  State closer = s;
  here.evaluate(closer);
  if (s.round_off && here.is_equilibrium(closer, residual_tolerance)) return true;
  here.newton(closer, here.least_shift());
  bool better = here.is_equilibrium(closer, residual_tolerance);
  evaluate(closer);
  better = better || (!s.round_off && is_equilibrium(closer, residual_tolerance));
  const bool balanced = better || s.round_off;
  if (better) s = std::move(closer);
  return balanced && measured_at(s).stays(s);
}

/// Whether the iteration stays where the forces have become round-off beside those elsewhere: a repulsion
/// that dies away with distance is balanced nowhere, and drives it on.
bool EquilibriumSolver::stays(const State& s) const {
  State on = s;
  evaluate(on);
  if (is_equilibrium(on, residual_tolerance)) return true;
  newton(on, least_shift());
  std::vector<double> x(s.q.size());
  std::ranges::transform(on.q, s.q, x.begin(), std::minus{});
  return lengths_of(x) <= short_step;
}

/// The largest part of Newton's correction, in units of the coordinates; infinite where it is the shift and
/// no stiffness that keeps it small.
double EquilibriumSolver::correction(const State& s) const {
  std::vector<double> x;
  if (s.relative_violation > residual_tolerance || !step(s, least_shift(), x))
    return std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    const double held = least_shift()[i] * system().masses()[i] * std::abs(x[i]);
    const double rounding = roundings_of_forces * epsilon * s.acting[i];
    if (held > 0.5 * std::abs(s.force[i]) + rounding) return std::numeric_limits<double>::infinity();
    most = std::max(most, std::abs(x[i]) / scales().unit(i));
  }
  return most;
}

bool EquilibriumSolver::is_equilibrium(const State& s, double close) const {
  if (s.relative_residual <= close) return true;
  const EquilibriumSolver here = measured_at(s);
  State now = s;
  here.evaluate(now);
  if (now.relative_residual <= close) return true;
  if (now.relative_violation <= close && here.is_round_off_of_its_terms(now)) return true;
  return here.correction(now) <= close;
}

bool EquilibriumSolver::project(State& s) const {
  Manifold manifold(problem(), rows_at(s), scales().lengths());
  const double close = 1e-12 * scales().length + scales().rounding(s.q);
  if (manifold.project_positions(time(), s.q, s.v, close).size >
      equilibrium_tolerance * scales().length + close)
    return false;
  frame().velocity(s.q, s.v);
  std::vector<double> v(s.v), a(s.q.size());
  if (!manifold.solve_motion(time(), s.q, v, a, s.lambda)) return false;
  evaluate(s);
  return true;
}

void EquilibriumSolver::descend(State& s) const {
  const double longest = constants.longest_descent * scales().length;
  double part = 1e6 * constants.no_stiffness;  // of the stiffest, as the shift
  std::vector<double> x, shift(s.q.size());
  std::string fault;
  for (int i = 0; i < most_descents; ++i, part *= 4.0) {
    std::ranges::transform(stiffest(), shift.begin(), [part](double k) { return part * k; });
    if (!step(s, shift, x)) continue;
    double length = 0.0;
    for (std::size_t k = 0; k < s.q.size(); ++k)
      length = std::max(length, std::abs(x[k]) * scales().length / scales().unit(k));
    if (!(power(s, x) > 0.0) || length > longest) continue;
    State next = s;
    for (std::size_t k = 0; k < s.q.size(); ++k) next.q[k] += x[k];
    try {
      if (!project(next)) continue;
    } catch (const EquationFault& beyond) {
      fault = beyond.what();
      continue;
    }
    s = std::move(next);
    State settled = s;
    if (solve(settled)) {
      s = std::move(settled);
      return;
    }
    part = std::max(part / 32.0, constants.no_stiffness);
  }
  refuse(s, "no equilibrium was found from this guess" + (fault.empty() ? "" : ", and beyond " + fault));
}

void EquilibriumSolver::refuse(const State& s, const std::string& why) const {
  const Layout& layout = *system().layout();
  std::size_t worst = 0;
  for (std::size_t i = 0; i < s.force.size(); ++i) {
    if (std::abs(s.force[i]) / system().masses()[i] > std::abs(s.force[worst]) / system().masses()[worst])
      worst = i;
  }
  std::ostringstream what;
  what << "Scene \"" << layout.scene << "\": " << why << "; ";
  const auto name = [&](const auto& all, std::size_t width) {
    for (const auto& one : all) {
      const auto first = static_cast<std::size_t>(one.coordinate);
      if (worst >= first && worst < first + width) what << '"' << one.name << '"';
    }
  };
  name(layout.particles, static_cast<std::size_t>(layout.dimension));
  name(layout.rotors, 1);
  what << " would still be accelerated by " << std::abs(s.force[worst]) / system().masses()[worst]
       << " there. ";
  const std::string jumps =
      force_that_jumps(system(), {time(), s.q, s.v}, worst, constants.longest_descent * scales().unit(worst));
  if (jumps.empty()) {
    what << "Start closer to an equilibrium, and hold what is free to fall or to run away";
  } else {
    what << "The force of " << jumps
         << " jumps there and drives it back from both sides: no place is in balance. Round the jump off";
  }
  throw NoEquilibrium(what.str());
}

/// Whether other multipliers balance a state: a bearing that does not turn with what it carries takes up the
/// load with one row, then with another.
bool EquilibriumSolver::has_other_multipliers(State& s) const {
  const std::vector<double> q = s.q;
  if (!project(s) || s.relative_residual > equilibrium_tolerance) return false;
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (std::abs(s.q[i] - q[i]) > equilibrium_tolerance * scales().unit(i)) return false;
  }
  return true;
}

/// What to do about a row that moves.
std::string EquilibriumSolver::remedy(std::size_t row) const {
  if (!frame().rotates() && row >= system().holonomic_rows())
    return "; its equation, which states velocities, is not 0 at rest there: start where it is, leave it "
           "out, "
           "or, if it is a drive, give the turning of that as an option";
  if (!frame().rotates() || system().layout()->dimension == 2)
    return "; give the turning of its drive as an option, or a scene whose constraints do not move";
  bool of_rotor = false;
  for (const std::size_t k : system().row(row))
    of_rotor =
        of_rotor || system().layout()->particle_at(static_cast<int>(system().w_columns()[k])) == nullptr;
  if (of_rotor)
    return "; in space rotors keep their angles while a scene turns: leave out what drives one, and hold "
           "what "
           "it carries to particles that the turning carries round";
  return "; the option turning must be that of its drive, with the same axis and sense";
}

/// An equilibrium persists; a state that is at rest only for an instant does not. The instants tried are no
/// likely fraction of a period.
void EquilibriumSolver::require_lasting(const State& s) const {
  const double t = frame().rotates() ? 1.0 / frame().rate() : scales().time;
  const auto lengths = scales().lengths();
  const double speed =
      std::max(frame().rotates() ? frame().rate() * scales().length : scales().speed(), largest(s.v));
  for (const double later : {0.0, 0.7390851332151607 * t, 2.6180339887498949 * t}) {
    State at = s;
    if (frame().moves()) frame().carry_positions(later, at.q);
    frame().velocity(at.q, at.v);
    auto e = system().evaluation();
    system().evaluate({time() + later, at.q, at.v}, e);
    const Violation moving = velocity_violation(system(), e, lengths);
    if (moving.size > start_tolerance * speed + scales().rounding(s.q) / t) {
      std::ostringstream what;
      what << system().row_label(moving.row) << " moves by " << moving.size << " at t = " << time() + later
           << (frame().rotates() ? " relative to the rotating frame" : ", where the scene is to be at rest")
           << remedy(moving.row);
      throw NoEquilibrium(what.str());
    }
    const EquilibriumSolver then = at_time(time() + later);
    then.evaluate(at);
    if (!then.is_equilibrium(at, equilibrium_tolerance) && !then.has_other_multipliers(at))
      then.refuse(at, frame().rotates()
                          ? "the forces or constraints do not turn with the scene"
                          : "the forces or constraints change with time, and so does the balance");
  }
}

std::shared_ptr<const Record> EquilibriumSolver::record(const State& found) const {
  State s = found;
  auto e = system().evaluation();
  system().evaluate({time(), s.q, s.v}, e);
  const ActiveRows rows = rows_at(s);
  std::vector<char> unique;
  if (rows.size() < system().rows()) {
    Manifold manifold(problem(), rows, scales().lengths());
    std::vector<double> v(s.v), v_rate(s.q.size());
    if (!manifold.solve_motion(time(), s.q, v, v_rate, s.lambda)) refuse(s, "the constraints are singular");
    unique.assign(manifold.unique().begin(), manifold.unique().end());
  }
  std::vector<double> a(s.q.size()), forces(system().layout()->slot_coordinate.size());
  frame().apply(s.v, a);
  system().constraint_forces(e.w, s.lambda, forces);
  const double energy = system().kinetic_energy(s.v) + system().forces().energy({time(), s.q, s.v}) +
                        system().elastic_energy(s.lambda);
  auto record = std::make_shared<Record>();
  record->layout = system().layout();
  record->statistics.length = scales().length;
  record->append({time(), s.q, s.v, a, s.lambda, forces, energy, unique});
  return record;
}

}  // namespace dalembert
