#include "dalembert/solvers/equilibrium/continuation.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>
#include <dalembert/solvers/linear/dense.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {
using Eigen::Index;

void require_suited(const PosedSystem& posed) {
  const System& system = *posed.system;
  const std::string scene = "Branches of scene \"" + system.layout()->scene + "\": ";
  if (system.coordinates() > most_dense)
    throw InvalidScene(scene + "they are followed up to " + std::to_string(most_dense) + " coordinates");
  if (system.holonomic_rows() < system.rows() && posed.turning.rate.norm() > 0.0)
    throw InvalidScene(scene + system.row_label(system.holonomic_rows()) +
                       " is nonholonomic and turns; follow the motion by follow_steady");
}

Eigen::VectorXd balance_of(const EquilibriumSolver::State& s, const ActiveRows& rows) {
  Eigen::VectorXd r(static_cast<Index>(s.force.size() + rows.size()));
  Index next = 0;
  for (const double force : s.force) r[next++] = force;
  // What rests satisfies the nonholonomic rows.
  for (const std::size_t row : rows.rows) r[next++] = row < s.distance.size() ? s.distance[row] : 0.0;
  return r;
}

}  // namespace

EquilibriumCorrector::EquilibriumCorrector(std::function<PosedSystem(double)> pose_at,
                                           const BranchOptions& options)
    : Corrector(std::move(pose_at), options) {
  const PosedSystem posed = pose(options.from);
  require_suited(posed);
  const auto found = find_equilibrium(*posed.system, posed.guess, posed.time, posed.turning);
  const FlatSample flat = found->sample(0);
  const Scales scales = EquilibriumSolver(Problem(posed.system), flat.q, posed.time, posed.turning).scales();
  for (std::size_t i = 0; i < flat.q.size(); ++i) scale_.push_back(scales.unit(i));
  begin_.x = Eigen::VectorXd::Zero(static_cast<Index>(scale_.size()) + 1);
  for (std::size_t i = 0; i < scale_.size(); ++i) begin_.x[static_cast<Index>(i)] = flat.q[i] / scale_[i];
  begin_.lambda.assign(flat.lambda.begin(), flat.lambda.end());
  const Here here = at(options.from, begin_.x);
  finish(here, state(here, begin_), begin_);
}

EquilibriumCorrector::Here EquilibriumCorrector::at(double p, const Eigen::VectorXd& x) const {
  PosedSystem posed = pose(p);
  std::vector<double> q;
  for (std::size_t i = 0; i < scale_.size(); ++i) q.push_back(x[static_cast<Index>(i)] * scale_[i]);
  if (posed.system->coordinates() != q.size() || posed.system->rows() != begin_.lambda.size())
    throw InvalidScene("Branches of scene \"" + posed.system->layout()->scene +
                       "\": for another value of the parameter it has other points or constraints");
  EquilibriumSolver balance(Problem(posed.system), q, posed.time, posed.turning);
  return {std::move(posed.system), std::move(balance), posed.turning};
}

EquilibriumSolver::State EquilibriumCorrector::state(const Here& here, const Node& node) const {
  EquilibriumSolver::State s = here.balance.start();
  for (std::size_t i = 0; i < scale_.size(); ++i) s.q[i] = node.x[static_cast<Index>(i)] * scale_[i];
  s.lambda = node.lambda;
  here.balance.evaluate(s);
  return s;
}

/// Stores what is read of a point, with multipliers of least norm where rows are dependent.
void EquilibriumCorrector::finish(const Here& here, const EquilibriumSolver::State& s, Node& node) const {
  node.state = {here.balance.record(s), here.turning, nullptr};
  const FlatSample flat = node.state.state->sample(0);
  node.lambda.assign(flat.lambda.begin(), flat.lambda.end());
  const LinearTerms terms =
      linear_terms(*here.system, here.balance.frame(), {flat.time, flat.q, flat.v}, flat.lambda);
  node.stiffness = tangent_stiffness(*here.system, terms);
  node.vibrations = vibrations(*here.system, terms);
}

Eigen::VectorXd Corrector::direction(const Eigen::VectorXd& shape) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(shape.size() + 1);
  for (Index i = 0; i < shape.size(); ++i) x[i] = shape[i] / scale_[static_cast<std::size_t>(i)];
  return x.normalized();
}

std::optional<Node> EquilibriumCorrector::finished(Node guess) const {
  try {
    const Here here = at(parameter(guess), guess.x);
    const EquilibriumSolver::State s = state(here, guess);
    if (!(s.relative_residual <= equilibrium_tolerance)) return std::nullopt;
    finish(here, s, guess);
    return guess;
  } catch (const Error&) {
    return std::nullopt;
  }
}

Eigen::VectorXd EquilibriumCorrector::residual(double p, const Node& node, const ActiveRows& rows) const {
  const Here here = at(p, node.x);
  return balance_of(state(here, node), rows);
}

/// By central differences, one-sided at the ends of the range.
Eigen::VectorXd EquilibriumCorrector::slope_by_parameter(const Node& node, const ActiveRows& rows) const {
  const double h = constants.parameter_difference;
  const double fraction = node.x[node.x.size() - 1], before = std::max(fraction - h, 0.0),
               after = std::min(fraction + h, 1.0);
  return (residual(value(after), node, rows) - residual(value(before), node, rows)) / (after - before);
}

/// With l on the left of K's eigenvalue and m such that (l, m) is on the left of all equations: m balances
/// what l does across the tangent space.
std::optional<double> EquilibriumCorrector::range_defect(const Node& node, Index shape) const {
  const Here here = at(parameter(node), node.x);
  const EquilibriumSolver::State s = state(here, node);
  const Eigen::MatrixXd A = jacobian(here, s, node, here.balance.rows_at(s));
  const auto n = static_cast<Index>(s.q.size()), m = A.rows() - n;
  Eigen::VectorXd left(n + m);
  for (Index i = 0; i < n; ++i)
    left[i] = node.stiffness.duals(i, shape) / here.system->masses()[static_cast<std::size_t>(i)];
  if (m > 0) {
    const Eigen::MatrixXd rows = A.bottomLeftCorner(m, n).transpose(),
                          across = -A.topLeftCorner(n, n).transpose() * left.head(n);
    left.tail(m) = dense::least_squares(rows, across, rank_threshold);
    // With nonholonomic rows fewer equations hold than what may move is free.
    const double terms = (A.topLeftCorner(n, n).cwiseAbs().transpose() * left.head(n).cwiseAbs()).norm();
    const bool regular = (rows * left.tail(m) - across).norm() > std::sqrt(rank_threshold) * terms;
    if (regular && here.system->holonomic_rows() < here.system->rows()) return std::nullopt;
  }
  const Eigen::VectorXd slope = A.col(n + m);
  // Difference quotients keep round-off of the forces that act where the mode moves.
  const Eigen::Map<const Eigen::VectorXd> acting(s.acting.data(), n);
  const double size = std::max(slope.cwiseAbs().dot(left.cwiseAbs()), acting.dot(left.head(n).cwiseAbs()));
  return size > 0.0 ? std::abs(slope.dot(left)) / size : 0.0;
}

/// [R_q R_lambda R_p] in the units of x, one row per coordinate and one per constraint row.
Eigen::MatrixXd EquilibriumCorrector::jacobian(const Here& here, const EquilibriumSolver::State& s,
                                               const Node& node, const ActiveRows& rows) const {
  const LinearTerms terms =
      linear_terms(*here.system, here.balance.frame(), {here.balance.time(), s.q, s.v}, s.lambda);
  const auto n = static_cast<Index>(s.q.size()), m = static_cast<Index>(rows.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m + 1);
  for (const auto& k : terms.stiffness)
    A(static_cast<Index>(k.row()), static_cast<Index>(k.col())) -= k.value() * scale_[k.col()];
  for (Index a = 0; a < m; ++a) {
    const std::size_t r = rows.rows[static_cast<std::size_t>(a)];
    const bool holonomic = r < here.system->holonomic_rows();
    for (const std::size_t k : here.system->row(r)) {
      const std::size_t i = here.system->w_columns()[k];
      A(static_cast<Index>(i), n + a) += terms.w[k];
      if (holonomic) A(n + a, static_cast<Index>(i)) += terms.w[k] * scale_[i];
    }
    if (holonomic) A(n + a, n + a) = here.system->law(r).compliance;
  }
  A.col(n + m) = slope_by_parameter(node, rows);
  return A;
}

std::optional<Eigen::VectorXd> EquilibriumCorrector::tangent(const Node& node) const {
  // Difference quotients err by h times the slope, and by round-off of the forces over h: both with a margin
  // of some tens. Directions in which the matrix is round-off are free motions.
  constexpr double exact = 1e-4, rounding = 1e-8, no_stiffness = 1e-12;
  const Here here = at(parameter(node), node.x);
  const EquilibriumSolver::State s = state(here, node);
  const Eigen::MatrixXd A = jacobian(here, s, node, here.balance.rows_at(s));
  const Index last = A.cols() - 1;
  const Eigen::VectorXd slope = A.col(last);
  const Eigen::VectorXd change = dense::least_squares(A.leftCols(last), -slope, no_stiffness);
  const double off = (A.leftCols(last) * change + slope).norm();
  if (!(off <= exact * slope.norm() + rounding * s.scale)) return std::nullopt;
  Eigen::VectorXd along(node.x.size());
  along << change.head(along.size() - 1), 1.0;
  return along.normalized();
}

void EquilibriumCorrector::newton_step(const Here& here, const EquilibriumSolver::State& s, double off,
                                       const Eigen::VectorXd& normal, Node& node) const {
  const ActiveRows rows = here.balance.rows_at(s);
  const auto n = static_cast<Index>(s.q.size()), m = static_cast<Index>(rows.size());
  Eigen::MatrixXd A(n + m + 1, n + m + 1);
  A.topRows(n + m) = jacobian(here, s, node, rows);
  A.row(n + m).setZero();
  A.row(n + m).head(n) = normal.head(n);
  A(n + m, n + m) = normal[n];
  Eigen::VectorXd b(n + m + 1);
  b << balance_of(s, rows), off;
  const double rounding = epsilon * static_cast<double>(A.rows());
  const Eigen::VectorXd step = dense::least_squares(A, -b, rounding);
  node.x.head(n) += step.head(n);
  node.x[n] += step[n + m];
  for (Index a = 0; a < m; ++a) node.lambda[rows.rows[static_cast<std::size_t>(a)]] += step[n + a];
}

std::optional<Node> EquilibriumCorrector::correct(const Node& guess, const Eigen::VectorXd& normal) const {
  constexpr int most_corrections = 20;
  constexpr double rounding = epsilon;
  Node node = guess;
  double before = std::numeric_limits<double>::infinity();
  try {
    for (int i = 0; i < most_corrections; ++i) {
      const Here here = at(parameter(node), node.x);
      const EquilibriumSolver::State s = state(here, node);
      const double off = normal.dot(node.x - guess.x), size = s.relative_residual + std::abs(off);
      if (size <= rounding || (size <= residual_tolerance && size >= 0.5 * before)) {
        finish(here, s, node);
        return node;
      }
      before = size;
      newton_step(here, s, off, normal, node);
      double& fraction = node.x[node.x.size() - 1];
      if (!node.x.allFinite()) break;
      fraction = std::clamp(fraction, 0.0, 1.0);  // a point beyond is then never found
    }
    why_ = "Newton's iteration does not converge";
  } catch (const EquationFault& fault) {
    why_ = fault.what();
  } catch (const InconsistentStart& start) {
    why_ = start.what();
  } catch (const NoEquilibrium& none) {
    why_ = none.what();
  }
  return std::nullopt;
}

}  // namespace dalembert
