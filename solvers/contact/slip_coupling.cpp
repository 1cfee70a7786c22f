#include "dalembert/solvers/contact/slip_coupling.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

using Eigen::Index;

struct SlipCoupling::Equations {
  const System& stated;
  Problem free;
  const std::vector<SlipRows>& of;
  double t;
  std::vector<std::size_t> rows;  // all of them, one by one,
  std::vector<Index> first;       // and where those of each begin
  System::Evaluation e;           // of the stated system
  std::vector<double> gamma, w, s, slope, a, lambda;
  ActiveRows active;

  Equations(const System& all, std::shared_ptr<const System> released, const std::vector<SlipRows>& chosen,
            const std::vector<double>& lengths, const Instant& at);
};

SlipCoupling::Equations::Equations(const System& all, std::shared_ptr<const System> released,
                                   const std::vector<SlipRows>& chosen, const std::vector<double>& lengths,
                                   const Instant& at)
    : stated(all),
      free(std::move(released)),
      of(chosen),
      t(at.t),
      e(all.evaluation()),
      gamma(all.rows()),
      slope(free.system().forces().friction_pattern().size()),
      a(at.q.size()),
      lambda(all.rows()) {
  for (const SlipRows& its : of) {
    first.push_back(static_cast<Index>(rows.size()));
    for (std::size_t k = 0; k < its.rows; ++k) rows.push_back(its.row + k);
  }
  auto of_free = free.system().evaluation();
  free.system().evaluate(at, of_free);
  active = independent_rows(free.system(), of_free.w);
  Manifold manifold(free, active, lengths);
  std::vector<double> v(at.v.begin(), at.v.end());
  if (!manifold.solve_motion(at.t, at.q, v, a, lambda)) throw linearly_dependent(at.t);
  w = std::move(of_free.w);
  if (!slope.empty()) free.system().forces().friction_slope(at, lambda, slope);
  if (free.system().compliant()) s.resize(all.rows());
  for (std::size_t r = 0; r < s.size(); ++r) {  // their forces are given
    if (free.system().law(r).compliant())
      s[r] = inverse_effective_mass(free.system(), w, r) / (epsilon * epsilon);
  }
  stated.evaluate(at, e);
  stated.bias(at, gamma);
}

void SlipCoupling::find_rates(const Equations& its) {
  for (std::size_t k = 0; k < its.rows.size(); ++k) {
    const std::size_t row = its.rows[k];
    double sum = its.gamma[row], most = std::abs(sum);
    for (const std::size_t j : its.stated.row(row)) {
      const std::size_t i = its.stated.w_columns()[j];
      const double term = its.e.w[j] * its.a[i];
      sum += term;
      most = std::max({most, std::abs(term), std::abs(its.e.w[j] * its.e.force[i] / its.stated.masses()[i])});
    }
    c[static_cast<Index>(k)] = sum;
    terms[static_cast<Index>(k)] = most;
  }
  for (std::size_t i = 0; i < its.of.size(); ++i)
    N_0[static_cast<Index>(i)] = its.lambda[its.of[i].pressing_row];
}

/// By solves of the free system's matrix, with what slides or without. B is that of the last call.
void SlipCoupling::find_responses(const Equations& its, bool with_sliding, Eigen::MatrixXd& responses) {
  SaddleMatrix matrix(its.free.pattern(its.active.rows),
                      with_sliding ? SaddleValues::Blocks::slope : SaddleValues::Blocks::symmetric);
  SaddleValues values{.w = its.w, .s = its.s};
  if (with_sliding) values.slope = its.slope;
  if (!matrix.factorise(values)) throw linearly_dependent(its.t);
  const std::size_t n = its.a.size();
  std::vector<double> x(matrix.size());
  std::vector<std::ptrdiff_t> pressing;  // their places among the active rows
  for (const SlipRows& one : its.of)
    pressing.push_back(std::ranges::find(its.active.rows, one.pressing_row) - its.active.rows.begin());
  for (std::size_t k = 0; k < its.rows.size(); ++k) {
    std::ranges::fill(x, 0.0);
    add_row(its.stated, its.e.w, its.rows[k], 1.0, x);
    matrix.solve(x);
    for (std::size_t l = 0; l < its.rows.size(); ++l)
      responses(static_cast<Index>(l), static_cast<Index>(k)) =
          row_times(its.stated, its.e.w, its.rows[l], x);
    for (std::size_t i = 0; i < its.of.size(); ++i) {
      const auto place = static_cast<std::size_t>(pressing[i]);
      if (place == its.active.rows.size()) continue;
      B(static_cast<Index>(i), static_cast<Index>(k)) = x[n + place];
    }
  }
}

/// What the other constraints prescribe, to the threshold of rank: to the tolerance at rest it stays so.
void SlipCoupling::clear_prescribed(const Equations& its, double tolerance) {
  for (std::size_t i = 0; i < its.of.size(); ++i) {
    const Index k = its.first[i], rows = static_cast<Index>(its.of[i].rows);
    double alone = 0.0, most = 0.0;
    for (Index l = k; l < k + rows; ++l) {
      alone =
          std::max(alone, inverse_effective_mass(its.stated, its.e.w, its.rows[static_cast<std::size_t>(l)]));
      most = std::max(most, S_0(l, l));
    }
    if (most > rank_threshold * alone) continue;
    for (Eigen::MatrixXd* const matrix : {&S, &S_0}) {
      matrix->middleRows(k, rows).setZero();
      matrix->middleCols(k, rows).setZero();
    }
    B.middleCols(k, rows).setZero();
    if (c.segment(k, rows).norm() <= tolerance * terms.segment(k, rows).maxCoeff())
      c.segment(k, rows).setZero();
  }
}

SlipCoupling::SlipCoupling(const System& stated, std::shared_ptr<const System> free,
                           const std::vector<SlipRows>& of, const std::vector<double>& lengths,
                           const Instant& at, double tolerance) {
  const Equations its(stated, std::move(free), of, lengths, at);
  const auto m = static_cast<Index>(its.rows.size());
  S.setZero(m, m);
  S_0.setZero(m, m);
  B.setZero(static_cast<Index>(of.size()), m);
  c.setZero(m);
  terms.setZero(m);
  N_0.setZero(static_cast<Index>(of.size()));
  find_rates(its);
  find_responses(its, false, S_0);
  S_0 = (0.5 * (S_0 + S_0.transpose())).eval();
  S = S_0;
  if (!its.slope.empty()) find_responses(its, true, S);
  clear_prescribed(its, tolerance);
}

SlipCoupling SlipCoupling::part(const std::vector<Index>& of, const std::vector<Index>& rows) const {
  SlipCoupling part;
  part.S = S(rows, rows);
  part.S_0 = S_0(rows, rows);
  part.B = B(of, rows);
  part.c = c(rows);
  part.terms = terms(rows);
  part.N_0 = N_0(of);
  return part;
}

}  // namespace dalembert
