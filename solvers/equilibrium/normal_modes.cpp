#include "dalembert/solvers/equilibrium/normal_modes.h"

#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/equilibrium_solver.h>
#include <dalembert/solvers/equilibrium/higher_order.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/lowest_modes.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/equilibrium/reversible.h>
#include <dalembert/solvers/equilibrium/singular_position.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/violation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace dalembert {

namespace {

/// Whether there is another equilibrium a finite distance along the mode, not back where it began.
bool moves_freely(const EquilibriumSolver& balance, const FlatSample& at, const Mode& mode) {
  const double way = constants.free_displacement * balance.scales().length;
  EquilibriumSolver::State s = balance.start();
  std::ranges::copy(at.q, s.q.begin());
  std::vector<double> direction;
  for (std::size_t i = 0; i < at.q.size(); ++i) {
    direction.push_back(mode.shape[i].real());
    s.q[i] += way * direction[i];
  }
  if (!balance.project_and_solve(s)) return false;
  double along = 0.0, all = 0.0;
  for (std::size_t i = 0; i < at.q.size(); ++i) {
    const double m = balance.system().masses()[i];
    along += m * direction[i] * (s.q[i] - at.q[i]);
    all += m * direction[i] * direction[i];
  }
  return along > 0.5 * way * all;
}

/// Whether a mode is a displacement by symmetries, along all of which the motion is the same.
bool is_symmetric(const UniformMotion& motion, const Mode& mode) {
  Eigen::VectorXd u(static_cast<Eigen::Index>(mode.shape.size()));
  for (std::size_t i = 0; i < mode.shape.size(); ++i) u[static_cast<Eigen::Index>(i)] = mode.shape[i].real();
  if (motion.symmetric.cols() == 0) return false;
  const Eigen::MatrixXd rest =
      u - motion.symmetric * dense::least_squares(motion.symmetric, u, rank_threshold);
  return rest.norm() <= std::sqrt(rank_threshold) * u.norm();
}

/// u^T K u of a state, with the springs of compliant constraints.
double stiffness_along(const EquilibriumSolver& balance, const EquilibriumSolver::State& s,
                       std::span<const double> u) {
  const LinearTerms terms =
      linear_terms(balance.system(), balance.frame(), {balance.time(), s.q, s.v}, s.lambda);
  double sum = 0.0;
  for (const auto& k : terms.stiffness) sum += k.value() * u[k.row()] * u[k.col()];
  for (std::size_t r = 0; r < balance.system().rows(); ++r) {
    const double C = balance.system().law(r).compliance;
    if (C == 0.0) continue;
    const double elongation = row_times(balance.system(), terms.w, r, u);
    sum += elongation * elongation / C;
  }
  return sum;
}

/// Whether the stiffness along a mode exceeds its change within what a position is known to: the square root
/// of round-off, as for a bead at the turning point of a cubic, and farther where the forces still balance to
/// round-off, as about a column under its critical load.
bool is_known(const EquilibriumSolver& balance, const FlatSample& at, const Mode& mode) {
  std::vector<double> u;
  for (const auto& x : mode.shape) u.push_back(x.real());
  EquilibriumSolver::State here = balance.start();
  std::ranges::copy(at.q, here.q.begin());
  here.lambda.assign(at.lambda.begin(), at.lambda.end());
  balance.evaluate(here);
  const double own = stiffness_along(balance, here, u), length = balance.scales().length;
  for (const double side : {1.0, -1.0}) {
    for (double way = std::sqrt(epsilon) * length; way < length; way *= 2.0) {
      EquilibriumSolver::State s = here;
      for (std::size_t i = 0; i < u.size(); ++i) s.q[i] += side * way * u[i];
      if (!balance.project(s)) break;
      if (std::abs(stiffness_along(balance, s, u) - own) > std::abs(own)) return false;
      double force = 0.0, rounding = 0.0;
      for (std::size_t i = 0; i < u.size(); ++i) {
        force += s.force[i] * u[i];
        rounding += roundings_of_a_sum * epsilon * s.acting[i] * std::abs(u[i]);
      }
      if (std::abs(force) > rounding) break;
    }
  }
  return true;
}

/// Whether nothing but the stiffness makes the eigenvalues.
bool are_of_stiffness(const System& system, const LinearTerms& terms) {
  bool all = std::ranges::all_of(terms.damping, [](const auto& d) { return d.value() == 0.0; });
  for (std::size_t r = system.holonomic_rows(); r < system.rows(); ++r)
    for (const std::size_t k : system.row(r)) all = all && terms.e[k] == 0.0;
  return all;
}

/// What is not known counts as 0, to be decided by a finite motion.
void drop_unknown(const EquilibriumSolver& balance, const FlatSample& at, Modes& found) {
  bool dropped = false;
  for (Mode& mode : found.modes) {
    if (mode.eigenvalue == 0.0 || is_known(balance, at, mode)) continue;
    mode.eigenvalue = 0.0;
    dropped = true;
  }
  const bool grows =
      std::ranges::any_of(found.modes, [](const Mode& m) { return m.eigenvalue.real() > 0.0; });
  if (!dropped || found.stability != Stability::unstable || grows) return;
  found.stability = Stability::stable;
  found.reason = "every mode decays or vibrates with positive energy";
}

void leave_undecided(Modes& found, std::string why) {
  if (found.stability != Stability::stable) return;
  found.stability = Stability::undecided;
  found.reason = std::move(why);
}

/// What an energy of linear terms proves holds only if no force adds to it near the equilibrium.
void require_no_work(const NearEquilibrium& near, const std::function<bool(std::size_t)>& stable_otherwise,
                     Modes& found) {
  if (found.stability != Stability::stable) return;
  const auto forces = near.problem.system().coordinates() > most_dense ? near.violations_of_many(found.modes)
                                                                       : near.violations(found.modes);
  for (std::size_t part = 0; part < forces.size(); ++part)
    if (!forces[part].empty() && !stable_otherwise(part))
      leave_undecided(found, "some modes do not decay, and beside the equilibrium " + forces[part] +
                                 ", which has no potential, does work: terms of higher order decide");
}

/// The uncoupled part of a scene that a mode belongs to.
std::size_t part_of(const Mode& mode, const Islands& parts) {
  const auto size = [](const std::complex<double>& x) { return std::abs(x); };
  const auto most = std::ranges::max_element(mode.shape, {}, size);
  return parts.of_coordinate[static_cast<std::size_t>(most - mode.shape.begin())];
}

/// Classifies the eigenvalues 0, with what they mean for the verdict.
void name_zeros(const EquilibriumSolver& balance, const FlatSample& at, const UniformMotion* motion,
                const std::function<bool(const Mode&)>& stable_otherwise, Modes& found) {
  bool all_decided = true;
  for (Mode& mode : found.modes) {
    if (mode.eigenvalue != 0.0) continue;
    try {
      mode.free = (motion != nullptr && is_symmetric(*motion, mode)) || moves_freely(balance, at, mode);
    } catch (const EquationFault&) {
      mode.free = false;
    }
    all_decided = all_decided && (mode.free || stable_otherwise(mode));
  }
  if (!all_decided)
    leave_undecided(found, "a mode of eigenvalue 0 is no free motion: terms of higher order decide");
}

/// Round-off beside something very stiff may leave nothing of the lowest modes of a large scene.
void require_told_from_zero(const System& system, const Modes& found) {
  const bool told =
      std::ranges::all_of(found.modes, [](const Mode& m) { return m.eigenvalue != 0.0 || m.free; });
  if (told) return;
  throw InvalidScene(
      "Normal modes of scene \"" + system.layout()->scene +
      "\": the lowest eigenvalues are below the round-off of the largest; leave out what is stiff "
      "and does not act on them, or make it rigid");
}

void require_smooth(const System& system, const FlatSample& at) {
  if (system.coordinates() > most_dense || !is_singular_position(system, {at.time, at.q, at.v})) return;
  throw InvalidScene(
      "Normal modes of scene \"" + system.layout()->scene +
      "\": the equilibrium is a singular position, where the constraints are linearly dependent but not "
      "redundant and leave several paths; linear equations do not describe the small motions");
}

[[noreturn]] void refuse_changed(const System& system, const std::string& why) {
  throw InvalidArgument("This equilibrium is not one of scene \"" + system.layout()->scene +
                        "\" as it is now: " + why + "; the scene has been changed since, so find it anew");
}

void require_same_size(const System& system, const FlatSample& at) {
  if (at.q.size() != system.coordinates())
    refuse_changed(system, "it has " + std::to_string(at.q.size()) + " coordinates, the scene " +
                               std::to_string(system.coordinates()));
  if (at.lambda.size() != system.rows())
    refuse_changed(system, "it has " + std::to_string(at.lambda.size()) + " multipliers, the scene " +
                               std::to_string(system.rows()));
}

/// What round-off of elongations makes of forces on each coordinate, through springs of compliant rows and
/// constraints beside them. These pass on no more of a force, in the metric of the masses, than there is (by
/// Gauss's principle).
std::vector<double> round_off_of_springs(const Islands& parts, const EquilibriumSolver& balance,
                                         const EquilibriumSolver::State& s, std::span<const double> w) {
  const System& system = balance.system();
  const Scales& scales = balance.scales();
  const auto lengths = scales.lengths();
  const double dx = roundings_of_forces * epsilon * scales.length + scales.rounding(s.q);
  std::vector<double> forces(s.q.size()), squares(parts.count);
  for (std::size_t r = 0; r < system.rows(); ++r) {
    if (!system.law(r).compliant()) continue;
    const double lambda = gradient_length(system, w, lengths, r) * dx / system.law(r).compliance;
    for (const std::size_t k : system.row(r)) forces[system.w_columns()[k]] += std::abs(w[k]) * lambda;
  }
  for (std::size_t i = 0; i < forces.size(); ++i)
    squares[parts.of_coordinate[i]] += forces[i] * forces[i] / system.masses()[i];
  for (std::size_t i = 0; i < forces.size(); ++i)
    forces[i] = std::sqrt(system.masses()[i] * squares[parts.of_coordinate[i]]);
  return forces;
}

/// Whether the multipliers of `s` are not those which its forces ask for, `fresh`, but of other forces or
/// masses. What no multipliers balance is no fault of theirs, nor what is `round_off`.
bool are_of_other_forces(const System& system, const EquilibriumSolver::State& s,
                         std::span<const double> fresh, std::span<const double> w,
                         std::span<const double> round_off) {
  std::vector<double> excess(s.q.size());
  for (std::size_t r = 0; r < system.rows(); ++r) add_row(system, w, r, s.lambda[r] - fresh[r], excess);
  double unbalanced = 0.0;
  for (std::size_t i = 0; i < excess.size(); ++i)
    unbalanced = std::max(unbalanced, std::abs(s.force[i] - excess[i]));
  for (std::size_t i = 0; i < excess.size(); ++i)
    if (std::abs(excess[i]) > equilibrium_tolerance * s.acting[i] + unbalanced + round_off[i]) return true;
  return false;
}

/// Throws unless forces balance there, constraints are satisfied and nothing moves against them, as when it
/// was found.
void require_equilibrium(const Islands& parts, const EquilibriumSolver& balance, const FlatSample& at) {
  const System& system = balance.system();
  EquilibriumSolver::State s = balance.start();
  const std::vector<double> fresh = s.lambda;
  s.q.assign(at.q.begin(), at.q.end());
  s.lambda.assign(at.lambda.begin(), at.lambda.end());
  balance.evaluate(s);
  auto e = system.evaluation();
  system.evaluate({balance.time(), at.q, at.v}, e);
  std::ostringstream why;
  const auto round_off = round_off_of_springs(parts, balance, s, e.w);
  if (!balance.is_equilibrium(s, equilibrium_tolerance) ||
      are_of_other_forces(system, s, fresh, e.w, round_off))
    why << "forces or constraints have a relative residual of " << s.relative_residual;
  const Scales& scales = balance.scales();
  const double time = balance.frame().rotates() ? 1.0 / balance.frame().rate() : scales.time;
  const Violation moving = velocity_violation(system, e, scales.lengths());
  if (moving.size >
      start_tolerance * std::max(scales.length / time, largest(at.v)) + scales.rounding(s.q) / time)
    why << system.row_label(moving.row) << " moves by " << moving.size;
  if (!why.str().empty()) refuse_changed(system, why.str());
}

/// What K + s M and the constraints answer to the forces M u + C u and, in nonholonomic rows, -E u. (Not the
/// rows of W themselves: those of a sleeve on an axis need not turn, the axis does.)
std::vector<double> response(const System& system, const LinearTerms& terms, double s,
                             std::span<const double> u) {
  const ActiveRows rows = independent_rows(system, terms.w);
  const std::size_t n = u.size();
  std::vector<double> out(n + rows.size(), 0.0);
  for (std::size_t i = 0; i < n; ++i) out[i] = system.masses()[i] * u[i];
  for (const auto& entry : terms.damping) out[entry.row()] += entry.value() * u[entry.col()];
  for (std::size_t a = rows.holonomic; a < rows.size(); ++a) {
    for (const std::size_t k : system.row(rows.rows[a])) out[n + a] -= terms.e[k] * u[system.w_columns()[k]];
  }
  TangentMatrix matrix(system, rows, terms, s);
  if (matrix.regular()) matrix.solve(out);
  out.resize(n);
  return out;
}

/// A displacement that the constraints allow: what is asked of the equations outside of their tangent space,
/// as how a rolling condition reads a stretched wheel, is no part of them.
std::vector<double> allowed(const System& system, const LinearTerms& terms, double s, std::vector<double> u) {
  const ActiveRows rows = independent_rows(system, terms.w);
  const std::size_t n = u.size();
  for (std::size_t i = 0; i < n; ++i) u[i] *= s * system.masses()[i];
  u.resize(n + rows.size(), 0.0);
  TangentMatrix matrix(system, rows, terms, s);
  if (matrix.regular()) matrix.solve(u);
  u.resize(n);
  return u;
}

/// K where everything is displaced by u.
LinearTerms::Entries displaced_stiffness(const EquilibriumSolver& balance, const FlatSample& at,
                                         std::span<const double> u, double part) {
  std::vector<double> q(at.q.begin(), at.q.end()), v(q.size());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += part * u[i];
  balance.frame().velocity(q, v);
  return linear_terms(balance.system(), balance.frame(), {at.time, q, v}, at.lambda).stiffness;
}

/// Throws where a force has a kink: on its two sides the stiffness is another, however near they are. What is
/// smooth differs in proportion to the distance.
void require_no_kink(const EquilibriumSolver& balance, const FlatSample& at, const LinearTerms& terms) {
  const System& system = balance.system();
  std::vector<double> u(at.q.size()), largest_of_row(at.q.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::sin(static_cast<double>(i + 1));
  u = allowed(system, terms, balance.high_stiffness(), std::move(u));
  const double most = largest(u), rounding = std::sqrt(epsilon);
  if (most == 0.0) return;
  for (double& x : u) x *= rounding * balance.scales().length / most;
  LinearTerms::Entries before, behind, near_before, near_behind;
  try {
    before = displaced_stiffness(balance, at, u, -1.0), behind = displaced_stiffness(balance, at, u, 1.0);
    near_before = displaced_stiffness(balance, at, u, -1.0 / 16.0);
    near_behind = displaced_stiffness(balance, at, u, 1.0 / 16.0);
  } catch (const EquationFault&) {
    return;  // as beside the only point where an equation is defined
  }
  for (const auto* side : {&near_before, &near_behind})
    for (const auto& k : *side)
      largest_of_row[k.row()] = std::max(largest_of_row[k.row()], std::abs(k.value()));
  balance.share_by_particle(largest_of_row);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const std::size_t row = before[k].row();
    const double jump = std::abs(near_behind[k].value() - near_before[k].value());
    if (jump <= rounding * terms.roundings * largest_of_row[row] ||
        jump <= 0.5 * std::abs(behind[k].value() - before[k].value()))
      continue;
    throw InvalidScene("Normal modes of scene \"" + system.layout()->scene +
                       "\": " + system.layout()->label_of_coordinate(static_cast<int>(row)) +
                       " is held by forces that have a kink at the equilibrium, with another stiffness on "
                       "either side: small motions have no linear equations there; run them");
  }
}

/// Throws unless the equations of small motions are the same later, in the rotating frame.
void require_constant(const System& system, const EquilibriumSolver& balance, const FlatSample& at,
                      const LinearTerms& terms) {
  const RotatingFrame& frame = balance.frame();
  std::vector<double> u(at.q.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::sin(static_cast<double>(i + 1));
  const double s = balance.high_stiffness();
  u = allowed(system, terms, s, std::move(u));
  auto expected = response(system, terms, s, u);
  const double unit = frame.rotates() ? 1.0 / frame.rate() : balance.scales().time;
  const double later = 0.7390851332151607 * unit;
  std::vector<double> q(at.q.begin(), at.q.end()), v(q.size());
  if (frame.moves()) {
    for (const std::span<double> x : {std::span(u), std::span(expected)}) frame.carry_vectors(later, x);
    frame.carry_positions(later, q);
  }
  frame.velocity(q, v);
  EquilibriumSolver::State then = balance.start();
  then.q = q;
  then.lambda.assign(at.lambda.begin(), at.lambda.end());
  balance.evaluate(then);
  // The rods of a body that spins carry its loads by turns.
  const bool same_loads = system.rheonomic() || then.round_off;  // drives turn with the whole scene
  if (frame.moves() && !same_loads && !balance.project(then)) then.lambda = balance.start().lambda;
  const auto found =
      response(system, linear_terms(system, frame, {at.time + later, q, v}, then.lambda), s, u);
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    difference = std::max(difference, std::abs(found[i] - expected[i]));
    size = std::max(size, std::abs(expected[i]));
  }
  if (difference <= equilibrium_tolerance * size) return;
  throw InvalidScene(
      "Normal modes of scene \"" + system.layout()->scene +
      "\": its forces or constraints change with time in the " + (frame.rotates() ? "rotating" : "resting") +
      " frame; find the equilibrium for the turning of its drives, or ask for floquet multipliers");
}

/// What the parts of a body are named after: its rods are internal constraints "body.rod12", its particles
/// "body.p1".
std::set<std::string> names_of_bodies(const Layout& layout) {
  std::set<std::string> names;
  for (const auto& constraint : layout.constraints) {
    const auto dot = constraint.name.rfind('.');
    if (constraint.internal && dot != std::string::npos) names.insert(constraint.name.substr(0, dot));
  }
  return names;
}

std::string name_with_body(const std::string& particle, const std::set<std::string>& bodies) {
  const auto dot = particle.rfind('.');
  const std::string body = particle.substr(0, dot);
  return dot != std::string::npos && bodies.contains(body) ? body : particle;
}

}  // namespace

const char* name(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::unstable:
      return "unstable";
    case Stability::undecided:
      break;
  }
  return "undecided";
}

Modes find_modes(const System& system, const Record& state, const UniformRotation<3>& turning,
                 const ModesOptions& options, const UniformMotion* motion) {
  const FlatSample at = state.sample(0);
  require_same_size(system, at);
  const Problem problem(system);
  const double length = state.statistics.length;
  const EquilibriumSolver balance =
      motion ? EquilibriumSolver(problem, at.q, at.time, RotatingFrame(*motion), length)
             : EquilibriumSolver(problem, at.q, at.time, turning, length);
  require_equilibrium(problem.islands(), balance, at);
  require_smooth(system, at);
  const double roundings = balance.scales().roundings_of_difference(at.q);
  const LinearTerms terms =
      linear_terms(system, balance.frame(), {at.time, at.q, at.v}, at.lambda, roundings);
  require_constant(system, balance, at, terms);
  require_no_kink(balance, at, terms);
  std::optional<ReversibleMotion> reversible;
  if (motion != nullptr) reversible.emplace(problem, at, *motion);
  std::vector<char> attracting(problem.islands().count);
  if (motion != nullptr) attracting = attracting_parts(system, terms, *motion);
  const auto stays = [&](std::size_t part) {
    return attracting[part] != 0 || (reversible && reversible->is_stable(part));
  };
  Modes found;
  if (system.coordinates() <= most_dense) {
    found = dense_modes(system, terms, motion, stays);
  } else {
    found = lowest_modes(system, terms, options.lowest);
    if (!found.modes.empty() && found.modes.back().eigenvalue == 0.0)
      leave_undecided(found, "all modes that were asked for have the eigenvalue 0: there may be more");
  }
  if (are_of_stiffness(system, terms) && system.coordinates() <= most_dense) drop_unknown(balance, at, found);
  const auto own_part_stays = [&](const Mode& mode) { return stays(part_of(mode, problem.islands())); };
  name_zeros(balance, at, motion, own_part_stays, found);  // all that were found: the verdict is of all
  require_no_work({problem, balance, at, terms}, stays, found);
  if (found.stability == Stability::stable && std::ranges::count(attracting, 1) > 0)
    found.reason =
        "every mode decays, vibrates with positive energy, or carries the motion along a symmetry of the "
        "scene";
  if (found.stability == Stability::stable && reversible && reversible->decided())
    found.reason =
        "every mode decays, vibrates with positive energy, or stays near since the motion is its own mirror "
        "image run backwards, as are those about it";
  if (system.coordinates() > most_dense) require_told_from_zero(system, found);
  if (options.lowest > 0 && options.lowest < found.modes.size()) found.modes.resize(options.lowest);
  return found;
}

template <int D>
const Mode& NormalModes<D>::mode(std::size_t k) const {
  if (k < size()) return modes_.modes[k];
  throw InvalidArgument("There is no mode " + std::to_string(k) + ": of scene \"" + layout_->scene +
                        "\" there are " + std::to_string(size()));
}

template <int D>
std::string NormalModes<D>::describe() const {
  std::ostringstream text;
  text << name(stability()) << ": " << modes_.reason;
  const auto bodies = names_of_bodies(*layout_);
  for (std::size_t k = 0; k < size(); ++k) {
    if (!is_free(k)) continue;
    text << "; free motion of";
    std::string last;  // the particles of a body follow each other
    const auto add = [&](const std::string& one, int first, int width) {
      bool moves = false;
      for (int i = first; i < first + width; ++i)
        moves = moves || std::abs(modes_.modes[k].shape[static_cast<std::size_t>(i)]) > 0.5;
      if (moves && std::exchange(last, one) != one) text << " \"" << one << '"';
    };
    for (const auto& particle : layout_->particles)
      add(name_with_body(particle.name, bodies), particle.coordinate, D);
    for (const auto& rotor : layout_->rotors) add(rotor.name, rotor.coordinate, 1);
  }
  if (!note_.empty()) text << "; " << note_;
  return text.str();
}

namespace detail {

bool same_elements(const Layout& a, const Layout& b) {
  if (a.id == b.id) return true;
  const auto same = [](const auto& x, const auto& y) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(x.size(), y.size()));
    return std::equal(x.begin(), x.begin() + count, y.begin(),
                      [](const auto& p, const auto& q) { return p.scene == q.scene && p.name == q.name; });
  };
  return same(a.particles, b.particles) && same(a.rotors, b.rotors) && same(a.constraints, b.constraints) &&
         a.particles.size() + a.rotors.size() > 0;
}

}  // namespace detail

template class NormalModes<2>;
template class NormalModes<3>;

}  // namespace dalembert
