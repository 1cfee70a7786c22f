#include "dalembert/solvers/manifold/recovery.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/spring_noise.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dalembert {

namespace {

constexpr double undetermined = std::numeric_limits<double>::quiet_NaN();

}  // namespace

OutputState::OutputState(const System& system, const Start& start, bool changes)
    : q(start.q),
      v(start.v),
      a(start.a),
      lambda(start.lambda),
      forces(system.layout()->slot_coordinate.size()) {
  if (changes || start.rows.size() < system.rows_in_force() ||
      !system.conditions().conditional_constraints().empty())
    unique.resize(lambda.size());
}

Recovery::Recovery(const Problem& problem, const Start& start, double tolerance)
    : problem_(problem),
      system_(&problem_.system()),
      scales_(start.scales),
      lengths_(start.scales.lengths()),
      accuracy_(tolerance),
      left_out_(problem.islands().count),
      q_given_(start.q.size()),
      v_given_(start.q.size()),
      q_(start.q),
      v_(start.q),
      a_(start.q),
      lambda_(start.lambda),
      n_(start.q.size()),
      w_(system_->w_columns().size()),
      response_(problem.islands().count) {}

/// Per island, the largest violation of any row that is stated.
std::vector<double> Recovery::violations(const std::vector<double>& residual,
                                         std::span<const double> w) const {
  std::vector<double> worst(left_out_.size());
  for (std::size_t r = 0; r < residual.size(); ++r) {
    if (residual[r] == 0.0 || system_->law(r).compliant()) continue;
    double& own = worst[problem_.islands().of_row(*system_, r)];
    own = std::max(own, std::abs(residual[r]) / gradient_length(*system_, w, lengths_, r));
  }
  return worst;
}

/// A state moved by more than the tolerance is not better for it, if that is the constraints' doing: if it
/// obeyed them, all that are stated, much better than it was moved.
void Recovery::find_moved_too_far(const OutputState& m) {
  std::vector<double> far(left_out_.size()), fast(left_out_.size());
  for (std::size_t i = 0; i < m.q.size(); ++i) {
    const std::size_t island = problem_.islands().of_coordinate[i];
    const double speed = scales_.unit(i) / scales_.time + std::abs(v_given_[i]);
    const double dq = std::abs(m.q[i] - q_given_[i]), dv = std::abs(m.v[i] - v_given_[i]);
    far[island] = std::max(far[island], dq * lengths_[i]);
    fast[island] = std::max(fast[island], dv * lengths_[i]);
    if (dq > scales_.position_error(i, q_given_[i], accuracy_.of_positions()) ||
        dv > accuracy_.of_velocities() * speed)
      left_out_[island] = 1;
  }
  if (!std::ranges::count(left_out_, 1)) return;
  auto e = system_->evaluation();
  system_->evaluate({m.t, q_given_, v_given_}, e);
  const auto distance = violations(e.g, e.w);
  system_->evaluate({m.t, m.q, v_given_}, e);
  const auto speed = violations(e.psi, e.w);
  for (std::size_t island = 0; island < left_out_.size(); ++island) {
    const double w = constants.well_conditioned;
    if (w * far[island] <= distance[island] && w * fast[island] <= speed[island]) left_out_[island] = 0;
  }
}

/// What the constraints do not determine here stays as it was given.
void Recovery::project(Manifold& manifold, OutputState& m) {
  const double L = scales_.length;
  std::ranges::copy(m.q, q_given_.begin());
  std::ranges::copy(m.v, v_given_.begin());
  std::ranges::fill(left_out_, 0);
  m.position = manifold.project_positions(
      m.t, m.q, m.v, std::max(constants.output_distance * L, 0.1 * scales_.rounding(m.q)));
  if (!manifold.solve_motion(m.t, m.q, m.v, m.a, m.lambda)) {
    std::ranges::fill(left_out_, 1);
  } else if (manifold.sine() <= constants.well_conditioned) {
    find_moved_too_far(m);
  }
  any_left_out_ = std::ranges::count(left_out_, 1) > 0;

  if (any_left_out_) keep_given(manifold, m);
}

/// But not a state that is off its constraints by more than steps may leave unnoticed.
void Recovery::keep_given(Manifold& manifold, OutputState& m) {
  const auto put = [&](const std::vector<double>& q, const std::vector<double>& v) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      if (!left_out_[problem_.islands().of_coordinate[i]]) continue;
      m.q[i] = q[i];
      m.v[i] = v[i];
    }
    (void)manifold.sine({m.t, m.q, m.v});
    m.position = position_violation(*system_, manifold.equations(), lengths_);
  };
  q_ = m.q;
  v_ = m.v;
  put(q_given_, v_given_);
  if (m.position.size > unnoticed()) put(q_, v_);
}

/// How far steps may leave the constraints unnoticed.
double Recovery::unnoticed() const {
  return constants.most_correction * accuracy_.of_positions() * scales_.length;
}

void Recovery::require_agreement(const OutputState& m) const {
  const auto refuse = [&](const Violation& left, const char* what) {
    std::ostringstream text;
    text << system_->row_label(left.row) << " contradicts the other constraints: it is violated by " << what
         << left.size << "; remove or correct one of those that act on the same points";
    throw StepFailure{text.str(), m.t};
  };
  const double tolerated = constants.tolerated_contradiction * scales_.length + scales_.rounding(m.q) +
                           (any_left_out_ ? unnoticed() : 0.0);
  if (m.position.size > tolerated) refuse(m.position, "");
}

void Recovery::require_finite(const OutputState& m) const {
  const auto& coordinates = system_->layout()->slot_coordinate;
  bool finite = std::isfinite(m.energy);
  for (std::size_t slot = 0; slot < coordinates.size(); ++slot) {
    const auto i = static_cast<std::size_t>(coordinates[slot]);
    finite = finite && (left_out_[problem_.islands().of_coordinate[i]] || std::isfinite(m.forces[slot]));
  }
  if (finite) return;
  throw StepFailure{
      "the energy or a force of constraint exceeds what double precision holds; choose units in which "
      "masses, lengths and speeds are closer to 1",
      m.t};
}

/// Those of the islands that are left out.
void Recovery::leave_forces_out(OutputState& m) const {
  const auto coordinate = [this](std::size_t i) {
    return left_out_[problem_.islands().of_coordinate[i]] != 0;
  };
  for (std::size_t i = 0; i < m.a.size(); ++i)
    if (coordinate(i)) m.a[i] = undetermined;
  for (std::size_t r = 0; r < m.lambda.size(); ++r)
    if (left_out_[problem_.islands().of_row(*system_, r)]) m.lambda[r] = undetermined;
  for (std::size_t slot = 0; slot < m.forces.size(); ++slot) {
    if (coordinate(static_cast<std::size_t>(system_->layout()->slot_coordinate[slot])))
      m.forces[slot] = undetermined;
  }
}

/// Those that differ by as much as a force may not, relative to the largest that there is or that a force of
/// constraint alone would give.
void Recovery::mark_accelerations(OutputState& m) const {
  double largest = 0.0;
  const auto& coordinates = system_->layout()->slot_coordinate;
  for (std::size_t slot = 0; slot < coordinates.size(); ++slot) {
    const auto i = static_cast<std::size_t>(coordinates[slot]);
    largest = std::max(largest, std::abs(m.forces[slot]) / system_->masses()[i] * lengths_[i]);
  }
  for (std::size_t i = 0; i < a_.size(); ++i) largest = std::max(largest, std::abs(m.a[i]) * lengths_[i]);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    if (!(std::abs(a_[i] - m.a[i]) * lengths_[i] <= accuracy_.of_accelerations() * largest))
      m.a[i] = undetermined;
  }
}

/// Compares with a second state, see Recovery.
void Recovery::mark_undetermined(Manifold& manifold, OutputState& m) {
  std::ranges::copy(manifold.equations().w, w_.begin());
  manifold.weakest_directions(n_, response_);
  const double untold = std::max(m.position.size, scales_.rounding(m.q));
  for (std::size_t i = 0; i < n_.size(); ++i) {
    const double response = response_[problem_.islands().of_coordinate[i]];
    q_[i] = m.q[i] + (response > 0.0 ? untold / response * n_[i] : 0.0);
    v_[i] = m.v[i];
  }
  bool known = true;
  try {
    known = manifold.solve_motion(m.t, q_, v_, a_, lambda_);
  } catch (const EquationFault&) {
    known = false;
  }
  if (!known) {
    std::ranges::fill(left_out_, 1);
    return leave_forces_out(m);
  }
  mark_accelerations(m);
  while (mark_multipliers(m)) {
  }
}

/// Those that differ by as much as a force may not, relative to the largest that is determined: of a linkage
/// in line unbounded forces are no reference. Whether there are any.
bool Recovery::mark_multipliers(OutputState& m) const {
  const auto force = [&](std::size_t r, double lambda) {
    return std::abs(lambda) * gradient_length(*system_, w_, lengths_, r);
  };
  double largest = 0.0;
  for (std::size_t r = 0; r < lambda_.size(); ++r) largest = std::max(largest, force(r, m.lambda[r]));
  bool any = false;
  for (const Layout::Constraint& c : system_->layout()->constraints) {
    for (const std::size_t r : c.own_rows()) {
      if (std::isnan(m.lambda[r]) || force(r, lambda_[r] - m.lambda[r]) <= accuracy_.of_forces() * largest)
        continue;
      m.lambda[r] = undetermined;
      std::ranges::fill(c.slots().in(std::span(m.forces)), undetermined);
      any = true;
    }
  }
  return any;
}

/// Of constraint, inertia or forces on any coordinate, as forces on lengths.
double Recovery::largest_force(const Manifold& manifold, const OutputState& m) const {
  const auto& [force, g, psi, w] = manifold.equations();
  double largest = 0.0;
  for (std::size_t r = 0; r < m.lambda.size(); ++r)
    largest = std::max(largest, std::abs(m.lambda[r]) * gradient_length(*system_, w, lengths_, r));
  for (std::size_t i = 0; i < m.a.size(); ++i)
    largest = std::max(
        {largest, system_->masses()[i] * std::abs(m.a[i]) / lengths_[i], std::abs(force[i]) / lengths_[i]});
  return largest;
}

/// Per row, how far its spring will be stretched in the scene's time, by its rate and, where that is
/// determined, its acceleration.
std::vector<double> Recovery::stretches_to_come(const OutputState& m) const {
  auto e = system_->evaluation();
  std::vector<double> gamma(m.lambda.size()), stretches(gamma);
  const Instant at{m.t, m.q, m.v};
  system_->evaluate_with_bias(at, e, gamma);
  const double T = scales_.time;
  for (std::size_t r = 0; r < stretches.size(); ++r) {
    for (const std::size_t k : system_->row(r)) gamma[r] += e.w[k] * m.a[system_->w_columns()[k]];
    stretches[r] =
        std::abs(e.psi[r]) * T + (std::isfinite(gamma[r]) ? 0.5 * std::abs(gamma[r]) * T * T : 0.0);
  }
  return stretches;
}

/// How far positions are off after so many steps: by a rounding of what was stated, and as each step adds
/// some more and nothing damps a vibration they wander, sqrt(n) steps' far after n steps.
double Recovery::wander(const OutputState& m, long steps) const {
  return scales_.largest_rounding(m.q) + std::sqrt(static_cast<double>(steps)) * scales_.rounding(m.q);
}

/// Whether nothing moves, and nothing acts but springs and compliant constraints at their natural lengths,
/// whose forces are round-off: then there is no force to which others are relative, and each is 0 to the
/// rounding of a stretch.
bool Recovery::rests_unloaded(const Manifold& manifold, const OutputState& m, long steps) const {
  const auto& [force, g, psi, w] = manifold.equations();
  const double dx = wander(m, steps);
  if (scales_.largest(m.v) * scales_.length * scales_.time > dx) return false;
  for (std::size_t r = 0; r < m.lambda.size(); ++r) {
    const double C = system_->law(r).compliance;
    const double none = gradient_length(*system_, w, lengths_, r) * (dx + 10.0 * epsilon * scales_.length);
    if (C > 0.0 && std::abs(m.lambda[r]) * C > none) return false;
  }
  if (std::ranges::all_of(force, [](double F) { return F == 0.0; })) return true;
  const auto noise = spring_noise(*system_, scales_, {m.t, m.q, m.v});
  return std::ranges::equal(force, noise, [](double F, double none) { return std::abs(F) <= none; });
}

/// The force of a spring of stiffness 1/C is off by dx/C where positions are off by dx. As elsewhere a force
/// may be wrong by the root of the tolerance, relative to the largest that there is; at the start, where
/// there may be none yet, also to what its own will be.
void Recovery::mark_compliant(const Manifold& manifold, OutputState& m, long steps) const {
  const auto& w = manifold.equations().w;
  const double dx = wander(m, steps);
  const double largest = largest_force(manifold, m);
  const auto to_come = steps == 0 ? stretches_to_come(m) : std::vector<double>{};
  for (const Layout::Constraint& c : system_->layout()->constraints) {
    for (const std::size_t r : c.own_rows()) {
      const double C = system_->law(r).compliance;
      if (C == 0.0 || !system_->in_force(r)) continue;
      const double gradient = gradient_length(*system_, w, lengths_, r);
      const double stretch = largest * C + gradient * (to_come.empty() ? 0.0 : to_come[r]);
      if (gradient * gradient * dx <= accuracy_.of_forces() * stretch) continue;
      m.lambda[r] = undetermined;
      std::ranges::fill(c.slots().in(std::span(m.forces)), undetermined);
      for (const std::size_t j : system_->row(r)) m.a[system_->w_columns()[j]] = undetermined;
    }
  }
}

void Recovery::recover(Manifold& manifold, OutputState& m, long steps) {
  project(manifold, m);
  require_agreement(m);
  if (!m.unique.empty()) std::ranges::copy(manifold.unique(), m.unique.begin());
  system_->constraint_forces(manifold.equations().w, m.lambda, m.forces);
  m.velocity = velocity_violation(*system_, manifold.equations(), lengths_);
  m.correction = 0.0;
  for (std::size_t i = 0; i < q_given_.size(); ++i)
    m.correction = std::max(m.correction, std::abs(m.q[i] - q_given_[i]) * lengths_[i]);
  m.energy = system_->kinetic_energy(m.v) + system_->forces().energy({m.t, m.q, m.v});
  if (system_->compliant()) m.energy += system_->elastic_energy(m.lambda);
  require_finite(m);
  leave_forces_out(m);
  if (std::ranges::count(left_out_, 0)) mark(manifold, m, steps);
  if (system_->forces().any_slides()) system_->forces().exert_sliding({m.t, m.q, m.v}, m.lambda, m.forces);
}

void Recovery::mark(Manifold& manifold, OutputState& m, long steps) {
  const bool close = manifold.sine() <= constants.well_conditioned;
  const bool read = system_->compliant() && !manifold.uses_given_multipliers();
  const bool unloaded = (close || read) && rests_unloaded(manifold, m, steps);
  if (close && (system_->rheonomic() || !unloaded)) mark_undetermined(manifold, m);  // drives may accelerate
  if (read && !unloaded) mark_compliant(manifold, m, steps);
}

}  // namespace dalembert
