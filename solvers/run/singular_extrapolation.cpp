#include "dalembert/solvers/run/singular_extrapolation.h"

#include <dalembert/solvers/base/constants.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// So many steps are kept: what error control adds to the halvings of the distance.
constexpr std::size_t kept = 16;
/// Of two more than the nodes, where an end is known too: c[k] of x^k.
using Polynomial = std::array<double, SingularExtrapolation::most_nodes + 2>;

/// p(x), and its integrals int p and int (x - s) p(s) ds from 0 to x.
struct Weights {
  double value = 0.0, once = 0.0, twice = 0.0;

  void add(double factor, const Weights& other) {
    value += factor * other.value;
    once += factor * other.once;
    twice += factor * other.twice;
  }
};

Weights integrals(const Polynomial& c, double x) {
  Weights w;
  double power = 1.0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const auto degree = static_cast<double>(k);
    w.value += c[k] * power;
    w.once += c[k] * power * x / (degree + 1.0);
    w.twice += c[k] * power * x * x / ((degree + 1.0) * (degree + 2.0));
    power *= x;
  }
  return w;
}

/// c (x - root)
void multiply(Polynomial& c, double root) {
  for (std::size_t k = c.size() - 1; k > 0; --k) c[k] = c[k - 1] - root * c[k];
  c[0] *= -root;
}

/// The product of all x - x_j but that of `left_out`.
Polynomial nodal(std::span<const double> x, std::size_t left_out) {
  Polynomial c{1.0};
  for (std::size_t j = 0; j < x.size(); ++j)
    if (j != left_out) multiply(c, x[j]);
  return c;
}

/// Lagrange's: 1 at one node, 0 at the others.
Polynomial lagrange(std::span<const double> x, std::size_t node) {
  Polynomial c = nodal(x, node);
  double scale = 1.0;
  for (std::size_t j = 0; j < x.size(); ++j)
    if (j != node) scale *= x[node] - x[j];
  for (double& c_k : c) c_k /= scale;
  return c;
}

}  // namespace

SingularExtrapolation::SingularExtrapolation(std::size_t n) : accelerations_(kept * n), past_(kept) {
  for (std::size_t i = 0; i < past_.size(); ++i) past_[i].a = accelerations_.data() + i * n;
}

void SingularExtrapolation::remember(double t, std::span<const double> a) {
  std::rotate(past_.begin(), past_.end() - 1, past_.end());  // clang 14 has no std::ranges::rotate
  past_.front().t = t;
  std::ranges::copy(a, past_.front().a);
  known_ = std::min(known_ + 1, past_.size() - 1);  // one more is there for those chosen before
  for (std::size_t& i : chosen_) ++i;
}

std::size_t SingularExtrapolation::choose(double singular) {
  count_ = 0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < known_ && count_ < most_nodes; ++i) {
    const double distance = std::abs(singular - past_[i].t);
    if (distance < constants.node_ratio * farthest) continue;
    chosen_[count_++] = i;
    farthest = distance;
  }
  return count_;
}

void SingularExtrapolation::keep_chosen() {
  for (std::size_t j = 0; j < count_; ++j) {
    std::swap(past_[j], past_[chosen_[j]]);
    chosen_[j] = j;
  }
  known_ = count_;
}

std::array<double, SingularExtrapolation::most_nodes> SingularExtrapolation::places(double length) const {
  std::array<double, most_nodes> x{};
  for (std::size_t j = 0; j < count_; ++j) x[j] = (past_[chosen_[j]].t - past_[chosen_[0]].t) / length;
  return x;
}

void SingularExtrapolation::go(std::size_t nodes, double t, std::span<const double> q0,
                               std::span<const double> v0, std::span<double> q, std::span<double> v,
                               std::span<double> a) const {
  const double length = t - past_[chosen_[0]].t;
  const auto all = places(length);
  const auto x = std::span(all).first(nodes);
  std::array<Weights, most_nodes> w;
  for (std::size_t j = 0; j < nodes; ++j) w[j] = integrals(lagrange(x, j), 1.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    Weights sum;
    for (std::size_t j = 0; j < nodes; ++j) sum.add(past_[chosen_[j]].a[i], w[j]);
    q[i] = q0[i] + length * (v0[i] + length * sum.twice);
    v[i] = v0[i] + length * sum.once;
    if (!a.empty()) a[i] = sum.value;
  }
}

void SingularExtrapolation::read(std::size_t nodes, double t, const Instant& from, const Instant& to,
                                 std::span<double> q, std::span<double> v) const {
  const double length = to.t - from.t, at = (t - from.t) / length;
  const auto all = places(length);
  const auto x = std::span(all).first(nodes);
  std::array<Weights, most_nodes> here, there;
  for (std::size_t j = 0; j < nodes; ++j) {
    const Polynomial c = lagrange(x, j);
    here[j] = integrals(c, at);
    there[j] = integrals(c, 1.0);
  }
  Polynomial c = nodal(x, nodes);
  const Weights alpha_here = integrals(c, at), alpha = integrals(c, 1.0);
  multiply(c, 0.0);
  const Weights beta_here = integrals(c, at), beta = integrals(c, 1.0);
  const double determinant = alpha.once * beta.twice - beta.once * alpha.twice;
  for (std::size_t i = 0; i < q.size(); ++i) {
    Weights sum, end;
    for (std::size_t j = 0; j < nodes; ++j) {
      const double a_j = past_[chosen_[j]].a[i];
      sum.add(a_j, here[j]);
      end.add(a_j, there[j]);
    }
    const double v_off = (to.v[i] - from.v[i]) / length - end.once,
                 q_off = ((to.q[i] - from.q[i]) / length - from.v[i]) / length - end.twice;
    sum.add((v_off * beta.twice - q_off * beta.once) / determinant, alpha_here);
    sum.add((q_off * alpha.once - v_off * alpha.twice) / determinant, beta_here);
    q[i] = from.q[i] + length * (at * from.v[i] + length * sum.twice);
    v[i] = from.v[i] + length * sum.once;
  }
}

}  // namespace dalembert
