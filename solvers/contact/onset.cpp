#include "dalembert/solvers/contact/onset.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/cones.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Newton's iteration on modes takes a few steps; directions that depend on each other converge linearly.
constexpr int most_iterations = 100;

/// (1) of some frictions at rest with the bounds mu.
class Modes {
 public:
  Modes(const SlipCoupling& coupling, const std::vector<AtRest>& of, const std::vector<double>& mu)
      : its_(coupling), of_(of), mu_(mu), N_(coupling.N_0), sigma_(VectorXd::Zero(coupling.c.size())) {
    Index first = 0;
    for (const AtRest& one : of) {
      first_.push_back(first);
      first += size(one);
    }
  }

  [[nodiscard]] bool converge() {
    for (int k = 0; k < most_iterations; ++k) {
      dissipate();
      const VectorXd before = sigma_, lagged = (its_.S - its_.S_0) * before, N = N_;
      solve();
      N_ = its_.N_0 + its_.B * sigma_;
      const VectorXd change = (its_.S - its_.S_0) * sigma_ - lagged;
      if (!sigma_.allFinite()) return false;
      if (((N_ - N).cwiseAbs().array() <= round_off() * N_.cwiseAbs().array()).all() &&
          (change.cwiseAbs().array() <= round_off() * units().array()).all())
        return true;
    }
    return false;
  }
  [[nodiscard]] const std::vector<Onset::Part>& parts() const { return parts_; }

 private:
  [[nodiscard]] static Index size(const AtRest& one) { return static_cast<Index>(one.rows.rows); }
  [[nodiscard]] Index place(std::size_t i) const { return first_[i]; }
  [[nodiscard]] double bound(std::size_t i) const { return mu_[i] * std::abs(N_[static_cast<Index>(i)]); }
  [[nodiscard]] VectorXd bounds() const {
    VectorXd b(its_.c.size());
    for (std::size_t i = 0; i < of_.size(); ++i) b.segment(place(i), size(of_[i])).setConstant(bound(i));
    return b;
  }
  /// Of the rates: what each is made of.
  [[nodiscard]] VectorXd units() const { return its_.terms + its_.S_0.cwiseAbs() * bounds(); }

  /// (2), in the units of each friction's own bound.
  void dissipate() {
    const VectorXd b = bounds(), unit = units(), c = its_.c + (its_.S - its_.S_0) * sigma_;
    ConeProgram program{b.asDiagonal() * its_.S_0 * b.asDiagonal(), b.cwiseProduct(c), {}};
    for (std::size_t i = 0; i < of_.size(); ++i) {
      const Index k = place(i), n = size(of_[i]);
      const double power = bound(i) * unit.segment(k, n).maxCoeff();
      MatrixXd A = MatrixXd::Zero(n, c.size());
      A.middleCols(k, n).setIdentity();
      program.cones.push_back({A, VectorXd::Zero(n), VectorXd::Zero(c.size()), 1.0,
                               std::max(power, std::numeric_limits<double>::min())});
      if (power > 0.0) continue;
      program.Q.diagonal().segment(k, n).setOnes();  // there is no friction
      program.c.segment(k, n).setZero();
    }
    const VectorXd x = program.minimum(VectorXd::Zero(c.size())), rate = c + its_.S_0 * b.cwiseProduct(x);
    parts_.clear();
    for (std::size_t i = 0; i < of_.size(); ++i) {
      const Index k = place(i), n = size(of_[i]);
      const double part = rate.segment(k, n).norm(), terms = unit.segment(k, n).maxCoeff();
      const VectorXd share = x.segment(k, n);
      const bool free = bound(i) == 0.0;
      const bool slides = free ? part > round_off() * terms : part > terms * (1.0 - share.norm());
      if (!slides)
        parts_.push_back({});
      else
        parts_.push_back({true, free ? (rate.segment(k, n) / part).eval() : (-share.normalized()).eval()});
    }
  }

  /// (1) with these modes and directions, in the same units.
  void solve() {
    const VectorXd b = bounds(), unit = units();
    MatrixXd equations(b.size(), b.size());
    VectorXd right(b.size());
    for (std::size_t i = 0; i < of_.size(); ++i) {
      const Index k = place(i), n = size(of_[i]), own = static_cast<Index>(i);
      if (!parts_[i].slides) {
        equations.middleRows(k, n) = its_.S.middleRows(k, n) * b.asDiagonal();
        right.segment(k, n) = -its_.c.segment(k, n);
        const double size = std::max(unit.segment(k, n).maxCoeff(), std::numeric_limits<double>::min());
        equations.middleRows(k, n) /= size;
        right.segment(k, n) /= size;
        continue;
      }
      const VectorXd strength = std::copysign(mu_[i], N_[own]) * parts_[i].direction;
      equations.middleRows(k, n) = strength * its_.B.row(own) * b.asDiagonal();
      equations.block(k, k, n, n).diagonal() += b.segment(k, n);
      right.segment(k, n) = -strength * its_.N_0[own];
      if (bound(i) == 0.0) continue;
      equations.middleRows(k, n) /= bound(i);
      right.segment(k, n) /= bound(i);
    }
    sigma_ = b.cwiseProduct(VectorXd(dense::least_squares(equations, right, rank_threshold)));
  }

  const SlipCoupling& its_;
  const std::vector<AtRest>& of_;
  const std::vector<double>& mu_;
  VectorXd N_, sigma_;
  std::vector<Index> first_;
  std::vector<Onset::Part> parts_;
};

}  // namespace

std::optional<Onset> Onset::find(const SlipCoupling& coupling, const std::vector<AtRest>& of) {
  std::vector<double> mu;
  std::vector<char> let_go;
  for (const AtRest& one : of) {
    const bool same = one.mu == one.mu_static;
    mu.push_back(!one.reached ? one.mu_static : same ? one.mu * (1.0 - std::sqrt(round_off())) : one.mu);
    let_go.push_back(one.reached || same);
  }
  while (true) {
    Modes modes(coupling, of, mu);
    if (!modes.converge()) return std::nullopt;
    bool more = false;
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (!modes.parts()[i].slides || let_go[i]) continue;
      let_go[i] = more = true;
      mu[i] = of[i].mu;
    }
    if (!more) return Onset{modes.parts()};
  }
}

}  // namespace dalembert
