#include "dalembert/solvers/contact/friction_equations.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

using Eigen::Index;
using Eigen::VectorXd;

std::shared_ptr<const System> FrictionEquations::with_modes(std::span<const RoughState> all,
                                                            const Open& open) const {
  std::vector<std::size_t> out = open;
  std::vector<System::Slide> slides;
  for (const RoughState& r : all) {
    if (r.mode == RoughState::Mode::absent) out.push_back(r.number);
    if (r.mode != RoughState::Mode::slides || std::ranges::find(open, r.number) != open.end()) continue;
    slides.push_back({r.number, r.sign * r.mu, {r.direction.begin(), r.direction.end()}, r.blur});
  }
  return std::make_shared<const System>(stated_->without(out).sliding(slides));
}

FrictionEquations::Motion FrictionEquations::solve(std::span<const RoughState> all, const Open& open,
                                                   const Instant& at) const {
  const Problem problem(with_modes(all, open));
  const System* const system = &problem.system();
  auto e = system->evaluation();
  system->evaluate(at, e);
  Manifold manifold(problem, independent_rows(*system, e.w), lengths_);
  Motion motion{std::vector<double>(at.q.size()), std::vector<double>(system->rows())};
  std::vector<double> v(at.v.begin(), at.v.end());
  if (!manifold.solve_motion(at.t, at.q, v, motion.a, motion.lambda)) throw linearly_dependent(at.t);
  motion.unique.assign(manifold.unique().begin(), manifold.unique().end());
  return motion;
}

std::vector<double> FrictionEquations::velocities_at_rest(std::span<const RoughState> all, const Open& open,
                                                          const Instant& at) const {
  const Problem problem(with_modes(all, open));
  const System& system = problem.system();
  auto e = system.evaluation();
  system.evaluate(at, e);
  Manifold manifold(problem, independent_rows(system, e.w), lengths_);
  std::vector<double> v(at.v.begin(), at.v.end()), impulses(system.rows());
  if (!manifold.project_impulsively(at.t, at.q, v, impulses)) throw linearly_dependent(at.t);
  return v;
}

VectorXd FrictionEquations::slip_acceleration(const RoughState& rough, const Instant& at,
                                              const Motion& motion) const {
  auto e = stated_->evaluation();
  std::vector<double> gamma(stated_->rows());
  stated_->evaluate(at, e);
  stated_->bias(at, gamma);
  VectorXd rate(static_cast<Index>(rough.rows));
  double terms = 0.0;
  for (std::size_t k = 0; k < rough.rows; ++k) {
    const std::size_t row = rough.row + k;
    double sum = gamma[row];
    terms = std::max(terms, std::abs(gamma[row]));
    for (const std::size_t j : stated_->row(row)) {
      const double term = e.w[j] * motion.a[stated_->w_columns()[j]];
      const std::size_t i = stated_->w_columns()[j];
      sum += term;
      terms = std::max({terms, std::abs(term), std::abs(e.w[j] * e.force[i] / stated_->masses()[i])});
    }
    rate[static_cast<Index>(k)] = sum;
    if (rough.mode == RoughState::Mode::slides)
      terms = std::max(terms, rough.mu * std::abs(motion.lambda[rough.pressing_row]) *
                                  inverse_effective_mass(*stated_, e.w, row));
  }
  if (rate.norm() <= Accuracy(tolerance_).of_accelerations() * terms) rate.setZero();
  return rate;
}

SlipCoupling FrictionEquations::released(std::span<const RoughState> all,
                                         const std::vector<std::size_t>& which, const Open& open,
                                         const Instant& at) const {
  std::vector<std::size_t> out = open;
  std::vector<SlipRows> rows;
  for (const std::size_t i : which) {
    out.push_back(all[i].number);
    rows.push_back({all[i].row, all[i].rows, all[i].pressing_row});
  }
  return {*stated_, with_modes(all, out), rows, lengths_, at, tolerance_};
}

double FrictionEquations::round_off_of(std::span<const RoughState> all, const RoughState& rough,
                                       std::span<const double> a, std::span<const double> lambda) const {
  double force = std::abs(lambda[rough.pressing_row]);
  if (rough.shared)
    for (const RoughState& other : all)
      if (other.shared) force = std::max(force, std::abs(lambda[other.pressing_row]));
  for (std::size_t row = rough.row; row < rough.row + rough.rows; ++row) {
    double acceleration = 0.0;
    for (const std::size_t j : stated_->row(row)) {
      const std::size_t i = stated_->w_columns()[j];
      acceleration = std::max(acceleration, std::abs(a[i]) * lengths_[i]);
    }
    force = std::max({force, std::abs(lambda[row]), lightest_mass(*stated_, lengths_, row) * acceleration});
  }
  return std::min(round_off(), tolerance_) * force + rough.noise + std::numeric_limits<double>::min();
}

}  // namespace dalembert
