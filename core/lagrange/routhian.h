#pragma once

#include <dalembert/core/lagrange/lagrangian_system.h>

#include <limits>
#include <stdexcept>

namespace dalembert {

/// The Routhian of a Lagrangian one of whose coordinates, x, is cyclic, so that its momentum beta = L_x' is
/// conserved (notes, mex115):
///
///   R(t, q, v; beta) = L - beta x',   x' = x'(t, q, v; beta) from L_x' = beta,                           (1)
///
/// is a Lagrangian of the other coordinates. As dR = dL - beta dx' along (1), R_q = L_q and R_v = L_v; the
/// second derivatives are those of L with x' eliminated, R_vv = L_vv - L_vx' L_x'v / L_x'x' and likewise.
template <int N>
class Routhian final : public Lagrangian<N - 1> {
 public:
  /// Made by `reduced`.
  Routhian(std::shared_ptr<const Lagrangian<N>> of, int cyclic, double place, double rate, double momentum)
      : of_(std::move(of)), cyclic_(cyclic), place_(place), rate_(rate), momentum_(momentum) {}

  /// Asks at every call whether L depends on x; throws std::domain_error where it does.
  [[nodiscard]] LagrangeTerms<N - 1> terms(double t, const Vec<N - 1>& q, const Vec<N - 1>& v) const override;
  /// x' in (1), by Newton's iteration: one step where L is quadratic in it. Throws EquationFault where no
  /// rate gives the momentum.
  [[nodiscard]] double rate(double t, const Vec<N - 1>& q, const Vec<N - 1>& v) const {
    return solve(t, q, v).second;
  }
  /// That is conserved.
  [[nodiscard]] double momentum() const { return momentum_; }

 private:
  /// The number among all N coordinates of the k-th that is left.
  [[nodiscard]] int among_all(int k) const { return k < cyclic_ ? k : k + 1; }
  [[nodiscard]] Vec<N> with(double x, const Vec<N - 1>& others) const {
    Vec<N> all;
    all[cyclic_] = x;
    for (int k = 0; k < N - 1; ++k) all[among_all(k)] = others[k];
    return all;
  }
  template <class All>
  [[nodiscard]] Vec<N - 1> others(const All& all) const {
    Vec<N - 1> rest;
    for (int k = 0; k < N - 1; ++k) rest[k] = all[among_all(k)];
    return rest;
  }
  [[nodiscard]] std::pair<LagrangeTerms<N>, double> solve(double t, const Vec<N - 1>& q,
                                                          const Vec<N - 1>& v) const;

  std::shared_ptr<const Lagrangian<N>> of_;
  int cyclic_;
  double place_, rate_, momentum_;
};

template <int N>
std::pair<LagrangeTerms<N>, double> Routhian<N>::solve(double t, const Vec<N - 1>& q,
                                                       const Vec<N - 1>& v) const {
  constexpr int most_steps = 50;
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  double rate = rate_, step = 0.0, before = std::numeric_limits<double>::infinity();
  const std::size_t begin = Branches::next();
  for (int i = 0; i < most_steps; ++i) {
    Branches::again(begin);
    const LagrangeTerms<N> terms = of_->terms(t, with(place_, q), with(rate, v));
    const double off = momentum_ - terms.L_v[cyclic_];
    // Of the terms that the momentum is the sum of.
    const double size =
        std::abs(momentum_) + terms.L_vv.row(cyclic_).transpose().cwiseAbs().dot(with(rate, v).cwiseAbs());
    if (std::abs(off) <= rounding * size) return {terms, rate};
    if (std::abs(off) < before) {
      step = off / terms.L_vv(cyclic_, cyclic_);
      before = std::abs(off);
    } else {  // it was too long
      rate -= step;
      step *= 0.5;
    }
    if (!std::isfinite(step)) break;
    rate += step;
  }
  throw EquationFault("no rate of the cyclic coordinate has the momentum " + detail::text(momentum_) +
                      " at t = " + detail::text(t) + "; do without the reduction");
}

template <int N>
LagrangeTerms<N - 1> Routhian<N>::terms(double t, const Vec<N - 1>& q, const Vec<N - 1>& v) const {
  const auto [L, rate] = solve(t, q, v);
  if (!detail::independent_of(*of_, cyclic_, t, with(place_, q), with(rate, v)))
    throw std::domain_error("depends, at t = " + detail::text(t) +
                            ", on the coordinate that was left out as cyclic; do without the reduction");
  const double inertia = L.L_vv(cyclic_, cyclic_);
  const Vec<N - 1> coupling = others(L.L_vv.col(cyclic_));
  LagrangeTerms<N - 1> R;
  R.L = L.L - momentum_ * rate;
  R.L_q = others(L.L_q);
  R.L_v = others(L.L_v);
  R.L_vt = others(L.L_vt) - coupling * (L.L_vt[cyclic_] / inertia);
  const Vec<N - 1> through = others(L.L_vq.row(cyclic_));
  for (int k = 0; k < N - 1; ++k) {
    R.L_vv.set_col(k, others(L.L_vv.col(among_all(k))) - coupling * (coupling[k] / inertia));
    R.L_vq.set_col(k, others(L.L_vq.col(among_all(k))) - coupling * (through[k] / inertia));
  }
  return R;
}

/// A Lagrangian without one of its cyclic coordinates: the system of the others, and the Routhian, which
/// gives the rate of that one along their motion.
template <int N>
struct RouthReduction {
  LagrangianSystem<N - 1> system;               ///< of the other coordinates
  std::shared_ptr<const Routhian<N>> routhian;  ///< that gives the rate of the cyclic one
};

/// Leaves a cyclic coordinate out, with the momentum that it has at the start. Throws InvalidArgument if L
/// depends on it, or if there are constraints or forces Q besides.
template <int N>
  requires(N > 1)
[[nodiscard]] RouthReduction<N> reduced(const LagrangianSystem<N>& system, int coordinate,
                                        double t_start = 0.0) {
  if (coordinate < 0 || coordinate >= N)
    throw InvalidArgument("Lagrangian \"" + system.name() + "\" has no coordinate " +
                          std::to_string(coordinate) + "; they are counted from 0");
  const std::string label = "Coordinate \"" + system.name(coordinate) + "\" of \"" + system.name() + '"';
  if (!system.is_cyclic(coordinate))
    throw InvalidArgument(label + " is not cyclic: the Lagrangian depends on it");
  if (system.constrained() || system.forced())
    throw InvalidArgument(label +
                          ": its momentum is not conserved where there are constraints or forces besides "
                          "the Lagrangian; leave it in");
  const Vec<N> q = system.position(), v = system.velocity();
  const double momentum = system.lagrangian()->terms(t_start, q, v).L_v[coordinate];
  auto routhian = std::make_shared<const Routhian<N>>(system.lagrangian(), coordinate, q[coordinate],
                                                      v[coordinate], momentum);
  CoordinateState<N - 1> rest;
  for (int k = 0; k < N - 1; ++k) {
    const int from = k < coordinate ? k : k + 1;
    rest.position[k] = q[from];
    rest.velocity[k] = v[from];
    rest.scale[k] = system.scale()[from];
    rest.names[static_cast<std::size_t>(k)] = system.name(from);
  }
  return {LagrangianSystem<N - 1>(rest, routhian, system.name()), routhian};
}

}  // namespace dalembert
