#include "dalembert/solvers/manifold/multiplier_forces.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

/// A law that is linear between two steps needs two, one that changes its slope with the sign of
/// lambda three; smooth laws converge quadratically.
constexpr int most_newton_steps = 30;

/// Some hundred roundings. Newton's iteration stops when the forces are those that the last slope predicted,
/// to so many of the user's law; a multiplier of so many of the forces that it balances is 0.
constexpr double same = 1e-13;

}  // namespace

void refuse_friction(const System& system, std::span<const double> slope, double t) {
  std::size_t steepest = 0;
  for (std::size_t k = 0; k < slope.size(); ++k)
    if (std::abs(slope[k]) > std::abs(slope[steepest])) steepest = k;
  std::ostringstream what;
  what.precision(10);
  what << system.forces().owner_of_friction(steepest) << " changes the multiplier of "
       << system.row_label(system.forces().friction_pattern()[steepest].column)
       << " that it reads so strongly that there is no acceleration, or no unique one (Painleve's paradox; "
          "t = "
       << t << "); make the friction smaller, or end the run before";
  throw EquationFault(what.str());
}

MultiplierForceSolver::MultiplierForceSolver(const Problem& problem, const ActiveRows& rows)
    : system_(&problem.system()),
      rows_(rows),
      matrix_(problem.pattern(rows.rows), SaddleValues::Blocks::slope),
      given_(matrix_.size()),
      lambda_(system_->rows()),
      slope_(system_->forces().friction_pattern().size()),
      slope_mirrored_(slope_.size()),
      force_(system_->coordinates()),
      predicted_(force_.size()),
      balanced_(force_.size()) {}

void MultiplierForceSolver::add_slope(double factor, std::span<const double> x, std::span<double> y) const {
  for (std::size_t k = 0; k < slope_.size(); ++k) {
    const auto [coordinate, row] = system_->forces().friction_pattern()[k];
    y[coordinate] += factor * slope_[k] * x[row];
  }
}

bool MultiplierForceSolver::converged() const {
  double difference = 0.0;
  for (std::size_t i = 0; i < force_.size(); ++i)
    difference = std::max(difference, std::abs(force_[i] - predicted_[i]));
  return difference <= same * std::max(largest(force_), largest(predicted_));
}

/// The multipliers that the motion would have without friction.
bool MultiplierForceSolver::solve_without(std::span<const double> w, std::span<const double> s) {
  if (!matrix_.factorise({.w = w, .s = s})) return false;
  without_.assign(given_.begin(), given_.end());
  matrix_.solve(without_);
  std::ranges::fill(lambda_, 0.0);
  std::ranges::fill(force_, 0.0);
  read_multipliers(w, s, without_);
  return std::ranges::all_of(without_, [](double value) { return std::isfinite(value); });
}

/// The multipliers of a solution. One that is the rounding of what its row balances is 0: it has no sign that
/// a law could read.
void MultiplierForceSolver::read_multipliers(std::span<const double> w, std::span<const double> s,
                                             std::span<double> x) {
  const auto columns = system_->w_columns();
  const auto masses = system_->masses();
  const auto own = x.subspan(force_.size());
  for (std::size_t i = 0; i < balanced_.size(); ++i) balanced_[i] = std::abs(given_[i]) + std::abs(force_[i]);
  for (std::size_t j = 0; j < own.size(); ++j)
    for (const std::size_t k : system_->row(rows_.rows[j])) balanced_[columns[k]] += std::abs(w[k] * own[j]);
  for (std::size_t j = 0; j < own.size(); ++j) {
    const std::size_t row = rows_.rows[j];
    double balanced = std::abs(given_[force_.size() + j]), diagonal = s.empty() ? 0.0 : s[row];
    for (const std::size_t k : system_->row(row)) {
      const std::size_t i = columns[k];
      balanced += std::abs(w[k]) * (balanced_[i] - std::abs(w[k] * own[j])) / masses[i];
      diagonal += w[k] * w[k] / masses[i];
    }
    if (std::abs(own[j]) * diagonal <= same * balanced) own[j] = 0.0;
    lambda_[row] = own[j];
  }
}

MultiplierForceSolver::Outcome MultiplierForceSolver::iterate(const Instant& at, std::span<const double> w,
                                                              std::span<const double> s,
                                                              std::span<double> x) {
  const std::size_t n = force_.size();
  std::ranges::fill(force_, 0.0);
  system_->forces().add_friction(at, lambda_, force_);
  for (int step = 0; step < most_newton_steps; ++step) {
    system_->forces().friction_slope(at, lambda_, slope_);
    if (!matrix_.factorise({.w = w, .s = s, .slope = slope_}))
      return matrix_.factorise({.w = w, .s = s}) ? Outcome::none : Outcome::singular;
    // F_f(lambda) - slope lambda: what stands on the right of (2), and with slope times the new lambda
    // the force predicted there.
    std::ranges::copy(force_, predicted_.begin());
    add_slope(-1.0, lambda_, predicted_);
    std::ranges::copy(given_, x.begin());
    for (std::size_t i = 0; i < n; ++i) x[i] += predicted_[i];
    matrix_.solve_refined(x);
    if (!std::ranges::all_of(x, [](double value) { return std::isfinite(value); })) return Outcome::singular;
    read_multipliers(w, s, x);
    add_slope(1.0, lambda_, predicted_);
    std::ranges::fill(force_, 0.0);
    system_->forces().add_friction(at, lambda_, force_);
    if (converged()) return matrix_.sign_of_determinant() > 0 ? Outcome::solved : Outcome::none;
  }
  return Outcome::none;
}

/// From the multipliers of the last solution, if there is one and that leads to another.
MultiplierForceSolver::Outcome MultiplierForceSolver::iterate_from_last(const Instant& at,
                                                                        std::span<const double> w,
                                                                        std::span<const double> s,
                                                                        std::span<double> x) try {
  return std::exchange(last_solved_, false) ? iterate(at, w, s, x) : Outcome::none;
} catch (const EquationFault&) {
  return Outcome::none;
}

bool MultiplierForceSolver::solve(const Instant& at, std::span<const double> w, std::span<const double> s,
                                  std::span<double> x) {
  std::ranges::copy(x, given_.begin());
  Outcome outcome = iterate_from_last(at, w, s, x);
  if (outcome == Outcome::none) {
    if (!solve_without(w, s)) return false;
    outcome = iterate(at, w, s, x);
  }
  if (outcome == Outcome::none) refuse_friction(*system_, slope_, at.t);
  last_solved_ = outcome == Outcome::solved;
  return last_solved_;
}

/// A law that has no slope at -lambda has no solution there either.
bool MultiplierForceSolver::mirrored_slope(const Instant& at) try {
  for (const double value : lambda_) mirrored_.push_back(-value);
  const Branches anywhere(nullptr, nullptr);
  system_->forces().friction_slope(at, mirrored_, slope_mirrored_);
  return true;
} catch (const EquationFault&) {
  return false;
}

void MultiplierForceSolver::require_unique(const Instant& at, std::span<const double> w,
                                           std::span<const double> s) {
  mirrored_.clear();
  if (!mirrored_slope(at) || slope_mirrored_ == slope_) return;
  const bool regular = matrix_.factorise({.w = w, .s = s, .slope = slope_mirrored_});
  require_regular(regular && matrix_.sign_of_determinant() > 0, at.t);
}

void MultiplierForceSolver::find_what_is_read(const Instant& at) {
  constexpr int trials = 4;
  reads_.assign(slope_.size(), 0);
  std::vector<double> v(at.v.size()), lambda(lambda_.size()), slope(slope_.size());
  std::minstd_rand generator;
  const double speed = std::max(1.0, largest(at.v)), force = std::max(1.0, largest(lambda_));
  const auto any_up_to = [&generator](double size) {
    return size *
           (2.0 * static_cast<double>(generator()) / static_cast<double>(std::minstd_rand::max()) - 1.0);
  };
  const Branches anywhere(nullptr, nullptr);
  for (int k = 0; k < trials; ++k) {
    std::ranges::generate(v, [&] { return any_up_to(speed); });
    std::ranges::generate(lambda, [&] { return any_up_to(force); });
    try {
      system_->forces().friction_slope({at.t, at.q, v}, lambda, slope);
    } catch (const EquationFault&) {
      std::ranges::fill(slope, 1.0);  // a law without values there may read anything
    }
    for (std::size_t i = 0; i < slope.size(); ++i) {
      if (slope[i] != 0.0) reads_[i] = 1;
    }
  }
}

/// Whether forces change with these multipliers, by more than what counts as dependent.
bool MultiplierForceSolver::changes_forces(const Eigen::VectorXd& multipliers) const {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(force_.size())), terms = change;
  for (std::size_t k = 0; k < slope_.size(); ++k) {
    const auto [coordinate, row] = system_->forces().friction_pattern()[k];
    const double term = slope_[k] * multipliers[static_cast<Eigen::Index>(row)];
    change[static_cast<Eigen::Index>(coordinate)] += term;
    terms[static_cast<Eigen::Index>(coordinate)] += std::abs(term);
  }
  return change.lpNorm<Eigen::Infinity>() > rank_threshold * terms.lpNorm<Eigen::Infinity>();
}

void MultiplierForceSolver::require_determined(const Instant& at, const MinimumNorm& multipliers) {
  if (reads_.empty()) find_what_is_read(at);
  bool changes = false;
  for (const auto& column : multipliers.null_space().colwise()) changes = changes || changes_forces(column);
  std::vector<char> sloped(system_->rows(), 0);
  for (std::size_t k = 0; k < slope_.size(); ++k)
    if (slope_[k] != 0.0) sloped[system_->forces().friction_pattern()[k].column] = 1;
  for (std::size_t k = 0; k < slope_.size(); ++k) {
    const std::size_t row = system_->forces().friction_pattern()[k].column;
    const bool at_rest = reads_[k] && !sloped[row];
    if (multipliers.unique()[row] || !(at_rest || (changes && sloped[row]))) continue;
    throw InconsistentStart(system_->forces().owner_of_friction(k) + " reads the multiplier of " +
                            system_->row_label(row) +
                            ", which the motion does not determine: that constraint is redundant; "
                            "remove what repeats it, or make it compliant");
  }
}

void MultiplierForceSolver::require_regular(bool regular, double t) {
  if (!regular) refuse_friction(*system_, slope_, t);
}

}  // namespace dalembert
