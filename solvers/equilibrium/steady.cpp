#include "dalembert/solvers/equilibrium/steady.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/balance.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/equilibrium/symmetries.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>
#include <dalembert/solvers/linear/dense.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::span<const double> flat(const VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }
VectorXd vector_of(std::span<const double> x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size()));
}

/// Newton's iteration for (1) of the header.
class SteadySearch {
 public:
  SteadySearch(const Problem& problem, const Start& start, double time, const std::vector<FlatKept>& keep)
      : problem_(problem),
        system_(&problem_.system()),
        time_(time),
        rows_(start.rows),
        scales_(start.scales),
        keep_(&keep),
        symmetries_(problem, start, time),
        q_(vector_of(start.q)),
        lambda_(vector_of(start.lambda)) {
    const VectorXd v = vector_of(start.v);
    decompose(v);
    require_symmetric(v);
    for (const FlatKept& one : keep) kept_.push_back(value(one, q_, v));
  }

  FoundSteady find() {
    constexpr int most_corrections = 50;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_corrections; ++i) {
      const double size = correct();
      if (!(size < std::numeric_limits<double>::infinity())) refuse("Newton's iteration diverges");
      // It converges quadratically until round-off is left.
      if (size < 1e-9 && size >= 0.5 * before) break;
      if (size < epsilon) break;
      before = size;
    }
    decompose(symmetries_.fields(q_) * y_);
    return finished();
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw NoEquilibrium("Scene \"" + system_->layout()->scene + "\": no steady motion was found: " + why +
                        "; start closer to one, or keep fewer quantities");
  }

  /// The coefficients of given velocities. Where several give the same, parts turn as little as they can.
  void decompose(const VectorXd& v) {
    const MatrixXd X = symmetries_.fields(q_);
    y_ = VectorXd::Zero(symmetries_.size());
    if (y_.size() == 0) return;
    VectorXd root(q_.size());
    for (Index i = 0; i < root.size(); ++i)
      root[i] = std::sqrt(system_->masses()[static_cast<std::size_t>(i)]);
    y_ = dense::least_squares(root.asDiagonal() * X, root.asDiagonal() * v, rank_threshold);
    const MatrixXd same = dense::kernel(root.asDiagonal() * X, rank_threshold);
    if (same.cols() == 0) return;
    const MatrixXd turning = symmetries_.turning();
    y_ -= same * dense::least_squares(turning * same, turning * y_, rank_threshold);
  }

  /// Names what moves otherwise: of its velocity more than half is no symmetry's, so that no steady motion is
  /// near.
  void require_symmetric(const VectorXd& v) const {
    const VectorXd rest = v - symmetries_.fields(q_) * y_;
    const double rounding = 1e-8 * v.cwiseAbs().maxCoeff();
    const auto look = [&](const auto& all, int width) {
      for (const auto& one : all) {
        if (rest.segment(one.coordinate, width).norm() <=
            0.5 * v.segment(one.coordinate, width).norm() + rounding)
          continue;
        throw NoEquilibrium(
            "Scene \"" + system_->layout()->scene + "\": \"" + one.name +
            "\" moves as no symmetry of the scene carries on: a body must be round about the axis "
            "it spins about, with all that acts on it; ask for floquet multipliers of a motion "
            "that is periodic");
      }
    };
    look(system_->layout()->particles, system_->layout()->dimension);
    look(system_->layout()->rotors, 1);
  }

  [[nodiscard]] double value(const FlatKept& one, const VectorXd& q, const VectorXd& v) const {
    FlatSample at;
    at.time = time_;
    at.q = flat(q);
    at.v = flat(v);
    const double x = one.value(at);
    if (!std::isfinite(x)) refuse("\"" + one.name + "\" is not a finite number");
    return x;
  }

  /// One correction; its size, in units of the scene.
  double correct() {
    constexpr double roundings = 10.0;  // of a sum of some dozens of terms
    const RotatingFrame frame(symmetries_.motion(y_));
    const MatrixXd X = symmetries_.fields(q_);
    const VectorXd v = X * y_;
    const Instant at{time_, flat(q_), flat(v)};
    const LinearTerms terms = linear_terms(*system_, frame, at, flat(lambda_));
    auto e = system_->evaluation();
    system_->evaluate(at, e);
    const Index n = q_.size(), p = y_.size(), m = static_cast<Index>(rows_.size()),
                kept = static_cast<Index>(keep_->size());
    VectorXd masses = vector_of(system_->masses()), units(n + p);
    const double fast = std::max(v.cwiseAbs().maxCoeff() / scales_.length, 1e-3 / scales_.time);
    for (Index i = 0; i < n; ++i) units[i] = scales_.unit(static_cast<std::size_t>(i));
    units.tail(p).setConstant(fast);
    MatrixXd J = MatrixXd::Zero(n + m + kept, n + p), J_terms = J, Jl = MatrixXd::Zero(J.rows(), m);
    VectorXd r(J.rows()), terms_of_r = VectorXd::Zero(J.rows());
    // Forces, over the roots of the masses.
    r.head(n) = vector_of(e.force) - masses.cwiseProduct(frame.matrix() * v);
    terms_of_r.head(n) = vector_of(e.force).cwiseAbs() + masses.cwiseProduct(frame.matrix() * v).cwiseAbs();
    const MatrixXd AX = frame.matrix() * X, Xv = symmetries_.images(v);
    J.block(0, n, n, p) = masses.asDiagonal() * (AX - Xv);
    J_terms.block(0, n, n, p) = masses.asDiagonal() * (AX.cwiseAbs() + Xv.cwiseAbs());
    for (const auto& k : terms.stiffness) {
      J(static_cast<Index>(k.row()), static_cast<Index>(k.col())) -= k.value();
      J_terms(static_cast<Index>(k.row()), static_cast<Index>(k.col())) += std::abs(k.value());
    }
    for (const auto& c : terms.damping)
      J.block(static_cast<Index>(c.row()), n, 1, p) -= c.value() * X.row(static_cast<Index>(c.col()));
    for (Index a = 0; a < m; ++a) {
      const std::size_t row = rows_.rows[static_cast<std::size_t>(a)];
      const bool holonomic = row < system_->holonomic_rows();
      r[n + a] =
          holonomic ? system_->law(row).residual(e.g[row], lambda_[static_cast<Index>(row)]) : e.psi[row];
      for (const std::size_t k : system_->row(row)) {
        const auto i = static_cast<Index>(system_->w_columns()[k]);
        const double Z = terms.w[k] * lambda_[static_cast<Index>(row)];
        r[i] += Z;
        terms_of_r[i] += std::abs(Z);
        terms_of_r[n + a] += std::abs(terms.w[k] * (holonomic ? q_[i] : v[i]));
        Jl(i, a) += terms.w[k];
        J(n + a, i) += holonomic ? terms.w[k] : terms.e[k];
        if (!holonomic) J.block(n + a, n, 1, p) += terms.w[k] * X.row(i);
      }
      if (holonomic) Jl(n + a, a) = system_->law(row).compliance;
    }
    for (Index k = 0; k < kept; ++k) add_kept(k, n + m + k, r, terms_of_r, J);
    for (Index i = 0; i < n; ++i) {
      const double root = 1.0 / std::sqrt(masses[i]);
      r[i] *= root;
      terms_of_r[i] *= root;
      J.row(i) *= root;
      J_terms.row(i) *= root;
      Jl.row(i) *= root;
    }
    J = (J * units.asDiagonal()).eval();
    J_terms = J.cwiseAbs().cwiseMax(J_terms * units.asDiagonal());
    rest_along(units.head(n).cwiseInverse().asDiagonal() *
                   symmetries_.displacements(q_, symmetries_.commuting(q_, y_)),
               J.topLeftCorner(n + m, n));
    for (Index i = n; i < J.rows(); ++i) {
      const double length = J.row(i).norm();
      if (length == 0.0) continue;
      J.row(i) /= length;
      J_terms.row(i) /= length;
      Jl.row(i) /= length;
      r[i] /= length;
      terms_of_r[i] /= length;
    }
    const MatrixXd free = m > 0 ? orthogonal_complement(Jl) : MatrixXd::Identity(J.rows(), J.rows());
    MatrixXd left = free.transpose() * J;
    VectorXd right = free.transpose() * r;
    // What balances to round-off stays as it is: beside a fast spin that displaces what is soft.
    const bool balances =
        ((free * right).cwiseAbs().array() <= roundings * epsilon * terms_of_r.array()).all();
    // Forces in units of the stiffness that they change by. What is round-off of its terms changes by
    // nothing.
    const VectorXd least =
        roundings_of_a_sum * epsilon * free.cwiseAbs().transpose() * J_terms.rowwise().maxCoeff();
    for (Index i = 0; i < left.rows(); ++i) {
      const double length = left.row(i).norm(), unit = length > least[i] ? 1.0 / length : 0.0;
      left.row(i) *= unit;
      right[i] *= unit;
    }
    const VectorXd x = balances ? VectorXd(VectorXd::Zero(n + p))
                                : VectorXd(dense::least_squares(left, -right, rank_threshold));
    const double size = x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0;
    const double part = size > 0.2 ? 0.2 / size : 1.0;
    if (!x.allFinite()) return std::numeric_limits<double>::infinity();
    if (m > 0) {
      const VectorXd l = dense::least_squares(Jl, -r - J * x, rank_threshold);
      for (Index a = 0; a < m; ++a)
        lambda_[static_cast<Index>(rows_.rows[static_cast<std::size_t>(a)])] += part * l[a];
    }
    q_ += part * units.head(n).cwiseProduct(x.head(n));
    y_ += part * units.tail(p).cwiseProduct(x.tail(p));
    return size;
  }

  /// Equations do not change along symmetries that commute with the motion, exactly: what is left of their
  /// derivative is round-off of fast spins.
  static void rest_along(const MatrixXd& symmetric, Eigen::Ref<MatrixXd> J) {
    const MatrixXd still = orthogonal_complement(orthogonal_complement(symmetric));
    J -= J * still * still.transpose();
  }

  /// A kept quantity's row, by central differences.
  void add_kept(Index k, Index row, VectorXd& r, VectorXd& terms, MatrixXd& J) const {
    const FlatKept& one = (*keep_)[static_cast<std::size_t>(k)];
    const Index n = q_.size();
    const auto at = [&](const VectorXd& q, const VectorXd& y) {
      return value(one, q, symmetries_.fields(q) * y);
    };
    const double now = at(q_, y_);
    r[row] = now - kept_[static_cast<std::size_t>(k)];
    terms[row] = std::abs(now) + std::abs(kept_[static_cast<std::size_t>(k)]);
    const double h = std::cbrt(epsilon);
    for (Index i = 0; i < J.cols(); ++i) {
      VectorXd q1 = q_, q2 = q_, y1 = y_, y2 = y_;
      double step = h;
      if (i < n) {
        step *= scales_.unit(static_cast<std::size_t>(i));
        q1[i] -= step;
        q2[i] += step;
      } else {
        step /= scales_.time;
        y1[i - n] -= step;
        y2[i - n] += step;
      }
      J(row, i) = (at(q2, y2) - at(q1, y1)) / (2.0 * step);
    }
  }

  [[nodiscard]] FoundSteady finished() const {
    // What moves by less than round-off of a position in the scene's time rests.
    const bool rests = (symmetries_.fields(q_) * y_).cwiseAbs().maxCoeff() <=
                       roundings_of_a_sum * epsilon * scales_.length / scales_.time;
    const VectorXd y = rests ? VectorXd(VectorXd::Zero(y_.size())) : y_;
    auto motion = std::make_shared<UniformMotion>(symmetries_.motion(y));
    const MatrixXd same = symmetries_.commuting(q_, y), X = symmetries_.displacements(q_, same);
    motion->symmetric = X;
    const MatrixXd fixing = same * dense::kernel(X, rank_threshold);
    for (Index k = 0; k < fixing.cols(); ++k) motion->fixing.push_back(symmetries_.motion(fixing.col(k)).A);
    const Balance balance(problem_, flat(q_), time_, RotatingFrame(*motion));
    Balance::State s = balance.start();
    std::ranges::copy(flat(lambda_), s.lambda.begin());
    balance.evaluate(s);
    if (!balance.settled(s, 1e-8)) refuse("forces do not balance");
    balance.require_lasting(s);
    const VectorXd v = vector_of(s.v);
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const double now = value((*keep_)[k], q_, v);
      if (std::abs(now - kept_[k]) > 1e-8 * std::max(1.0, std::abs(kept_[k])))
        refuse("\"" + (*keep_)[k].name + "\" cannot be kept");
    }
    return {balance.record(s), std::move(motion)};
  }

  Problem problem_;
  const System* system_;
  double time_;
  ActiveRows rows_;
  Scales scales_;
  const std::vector<FlatKept>* keep_;
  Symmetries symmetries_;
  VectorXd q_, lambda_, y_;
  std::vector<double> kept_;
};

void require_suited_to_steady(const System& system) {
  const std::string scene = "Steady motions of scene \"" + system.layout()->scene + "\": ";
  if (system.coordinates() > most_dense)
    throw InvalidScene(scene + "they are found up to " + std::to_string(most_dense) + " coordinates");
  if (system.rheonomic())
    throw InvalidScene(scene +
                       "a constraint changes with time; let what it drives turn freely, with its rate as "
                       "stated, or ask for floquet multipliers");
  if (const auto label = system.conditional_label(); !label.empty())
    throw InvalidScene(scene + label + " does not always hold; state it as a bilateral one");
  if (system.frictional()) throw InvalidScene(scene + system.force_of_friction(0) + " reads a multiplier");
}

}  // namespace

FoundSteady find_steady(System system, std::span<const double> q, std::span<const double> v, double time,
                        const std::vector<FlatKept>& keep) {
  if (!std::isfinite(time)) throw InvalidArgument("Option time of a steady motion must be finite");
  require_suited_to_steady(system);
  try {
    const Problem problem(std::move(system));
    const Start start =
        consistent_start(problem, q, v, {.t_end = time + 1.0, .t_start = time, .assemble = true});
    return SteadySearch(problem, start, time, keep).find();
  } catch (const EquationFault& fault) {
    throw NoEquilibrium(fault.what());
  }
}

}  // namespace dalembert
