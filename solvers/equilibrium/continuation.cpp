#include "dalembert/solvers/equilibrium/continuation.h"

#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

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

/// The largest force of each uncoupled part: that acts, that a unit of x changes or that the range of p does;
/// `most` of one without any. A holds these changes.
std::vector<double> forces_of_parts(const Islands& parts, std::span<const double> acting,
                                    const Eigen::MatrixXd& A, const Eigen::VectorXd& slope, double most) {
  std::vector<double> forces(parts.count);
  for (std::size_t i = 0; i < acting.size(); ++i) {
    const auto k = static_cast<Index>(i);
    double& own = forces[parts.of_coordinate[i]];
    own = std::max({own, acting[i], A.row(k).lpNorm<Eigen::Infinity>(), std::abs(slope[k])});
  }
  std::ranges::replace(forces, 0.0, most);
  return forces;
}

}  // namespace

EquilibriumCorrector::EquilibriumCorrector(std::function<PosedSystem(double)> pose_at,
                                           const BranchOptions& options)
    : Corrector(std::move(pose_at), options) {
  const PosedSystem posed = pose(options.from);
  require_suited(posed);
  const auto found = find_equilibrium(*posed.system, posed.guess, posed.time, posed.turning);
  const FlatSample flat = found->sample(0);
  length_ = found->statistics.length;
  const Scales scales =
      EquilibriumSolver(Problem(posed.system), flat.q, posed.time, posed.turning, length_).scales();
  for (std::size_t i = 0; i < flat.q.size(); ++i) scale_.push_back(scales.unit(i));
  begin_.x = Eigen::VectorXd::Zero(static_cast<Index>(scale_.size()) + 1);
  for (std::size_t i = 0; i < scale_.size(); ++i) begin_.x[static_cast<Index>(i)] = flat.q[i] / scale_[i];
  begin_.lambda.assign(flat.lambda.begin(), flat.lambda.end());
  find_symmetries();
  const Here here = at(options.from, begin_.x);
  finish(here, state(here, begin_), begin_);
}

/// Those of the scene at a value of the parameter at which nothing is special, as it may be at the ends of
/// its range: without a load a scene has more. They are sought from a state beside the first: columns in line
/// and rods in a plane have dependent rows. Where a scene has no such states none are known.
void EquilibriumCorrector::find_symmetries() {
  constexpr double inside = 0.618, beside = 0.02;  // 0.31 and 0.77, 0.005 and 0.08 find the same
  try {
    const PosedSystem posed = pose(value(inside));
    if (posed.system->coordinates() != scale_.size()) return;
    const RotatingFrame frame(*posed.system->layout(), posed.turning);
    Eigen::VectorXd q = positions(begin_.x);
    for (Index i = 0; i < q.size(); ++i)
      q[i] += beside * scale_[static_cast<std::size_t>(i)] * std::sin(1.37 * static_cast<double>(i + 1));
    const std::vector<double> all(q.begin(), q.end());
    std::vector<double> v(all.size());
    frame.velocity(all, v);
    const double duration = frame.rotates() ? 1.0 / frame.rate() : 1.0;
    const Problem problem(posed.system);
    const Start start = consistent_start(
        problem, all, v,
        {.t_end = posed.time + duration, .t_start = posed.time, .assemble = true, .length = length_});
    Symmetries found(problem, start, posed.time);
    if (found.size() == 0) return;
    kept_ = found.commuting(q, frame);
    symmetries_ = std::move(found);
  } catch (const Error&) {
    symmetries_.reset();
  }
}

Eigen::VectorXd EquilibriumCorrector::positions(const Eigen::VectorXd& x) const {
  return x.head(std::ssize(scale_))
      .cwiseProduct(Eigen::Map<const Eigen::VectorXd>(scale_.data(), std::ssize(scale_)));
}

Eigen::MatrixXd EquilibriumCorrector::displacements(const Eigen::VectorXd& x) const {
  if (!symmetries_) return Eigen::MatrixXd(std::ssize(scale_), 0);
  return symmetries_->displacements(positions(x), kept_);
}

EquilibriumCorrector::Here EquilibriumCorrector::at(double p, const Eigen::VectorXd& x) const {
  PosedSystem posed = pose(p);
  const Eigen::VectorXd flat = positions(x);
  const std::vector<double> q(flat.begin(), flat.end());
  if (posed.system->coordinates() != q.size() || posed.system->rows() != begin_.lambda.size())
    throw InvalidScene("Branches of scene \"" + posed.system->layout()->scene +
                       "\": for another value of the parameter it has other points or constraints");
  const Problem problem(posed.system);
  EquilibriumSolver balance(problem, q, posed.time, posed.turning, length_);
  return {std::move(posed.system), problem, std::move(balance), posed.turning};
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
  node.stiffness = tangent_stiffness(*here.system, terms, displacements(node.x));
  node.vibrations = vibrations(*here.system, terms);
}

PosedSystem Corrector::pose(double p) const {
  std::string thrown = "threw something that is no std::exception";
  try {
    return pose_(p);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    thrown = std::string("threw \"") + error.what() + '"';
  } catch (...) {
  }
  throw InvalidScene("Branches: the function that builds the scene " + thrown +
                     " at parameter = " + detail::text(p));
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
    if (!(s.relative_residual <= equilibrium_tolerance)) {
      const ActiveRows rows = here.balance.rows_at(s);
      if (!(unbalanced(s, rows, linear(here, s, guess, rows)) <= residual_tolerance)) return std::nullopt;
    }
    finish(here, s, guess);
    return guess;
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// A drive that the frame does not turn with, or a force of time, may begin within the range of p.
bool EquilibriumCorrector::lasts(const Node& node) const {
  try {
    const Here here = at(parameter(node), node.x);
    here.balance.require_lasting(state(here, node));
    return true;
  } catch (const Error& error) {
    why_ = error.what();
    return false;
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

/// What K sums, without signs, in the units of x.
Eigen::MatrixXd EquilibriumCorrector::sizes_of_stiffness(const Node& node) const {
  const Here here = at(parameter(node), node.x);
  const EquilibriumSolver::State s = state(here, node);
  Eigen::MatrixXd sizes = Eigen::MatrixXd::Zero(std::ssize(s.q), std::ssize(s.q));
  for (const auto& k :
       linear_terms(*here.system, here.balance.frame(), {here.balance.time(), s.q, s.v}, s.lambda).stiffness)
    sizes(static_cast<Index>(k.row()), static_cast<Index>(k.col())) += std::abs(k.value()) * scale_[k.col()];
  return sizes;
}

/// With l on the left of K's eigenvalue, (l, m) is on the left of all equations if m balances what l does
/// across the tangent space. With nonholonomic rows fewer equations hold than what may move is free. At the
/// point K itself may have cancelled: what is left is measured by K at both ends of the step, too.
bool EquilibriumCorrector::is_singular(const Node& node, Index shape, const Node& a, const Node& b) const {
  const Here here = at(parameter(node), node.x);
  if (here.system->holonomic_rows() == here.system->rows()) return true;
  const EquilibriumSolver::State s = state(here, node);
  const ActiveRows active = here.balance.rows_at(s);
  const Linear all = linear(here, s, node, active);
  const auto n = static_cast<Index>(s.q.size()), m = static_cast<Index>(active.size());
  Eigen::VectorXd left(n);
  for (Index i = 0; i < n; ++i)
    left[i] = node.stiffness.duals(i, shape) / here.system->masses()[static_cast<std::size_t>(i)];
  const Eigen::MatrixXd K = all.A.topLeftCorner(n, n) * all.force, rows = all.A.block(n, 0, m, n).transpose();
  const Eigen::VectorXd across = -(K.transpose() * left);
  const Eigen::MatrixXd balance = dense::least_squares(rows, across, rank_threshold);
  const Eigen::MatrixXd sizes = sizes_of_stiffness(a) + sizes_of_stiffness(node) + sizes_of_stiffness(b);
  const double terms = (sizes.transpose() * Eigen::VectorXd(left.cwiseAbs())).norm();
  return (rows * balance - across).norm() <= std::sqrt(rank_threshold) * terms;
}

/// On the eigenvectors each symmetry is z -> B z. The orbit of some z fills the sphere if it has its
/// dimension (compact groups).
std::vector<Corrector::Orbit> EquilibriumCorrector::orbits(const Node& node,
                                                           const std::vector<Index>& shapes) const {
  if (!symmetries_) return Corrector::orbits(node, shapes);
  const auto d = static_cast<Index>(shapes.size());
  const Eigen::MatrixXd fixing = kept_ * dense::kernel(displacements(node.x), rank_threshold);
  const Eigen::MatrixXd right = node.stiffness.shapes(Eigen::all, shapes),
                        left = node.stiffness.duals(Eigen::all, shapes);
  std::vector<Eigen::MatrixXd> all;
  Eigen::MatrixXd coupled = Eigen::MatrixXd::Zero(d, d);
  for (Index k = 0; k < fixing.cols(); ++k) {
    all.emplace_back(left.transpose() * Eigen::MatrixXd(symmetries_->motion(fixing.col(k)).A * right));
    coupled = coupled.cwiseMax(all.back().cwiseAbs()).eval();
  }
  const double least = std::sqrt(rank_threshold) * (d > 0 ? coupled.maxCoeff() : 0.0);
  std::vector<Index> left_over(shapes.size());
  std::iota(left_over.begin(), left_over.end(), Index{0});
  std::vector<Orbit> found;
  while (!left_over.empty()) {
    std::vector<Index> own{left_over.front()};
    left_over.erase(left_over.begin());
    for (std::size_t k = 0; k < own.size(); ++k) {
      std::erase_if(left_over, [&](Index i) {
        if (!(std::max(coupled(i, own[k]), coupled(own[k], i)) > least)) return false;
        own.push_back(i);
        return true;
      });
    }
    const auto size = static_cast<Index>(own.size());
    const Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(size, 1.0, 2.0);
    Eigen::MatrixXd orbit(size, std::ssize(all));
    for (Index k = 0; k < orbit.cols(); ++k) orbit.col(k) = all[static_cast<std::size_t>(k)](own, own) * z;
    const bool whole = size > 1 && dense::row_space(orbit.transpose(), rank_threshold).cols() == size - 1;
    for (Index& i : own) i = shapes[static_cast<std::size_t>(i)];
    found.push_back({std::move(own), whole});
  }
  return found;
}

EquilibriumCorrector::Linear EquilibriumCorrector::linear(const Here& here, const EquilibriumSolver::State& s,
                                                          const Node& node, const ActiveRows& rows) const {
  const LinearTerms terms =
      linear_terms(*here.system, here.balance.frame(), {here.balance.time(), s.q, s.v}, s.lambda);
  Eigen::MatrixXd X = displacements(node.x);
  for (Index i = 0; X.cols() > 0 && i < X.rows(); ++i) X.row(i) /= scale_[static_cast<std::size_t>(i)];
  X = orthonormal_span(std::move(X));
  const auto n = static_cast<Index>(s.q.size()), m = static_cast<Index>(rows.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m + X.cols(), n + m + 1);
  for (const auto& k : terms.stiffness)
    A(static_cast<Index>(k.row()), static_cast<Index>(k.col())) -= k.value() * scale_[k.col()];
  const Eigen::VectorXd slope = slope_by_parameter(node, rows);
  const double most = std::max({A.cwiseAbs().maxCoeff(), slope.head(n).cwiseAbs().maxCoeff(), s.scale}),
               force = most > 0.0 ? most : 1.0;
  const Islands& parts = here.problem.islands();
  const std::vector<double> own = forces_of_parts(parts, s.acting, A.topLeftCorner(n, n), slope, force);
  Eigen::VectorXd units = Eigen::VectorXd::Constant(n + m, force), sizes = units;
  for (Index i = 0; i < n; ++i) sizes[i] = own[parts.of_coordinate[static_cast<std::size_t>(i)]];
  for (Index a = 0; a < m; ++a) {
    const std::size_t r = rows.rows[static_cast<std::size_t>(a)];
    const bool holonomic = r < here.system->holonomic_rows();
    for (const std::size_t k : here.system->row(r)) {
      const std::size_t i = here.system->w_columns()[k];
      A(static_cast<Index>(i), n + a) += terms.w[k] * force;
      if (holonomic) A(n + a, static_cast<Index>(i)) += terms.w[k] * scale_[i];
    }
    if (holonomic) A(n + a, n + a) = here.system->law(r).compliance * force;
  }
  A.block(0, n + m, n + m, 1) = slope;
  for (Index a = n; a < n + m; ++a) {
    const double length = A.row(a).head(n + m).norm(), yields = A(a, a) / force,
                 across = A.row(a).head(n).norm(),
                 share = own[parts.of_row(*here.system, rows.rows[static_cast<std::size_t>(a - n)])];
    units[a] = length > 0.0 ? length : 1.0;
    sizes[a] = length > 0.0 ? std::hypot(across, yields * share) : 1.0;
  }
  A.topRows(n + m) = (units.cwiseInverse().asDiagonal() * A.topRows(n + m)).eval();
  A.bottomLeftCorner(X.cols(), n) = X.transpose();
  return {std::move(A), force, std::move(units), std::move(sizes)};
}

std::optional<Eigen::VectorXd> EquilibriumCorrector::tangent(const Node& node) const {
  // Difference quotients err by h times the slope, and by round-off of the forces over h: both with a margin
  // of some tens. Directions in which the matrix is round-off are free motions.
  constexpr double exact = 1e-4, rounding = 1e-8, no_stiffness = 1e-12;
  const Here here = at(parameter(node), node.x);
  const EquilibriumSolver::State s = state(here, node);
  const Linear all = linear(here, s, node, here.balance.rows_at(s));
  const Index last = all.A.cols() - 1;
  const Eigen::VectorXd slope = all.A.col(last);
  const Eigen::VectorXd change = dense::least_squares(all.A.leftCols(last), -slope, no_stiffness);
  const double off = (all.A.leftCols(last) * change + slope).norm();
  if (!(off <= exact * slope.norm() + rounding * s.scale / all.force)) return std::nullopt;
  Eigen::VectorXd along(node.x.size());
  along << change.head(along.size() - 1), 1.0;
  return along.normalized();
}

/// Where forces cancel within one law nothing tells what they are sums of: so by what they change by. Of each
/// uncoupled part, as beside a large one a small one is balanced by nothing.
double EquilibriumCorrector::unbalanced(const EquilibriumSolver::State& s, const ActiveRows& rows,
                                        const Linear& all) {
  return balance_of(s, rows).cwiseQuotient(all.sizes).lpNorm<Eigen::Infinity>();
}

Eigen::VectorXd EquilibriumCorrector::solution(const Linear& all, const Eigen::VectorXd& normal,
                                               const Eigen::VectorXd& right, double across) {
  const Index n = normal.size() - 1, rows = all.A.rows();
  Eigen::MatrixXd A(rows + 1, all.A.cols());
  A.topRows(rows) = all.A;
  A.row(rows).setZero();
  A.row(rows).head(n) = normal.head(n);
  A(rows, A.cols() - 1) = normal[n];
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows + 1);
  b.head(right.size()) = right.cwiseQuotient(all.units);
  b[rows] = across;
  const double rounding = epsilon * static_cast<double>(A.rows());
  return dense::least_squares(A, b, rounding);
}

double EquilibriumCorrector::parameter_slope(const Node& node, const Eigen::VectorXd& normal) const {
  const Here here = at(parameter(node), node.x);
  const EquilibriumSolver::State s = state(here, node);
  const ActiveRows rows = here.balance.rows_at(s);
  const Linear all = linear(here, s, node, rows);
  return solution(all, normal, Eigen::VectorXd::Zero(all.units.size()), 1.0).tail(1).value();
}

std::optional<Node> EquilibriumCorrector::correct(const Node& guess, const Eigen::VectorXd& normal) const {
  constexpr int most_corrections = 20;
  constexpr double rounding = epsilon;
  Node node = guess;
  double before = std::numeric_limits<double>::infinity(), change_before = before;
  // To round-off, be that of the equations themselves.
  const auto settled = [](double size, double last) {
    return size <= rounding || (size <= residual_tolerance && size >= 0.5 * last);
  };
  try {
    for (int i = 0; i < most_corrections; ++i) {
      const Here here = at(parameter(node), node.x);
      const EquilibriumSolver::State s = state(here, node);
      const double off = normal.dot(node.x - guess.x), size = s.relative_residual + std::abs(off);
      if (settled(size, std::exchange(before, size))) {
        finish(here, s, node);
        return node;
      }
      const ActiveRows rows = here.balance.rows_at(s);
      const Linear all = linear(here, s, node, rows);
      const double change = std::max(unbalanced(s, rows, all), std::abs(off));
      if (settled(change, std::exchange(change_before, change))) {
        finish(here, s, node);
        return node;
      }
      const Eigen::VectorXd step = solution(all, normal, -balance_of(s, rows), -off);
      const Index n = node.x.size() - 1;
      node.x.head(n) += step.head(n);
      node.x[n] += step[step.size() - 1];
      for (std::size_t a = 0; a < rows.size(); ++a)
        node.lambda[rows.rows[a]] += all.force * step[n + static_cast<Index>(a)];
      double& fraction = node.x[n];
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
