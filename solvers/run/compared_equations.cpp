#include "dalembert/solvers/run/compared_equations.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/run/sticking.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

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
