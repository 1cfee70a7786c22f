#include "dalembert/solvers/run/compared_equations.h"

#include <dalembert/core/errors.h>
#include <dalembert/core/lagrange/stated_by_lagrangians.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/run/sticking.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

/// What of a batch of forces is compared at an instant, on these sides.
std::vector<Branches::Comparison> compared(const StatedByLagrangians& batch, std::size_t number,
                                           const Instant& at, const Branches::Sides& held) {
  Branches::Sides recorded;
  const Branches listening(&recorded, &held);
  Branches::enter_batch(number);
  try {
    (void)batch.lagrangians(at, at);
  } catch (...) {  // what was compared until then was compared
  }
  return recorded[number];
}

/// Whether what has left these sides is decided by time alone: it is a number where the motion is none.
bool decided_by_time(const StatedByLagrangians& batch, std::size_t number, const Instant& ahead,
                     const Branches::Sides& held) {
  const std::vector<double> none(ahead.q.size(), std::numeric_limits<double>::quiet_NaN());
  const auto all = compared(batch, number, ahead, held),
             timed = compared(batch, number, {ahead.t, none, none}, held);
  bool any = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double difference = all[k].difference;
    if (all[k].side == 0 ? difference == 0.0 : !(all[k].side * difference < 0.0)) continue;
    if (k >= timed.size() || std::isnan(timed[k].difference)) return false;
    any = true;
  }
  return any;
}

using Values = std::vector<StatedByLagrangians::Value>;

/// By more than errors change either.
bool jump(const Values& before, const Values& behind) {
  return !std::ranges::equal(before, behind, [](const auto& one, const auto& other) {
    return std::abs(other.value - one.value) <= std::max(one.error, other.error);
  });
}

}  // namespace

ComparedEquations::ComparedEquations(const Problem& problem, const Start& start, double tolerance)
    : system_(&problem.system()),
      scales_(start.scales),
      tolerance_(tolerance),
      e_(system_->evaluation()),
      lambda_(start.lambda.size()),
      a_(start.q.size()) {
  if (system_->forces().has_friction()) start_listening(problem, start);
}

void ComparedEquations::start_listening(const Problem& problem, const Start& start) {
  if (!manifold_) manifold_.emplace(problem, start.rows, start.scales.lengths());
  conditional_ = system_->conditional_rows();
}

bool ComparedEquations::record(const Instant& at, const Branches::Sides* held, Branches::Sides& out) {
  const Branches listening(&out, held);
  try {
    if (!system_->forces().has_friction()) {
      system_->evaluate(at, e_);
      return true;
    }
    if (!manifold_->accelerate(at, a_)) return false;
    manifold_->multipliers(lambda_);
    system_->forces().add_friction(at, lambda_, e_.force);
    return true;
  } catch (const EquationFault&) {
    return false;
  }
}

bool ComparedEquations::accelerate(Motion& at, const Branches::Sides& held) {
  const Branches holding(nullptr, &held);
  at.a.resize(at.q.size());
  try {
    return manifold_->accelerate(at.instant(), at.a);
  } catch (const EquationFault&) {
    return false;
  }
}

void ComparedEquations::evaluate(const Instant& at) {
  const Branches anywhere(nullptr, nullptr);
  system_->evaluate(at, e_);
}

bool ComparedEquations::differ(const Motion& there, const Branches::Sides& before,
                               const Branches::Sides& behind) {
  Motion one = there, other = there;
  if (!accelerate(one, before)) return true;
  std::vector<double> lambda(lambda_.size());
  manifold_->multipliers(lambda);
  if (!accelerate(other, behind)) return true;
  manifold_->multipliers(lambda_);
  for (std::size_t i = 0; i < there.v.size(); ++i) {
    const double effect = scales_.time * std::abs(other.a[i] - one.a[i]);
    if (!(effect <= scales_.velocity_error(i, there.v[i], tolerance_))) return true;
  }
  // Of all that acts on what a row moves: of forces elsewhere one may be any part.
  std::vector<double> acting(there.v.size());
  const auto& e = manifold_->equations();
  for (std::size_t i = 0; i < acting.size(); ++i)
    acting[i] =
        std::abs(e.force[i]) + system_->masses()[i] * std::max(std::abs(one.a[i]), std::abs(other.a[i]));
  for (std::size_t r = 0; r < lambda.size(); ++r)
    for (const std::size_t k : system_->row(r))
      acting[system_->w_columns()[k]] +=
          std::abs(e.w[k]) * std::max(std::abs(lambda[r]), std::abs(lambda_[r]));
  for (std::size_t r = 0; r < lambda.size(); ++r)
    for (const std::size_t k : system_->row(r))
      if (!(std::abs(e.w[k] * (lambda_[r] - lambda[r])) <= tolerance_ * acting[system_->w_columns()[k]]))
        return true;
  return false;
}

std::optional<std::size_t> ComparedEquations::corner(const Instant& at, const Branches::Sides& before,
                                                     const Branches::Sides& behind) {
  const auto lengths = scales_.lengths();
  auto there = system_->evaluation();
  const auto evaluate = [&](const Branches::Sides& held, System::Evaluation& e) {
    const Branches holding(nullptr, &held);
    system_->evaluate(at, e);
  };
  evaluate(before, there);
  evaluate(behind, e_);
  const double most = constants.most_correction * tolerance_;
  std::optional<std::size_t> conditional;
  for (std::size_t r = 0; r < system_->rows(); ++r) {
    if (!system_->in_force(r) || system_->law(r).compliant()) continue;
    const double gradient = gradient_length(*system_, e_.w, lengths, r);
    const bool holonomic = r < system_->holonomic_rows();
    const double jump = holonomic ? std::abs(e_.g[r] - there.g[r]) : 0.0;
    const double of_velocity = std::abs(e_.psi[r] - there.psi[r]);
    if (!(of_velocity > most * scales_.speed() * gradient || jump > most * scales_.length * gradient))
      continue;
    if (!holds_at_times(r)) return r;
    if (!conditional) conditional = r;
  }
  return conditional;
}

std::optional<std::size_t> ComparedEquations::impulse(const Motion& there, const Instant& ahead,
                                                      const Branches::Sides& before,
                                                      const Branches::Sides& behind) const {
  const Instant at = there.instant();
  const double of_time = 16.0 * epsilon * std::max(std::abs(at.t), scales_.time);
  std::vector<double> of_q(at.q.size()), of_v(at.q.size());
  for (std::size_t i = 0; i < of_q.size(); ++i) {
    of_q[i] = scales_.position_error(i, at.q[i], tolerance_) + std::abs(at.v[i]) * of_time;
    of_v[i] = scales_.velocity_error(i, at.v[i], tolerance_) + std::abs(there.a[i]) * of_time;
  }
  const std::size_t constraints = system_->stated_batches() - system_->forces().stated();
  const auto forces = system_->forces().plain();
  for (std::size_t b = 0; b < forces.size(); ++b) {
    const auto* const own = dynamic_cast<const StatedByLagrangians*>(forces[b].get());
    if (own == nullptr) continue;
    const std::size_t number = constraints + b;
    const auto on = [&](const Branches::Sides& held) {
      const Branches holding(nullptr, &held);
      Branches::enter_batch(number);
      return own->lagrangians(at, {of_time, of_q, of_v});
    };
    const auto one = on(before), other = on(behind);
    if (jump(one.momenta, other.momenta)) return number;
    if (jump(one.L, other.L) && !decided_by_time(*own, number, ahead, before)) return number;
  }
  return std::nullopt;
}

std::optional<std::string> ComparedEquations::would_stick(const Motion& there, const Branches::Sides& before,
                                                          const Branches::Sides& behind) {
  const Switches switches(*system_);
  if (!switches.any()) return std::nullopt;
  const auto slope_on = [&](const Branches::Sides& held) {
    Slope slope;
    Motion at = there;
    if (!accelerate(at, held)) return slope;
    manifold_->multipliers(lambda_);
    const Branches holding(nullptr, &held);
    switches.find(at.instant(), lambda_, slope);
    return slope;
  };
  const auto friction = switches.turned(slope_on(before), slope_on(behind));
  if (!friction) return std::nullopt;
  return Sticking::message(switches, *friction);
}

}  // namespace dalembert
