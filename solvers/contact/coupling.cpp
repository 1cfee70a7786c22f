#include "dalembert/solvers/contact/coupling.h"

#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/rows.h>

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

/// An independent set of the rows of all rigid constraints but the contacts.
ActiveRows rows_besides(const System& system, const std::vector<std::size_t>& contacts,
                        const System::Evaluation& e) {
  std::vector<std::size_t> out = contacts;
  const auto& constraints = system.layout()->constraints;
  for (std::size_t c = 0; c < constraints.size(); ++c)
    if (system.law(constraints[c].own_rows().front()).compliant()) out.push_back(c);
  std::vector<double> w = e.w;
  for (const std::size_t c : out) {
    for (const std::size_t row : constraints[c].own_rows())
      for (const std::size_t k : system.row(row)) w[k] = 0.0;
  }
  return independent_rows(system.without(out), w);
}

}  // namespace

Coupling::Coupling(std::shared_ptr<const System> of, const std::vector<std::size_t>& contacts,
                   const Instant& at)
    : system_(std::move(of)),
      e_(evaluated(*system_, at)),
      problem_(system_),
      others_(rows_besides(*system_, contacts, e_)),
      matrix_(problem_.pattern(others_.rows)) {
  if (!matrix_.factorise({.w = e_.w})) throw linearly_dependent(at.t);
  for (const std::size_t c : contacts) {
    rows_.push_back(system_->layout()->constraints[c].own_rows().front());
    signs_.push_back(system_->conditions().of[c].contact->sign());
  }
  group();
  respond();
  find_held(contacts);
}

void Coupling::group() {
  const Islands& islands = problem_.islands();
  std::vector<Places> all(islands.count);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    Places& own = all[islands.of_row(*system_, rows_[j])];
    turns_.push_back(own.size());
    own.push_back(static_cast<Index>(j));
  }
  for (Places& own : all)
    if (!own.empty()) islands_.push_back(std::move(own));
}

/// (1), for the first contact of each island, the second, and so on.
void Coupling::respond() {
  std::size_t turns = 0;
  for (const Places& own : islands_) turns = std::max(turns, own.size());
  responses_.assign(turns, std::vector<double>(matrix_.size()));
  for (std::size_t j = 0; j < rows_.size(); ++j)
    add_row(*system_, e_.w, rows_[j], signs_[j], responses_[turns_[j]]);
  for (auto& x : responses_) matrix_.solve(x);
}

/// A small S_jj may also be that of something light on something heavy: the rows tell, as they do which
/// constraints are redundant.
void Coupling::find_held(const std::vector<std::size_t>& contacts) {
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const double alone = inverse_effective_mass(*system_, e_.w, rows_[j]);
    bool held = along(j, responses_[turns_[j]]) <= round_off() * alone;
    if (held) {
      std::vector<std::size_t> besides = contacts;
      besides.erase(besides.begin() + static_cast<std::ptrdiff_t>(j));
      held = rows_besides(*system_, besides, e_).size() == others_.size();
    }
    held_.push_back(held);
  }
}

Eigen::MatrixXd Coupling::S(const Places& contacts) const {
  const auto n = static_cast<Index>(contacts.size());
  Eigen::MatrixXd S(n, n);
  const auto contact = [&](Index i) {
    return static_cast<std::size_t>(contacts[static_cast<std::size_t>(i)]);
  };
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      S(i, j) =
          held_[contact(i)] || held_[contact(j)] ? 0.0 : along(contact(i), responses_[turns_[contact(j)]]);
  return S;
}

/// s W x of a contact.
double Coupling::along(std::size_t contact, std::span<const double> x) const {
  return signs_[contact] * row_times(*system_, e_.w, rows_[contact], x);
}

VectorXd Coupling::rates(std::span<const double> v) const {
  VectorXd U(static_cast<Index>(rows_.size()));
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

/// W^T lambda of the compliant rows.
void Coupling::add_compliant_forces(std::span<double> force) const {
  if (!system_->compliant()) return;
  for (std::size_t r = 0; r < system_->holonomic_rows(); ++r) {
    if (!system_->law(r).compliant()) continue;
    add_row(*system_, e_.w, r, system_->law(r).multiplier(e_.g[r]), force);
  }
}

VectorXd Coupling::accelerations_without(const Instant& at) {
  system_->evaluate(at, e_);
  std::vector<double> gamma(system_->rows()), x(matrix_.size());
  system_->bias(at, gamma);
  std::ranges::copy(e_.force, x.begin());
  add_compliant_forces(x);
  for (std::size_t r = 0; r < others_.size(); ++r) x[e_.force.size() + r] = -gamma[others_.rows[r]];
  std::vector<double> terms(e_.force.size());  // of each coordinate: |F| + |W_b|^T |lambda_b|
  for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = std::abs(x[i]);
  matrix_.solve(x);
  for (std::size_t r = 0; r < others_.size(); ++r)
    for (const std::size_t k : system_->row(others_.rows[r]))
      terms[system_->w_columns()[k]] += std::abs(e_.w[k] * x[terms.size() + r]);
  VectorXd accelerations(static_cast<Index>(rows_.size()));
  for (Index i = 0; i < accelerations.size(); ++i) {
    const auto c = static_cast<std::size_t>(i);
    const double gamma_c = gamma[rows_[c]], acceleration = along(c, x) + signs_[c] * gamma_c;
    double largest = std::abs(gamma_c);
    for (const std::size_t k : system_->row(rows_[c])) {
      const std::size_t column = system_->w_columns()[k];
      largest += std::abs(e_.w[k]) * terms[column] / system_->masses()[column];
    }
    accelerations[i] = std::abs(acceleration) <= round_off() * largest ? 0.0 : acceleration;
  }
  return accelerations;
}

void Coupling::apply_impulses(const VectorXd& P, std::span<double> v, std::span<double> impulses) const {
  const Islands& islands = problem_.islands();
  std::vector<double> p(islands.count);
  for (std::size_t turn = 0; turn < responses_.size(); ++turn) {
    std::ranges::fill(p, 0.0);
    for (std::size_t j = 0; j < rows_.size(); ++j)
      if (turns_[j] == turn) p[islands.of_row(*system_, rows_[j])] = P[static_cast<Index>(j)];
    const auto& x = responses_[turn];
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += p[islands.of_coordinate[i]] * x[i];
    for (std::size_t r = 0; r < others_.size(); ++r)
      impulses[others_.rows[r]] += p[islands.of_row(*system_, others_.rows[r])] * x[v.size() + r];
  }
  for (std::size_t j = 0; j < rows_.size(); ++j) impulses[rows_[j]] += signs_[j] * P[static_cast<Index>(j)];
}

}  // namespace dalembert
