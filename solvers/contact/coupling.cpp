#include "dalembert/solvers/contact/coupling.h"

#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

System::Evaluation evaluated(const System& system, const Instant& at) {
  auto e = system.evaluation();
  system.evaluate(at, e);
  return e;
}

/// An independent set of the rows of all constraints but the contacts.
ActiveRows rows_besides(const System& system, const std::vector<std::size_t>& contacts,
                        const System::Evaluation& e) {
  std::vector<double> w = e.w;
  for (const std::size_t c : contacts) {
    const auto row = system.layout()->constraints[c].own_rows().front();
    for (const std::size_t k : system.row(row)) w[k] = 0.0;
  }
  return independent_rows(system.without(contacts), w);
}

}  // namespace

Coupling::Coupling(std::shared_ptr<const System> of, const std::vector<std::size_t>& contacts,
                   const Instant& at)
    : system_(std::move(of)),
      e_(evaluated(*system_, at)),
      others_(rows_besides(*system_, contacts, e_)),
      matrix_(Problem(system_).pattern(others_.rows)) {
  const System& system = *system_;
  if (!matrix_.factorise({.w = e_.w})) throw linearly_dependent(at.t);
  const auto n = static_cast<Index>(contacts.size());
  for (const std::size_t c : contacts) {
    const Layout::Constraint& its = system.layout()->constraints[c];
    rows_.push_back(its.own_rows().front());
    signs_.push_back(its.holds.contact->sign());
    std::vector<double> x(matrix_.size());
    for (const std::size_t k : system.row(rows_.back())) x[system.w_columns()[k]] += signs_.back() * e_.w[k];
    matrix_.solve(x);
    responses_.push_back(std::move(x));
  }
  S_.resize(n, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i)
      S_(i, j) = along(static_cast<std::size_t>(i), responses_[static_cast<std::size_t>(j)]);
  }
}

/// s W x of a contact.
double Coupling::along(std::size_t contact, std::span<const double> x) const {
  double sum = 0.0;
  for (const std::size_t k : system_->row(rows_[contact])) sum += e_.w[k] * x[system_->w_columns()[k]];
  return signs_[contact] * sum;
}

VectorXd Coupling::rates(std::span<const double> v) const {
  VectorXd U(S_.rows());
  for (Index i = 0; i < U.size(); ++i) {
    const auto c = static_cast<std::size_t>(i);
    const double rate = e_.psi[rows_[c]];
    double sum = rate, terms = 0.0;  // psi = W v + dg/dt
    for (const std::size_t k : system_->row(rows_[c])) {
      const double term = e_.w[k] * v[system_->w_columns()[k]];
      sum -= term;
      terms += std::abs(term);
    }
    U[i] = std::abs(rate) <= round_off() * (terms + std::abs(sum)) ? 0.0 : signs_[c] * rate;
  }
  return U;
}

VectorXd Coupling::accelerations_without(const Instant& at) {
  system_->evaluate(at, e_);
  std::vector<double> gamma(system_->rows()), x(matrix_.size());
  system_->bias(at, gamma);
  std::ranges::copy(e_.force, x.begin());
  for (std::size_t r = 0; r < others_.size(); ++r) x[e_.force.size() + r] = -gamma[others_.rows[r]];
  matrix_.solve(x);
  VectorXd accelerations(S_.rows());
  for (Index i = 0; i < accelerations.size(); ++i) {
    const auto c = static_cast<std::size_t>(i);
    accelerations[i] = along(c, x) + signs_[c] * gamma[rows_[c]];
  }
  return accelerations;
}

void Coupling::apply_impulses(const VectorXd& P, std::span<double> v, std::span<double> impulses) const {
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const double p = P[static_cast<Index>(j)];
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += p * responses_[j][i];
    for (std::size_t r = 0; r < others_.size(); ++r)
      impulses[others_.rows[r]] += p * responses_[j][v.size() + r];
    impulses[rows_[j]] += signs_[j] * p;
  }
}

}  // namespace dalembert
