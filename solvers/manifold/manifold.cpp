#include "dalembert/solvers/manifold/manifold.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace dalembert {

namespace {

/// s over the inverse_effective_mass w M^-1 w of a row whose multiplier is given: what it still yields is
/// round-off of round-off.
constexpr double rigid = 1.0 / (epsilon * epsilon);

}  // namespace

Manifold::Manifold(const Problem& problem, const ActiveRows& rows, std::vector<double> lengths)
    : problem_(problem),
      system_(&problem_.system()),
      rows_(rows),
      lengths_(std::move(lengths)),
      e_(system_->evaluation()),
      gamma_(system_->rows()),
      matrix_(problem.pattern(rows.rows)),
      minimum_norm_(*system_, rows, lengths_),
      weakest_(*system_),
      redundant_(rows.size() < system_->rows_in_force()) {
  x_.resize(matrix_.size());
  q_before_.resize(system_->coordinates());
  w_before_.resize(e_.w.size());
  if (system_->forces().has_friction()) friction_.emplace(problem, rows);
  if (!system_->compliant()) return;
  s_.resize(system_->rows(), 0.0);
  reflected_ = s_;
  multipliers_before_ = multipliers_ = CompliantMultipliers(system_->rows());
}

void Manifold::use_multipliers(const CompliantMultipliers& given) {
  multipliers_ = given;
  given_multipliers_ = true;
}

/// Makes the residuals of compliant rows those of g + C lambda.
void Manifold::add_compliance() {
  for (std::size_t r = 0; r < multipliers_.lambda.size(); ++r) {
    const RowLaw& law = system_->law(r);
    if (!compliant(r)) continue;
    if (!given_multipliers_) {
      multipliers_.lambda[r] = law.multiplier(e_.g[r]);
      multipliers_.rate[r] = law.multiplier(e_.psi[r]);
    }
    e_.g[r] = given_multipliers_ ? law.residual(e_.g[r], multipliers_.lambda[r]) : 0.0;
    e_.psi[r] = given_multipliers_ ? law.residual(e_.psi[r], multipliers_.rate[r]) : 0.0;
  }
}

void Manifold::weigh_compliance() {
  for (std::size_t r = 0; r < s_.size(); ++r) {
    if (compliant(r))
      s_[r] = given_multipliers_ ? multipliers_.c * multipliers_.c * system_->law(r).compliance
                                 : rigid * inverse_effective_mass(*system_, e_.w, r);
  }
}

double Manifold::sine(const Instant& at) {
  evaluate(at);
  return factorise() ? sine_ : 0.0;
}

void Manifold::weakest_directions(std::span<double> n, std::span<double> response) {
  const Islands& islands = problem_.islands();
  weakest_.find(matrix_, rows_, e_.w, islands);
  std::vector<double> largest(islands.count);
  for (std::size_t i = 0; i < n.size(); ++i) {
    double& own = largest[islands.of_coordinate[i]];
    own = std::max(own, std::abs(weakest_.n()[i]) * lengths_[i]);
  }
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double own = largest[islands.of_coordinate[i]];
    n[i] = own > 0.0 ? weakest_.n()[i] / own : 0.0;
  }
  std::ranges::fill(response, 0.0);
  for (std::size_t r = 0; r < system_->rows(); ++r) {
    if (!system_->in_force(r)) continue;
    const double change = row_times(*system_, e_.w, r, n);
    double& own = response[islands.of_row(*system_, r)];
    own = std::max(own, std::abs(change) / gradient_length(*system_, e_.w, lengths_, r));
  }
}

void Manifold::use(ActiveRows rows) {
  past_factorisations_ = factorisations();
  rows_ = std::move(rows);
  SaddleMatrix fresh(problem_.pattern(rows_.rows));
  std::destroy_at(&matrix_);  // KLU's handles are not assigned, but moving one cannot fail
  std::construct_at(&matrix_, std::move(fresh));
  minimum_norm_ = MinimumNorm(*system_, rows_, lengths_);
  if (friction_) friction_.emplace(problem_, rows_);
}

bool Manifold::factorise_those_in_use() {
  weigh_compliance();
  const bool regular = matrix_.factorise({.w = e_.w, .s = s_});
  sine_ = redundant_ && regular && !matrix_.tells_sine()
              ? weakest_.smallest_singular_value(matrix_, rows_, e_.w, problem_.islands())
              : matrix_.sine();
  return regular;
}

/// Rows are compared where the angle of those in use has changed much since they were compared last.
bool Manifold::factorise() {
  const bool regular = factorise_those_in_use();
  if (!redundant_) return regular;
  if (best_sine_ == 0.0) best_sine_ = sine_;
  const double own = regular ? sine_ : 0.0;
  if (own >= constants.row_exchange_ratio * best_sine_ && constants.row_exchange_ratio * own <= best_sine_)
    return regular;
  return exchange_rows(own);
}

/// By others, if their angles are so much larger than `own`, those of the rows in use.
bool Manifold::exchange_rows(double own) {
  ActiveRows before = rows_, others = independent_rows(*system_, e_.w, rows_);
  best_sine_ = own;
  if (others.rows == rows_.rows) return own > 0.0;
  use(std::move(others));
  bool regular = factorise_those_in_use();
  best_sine_ = std::max(own, sine_);
  if (regular && own < constants.row_exchange_ratio * sine_) {
    ++exchanges_;
    return true;
  }
  use(std::move(before));
  return factorise_those_in_use();
}

void Manifold::evaluate(const Instant& at) {
  system_->evaluate(at, e_);
  add_compliance();
  ++evaluations_;
}

void Manifold::evaluate_with_bias(const Instant& at) {
  system_->evaluate_with_bias(at, e_, gamma_);
  add_compliance();
  ++evaluations_;
}

void Manifold::solve_for_position_step(std::size_t n) {
  std::fill_n(x_.begin(), n, 0.0);
  for (std::size_t r = 0; r < rows_.rows.size(); ++r) {
    x_[n + r] = r < rows_.holonomic ? -e_.g[rows_.rows[r]] : 0.0;
  }
  matrix_.solve(x_);
}

Violation Manifold::project_positions(double t, std::span<double> q, std::span<const double> v,
                                      double tolerance) {
  constexpr int most_iterations = 100;
  constexpr int most_halvings = 30;
  evaluate({t, q, v});
  Violation left = position_violation(*system_, e_, lengths_);
  bool matrix_serves = false;
  for (int i = 0; i < most_iterations && left.size > tolerance; ++i) {
    if (!matrix_serves && !factorise()) break;
    solve_for_position_step(q.size());
    std::ranges::copy(q, q_before_.begin());
    multipliers_before_ = multipliers_;
    const Violation before = left;
    double fraction = 1.0;
    for (int halving = 0; halving < most_halvings; ++halving, fraction *= 0.5) {
      for (std::size_t k = 0; k < q.size(); ++k) q[k] = q_before_[k] + fraction * x_[k];
      if (given_multipliers_) add_to_multipliers(multipliers_before_.lambda, fraction, multipliers_.lambda);
      evaluate({t, q, v});
      left = position_violation(*system_, e_, lengths_);
      if (left.size < before.size) break;
    }
    if (!(left.size < before.size)) {
      std::ranges::copy(q_before_, q.begin());
      multipliers_ = multipliers_before_;
      evaluate({t, q, v});
      return before;
    }
    // Close to the manifold one matrix serves for all iterations.
    matrix_serves = left.size < 0.1 * before.size;
  }
  return left;
}

/// to = from + c^2 y in compliant rows, with y of the last solve.
void Manifold::add_to_multipliers(const std::vector<double>& from, double fraction, std::vector<double>& to) {
  const std::size_t n = x_.size() - rows_.rows.size();
  for (std::size_t k = 0; k < rows_.rows.size(); ++k) {
    const auto r = rows_.rows[k];
    if (system_->law(r).compliant()) to[r] = from[r] + fraction * multipliers_.c * multipliers_.c * x_[n + k];
  }
}

/// (2), with the matrix at hand. Of the equations psi is then out of date, and F if it depends on
/// velocities.
void Manifold::correct_velocities(std::span<double> v) {
  const std::size_t n = v.size();
  std::fill_n(x_.begin(), n, 0.0);
  for (std::size_t r = 0; r < rows_.rows.size(); ++r) x_[n + r] = -e_.psi[rows_.rows[r]];
  matrix_.solve(x_);
  for (std::size_t k = 0; k < n; ++k) v[k] += x_[k];
  if (given_multipliers_) add_to_multipliers(multipliers_.rate, 1.0, multipliers_.rate);
}

/// (3) and (4), with the matrix, the forces and gamma at hand.
bool Manifold::solve_for_accelerations(const Instant& at, std::span<double> a) {
  const std::size_t n = at.q.size();
  if (!solve_with_compliance(at, multipliers_.lambda)) return false;
  if (given_multipliers_) {
    for (std::size_t k = 0; k < rows_.rows.size(); ++k)
      reflected_[rows_.rows[k]] = 2.0 * multipliers_.lambda[rows_.rows[k]] - x_[n + k];
    if (!solve_with_compliance(at, reflected_)) return false;
  }
  std::copy_n(x_.begin(), n, a.begin());
  return true;
}

/// (3), with these multipliers of compliant rows. Friction has a matrix of its own.
bool Manifold::solve_with_compliance(const Instant& at, std::span<const double> lambda) {
  const std::size_t n = at.q.size();
  std::ranges::copy(e_.force, x_.begin());
  for (std::size_t k = 0; k < rows_.rows.size(); ++k) {
    const auto r = rows_.rows[k];
    x_[n + k] = -gamma_[r];
    if (system_->law(r).compliant())
      x_[n + k] += s_[r] * lambda[r] - system_->law(r).compliance * multipliers_.second[r];
  }
  if (friction_) return friction_->solve(at, e_.w, s_, x_);
  matrix_.solve(x_);
  return true;
}

bool Manifold::project_impulsively(double t, std::span<const double> q, std::span<double> v,
                                   std::span<double> impulses) {
  evaluate({t, q, v});
  if (!factorise()) return false;
  correct_velocities(v);
  multipliers(impulses);
  for (std::size_t r = 0; r < s_.size(); ++r)
    if (compliant(r)) impulses[r] = 0.0;
  return true;
}

void Manifold::multipliers(std::span<double> lambda) const {
  const std::size_t n = x_.size() - rows_.rows.size();
  std::ranges::fill(lambda, 0.0);
  for (std::size_t r = 0; r < rows_.rows.size(); ++r) lambda[rows_.rows[r]] = x_[n + r];
}

bool Manifold::accelerate(const Instant& at, std::span<double> a) {
  evaluate_with_bias(at);
  if (friction_ && !redundant_) {
    weigh_compliance();
  } else if (!factorise()) {
    return false;
  }
  return solve_for_accelerations(at, a);
}

double Manifold::turned_since(std::span<const double> w) const {
  double most = 0.0;
  for (std::size_t k = 0; k < rows_.holonomic; ++k) {
    const std::size_t r = rows_.rows[k];
    if (system_->law(r).compliant()) continue;
    double change = 0.0;
    for (const std::size_t j : system_->row(r)) {
      const double slope = (e_.w[j] - w[j]) / lengths_[system_->w_columns()[j]];
      change += slope * slope;
    }
    most = std::max(most, std::sqrt(change) / gradient_length(*system_, e_.w, lengths_, r));
  }
  return most;
}

bool Manifold::project(double t, std::span<double> q, std::span<double> v, std::span<double> a) {
  evaluate({t, q, v});
  turned_ = 0.0;
  if (rows_.holonomic > 0) {
    if (!factorise()) return false;
    std::ranges::copy(e_.w, w_before_.begin());
    solve_for_position_step(q.size());
    for (std::size_t k = 0; k < q.size(); ++k) q[k] += x_[k];
    evaluate({t, q, v});
    turned_ = turned_since(w_before_);
  }
  if (!factorise()) return false;
  correct_velocities(v);
  if (system_->forces().damping_pattern().empty()) {
    system_->bias({t, q, v}, gamma_);
  } else {
    evaluate_with_bias({t, q, v});
  }
  return solve_for_accelerations({t, q, v}, a);
}

bool Manifold::solve_motion(double t, std::span<const double> q, std::span<double> v, std::span<double> a,
                            std::span<double> lambda) {
  evaluate({t, q, v});
  if (!factorise()) return false;
  if (rows_.rows.empty()) {
    system_->bias({t, q, v}, gamma_);
  } else {
    correct_velocities(v);
    evaluate_with_bias({t, q, v});
  }
  if (!solve_for_accelerations({t, q, v}, a)) return false;
  multipliers(lambda);
  const bool finite = std::ranges::all_of(x_, [](double x) { return std::isfinite(x); });
  if (finite && minimum_norm_.needed()) {
    minimum_norm_.spread([this](std::span<double> x) { matrix_.solve(x); }, {t, q, v}, e_, lambda);
  }
  if (finite && friction_) {
    if (minimum_norm_.needed()) friction_->require_determined({t, q, v}, minimum_norm_);
    friction_->require_unique({t, q, v}, e_.w, s_);
  }
  return finite;
}

}  // namespace dalembert
