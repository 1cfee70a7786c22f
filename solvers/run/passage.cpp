#include "dalembert/solvers/run/passage.h"

#include <dalembert/solvers/base/constants.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// So many steps are kept: what error control adds to the halvings of the distance.
constexpr std::size_t kept = 16;
/// For one node the Lagrange polynomial L of the others' times, scaled to x = s/length: L(1), and its
/// integrals int L and int (1 - x) L from 0 to 1.
struct Weights {
  double value = 0.0, once = 0.0, twice = 0.0;
};

Weights weights(std::span<const double> x, std::size_t node) {
  std::array<double, Passage::most_nodes> c{1.0};  // coefficients of L
  std::size_t degree = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (j == node) continue;
    const double scale = 1.0 / (x[node] - x[j]);
    for (std::size_t k = ++degree; k > 0; --k) c[k] = scale * (c[k - 1] - x[j] * c[k]);
    c[0] *= -scale * x[j];
  }
  Weights w;
  for (std::size_t k = 0; k <= degree; ++k) {
    const auto power = static_cast<double>(k);
    w.value += c[k];
    w.once += c[k] / (power + 1.0);
    w.twice += c[k] / ((power + 1.0) * (power + 2.0));
  }
  return w;
}

}  // namespace

Passage::Passage(std::size_t n) : past_(kept) {
  for (Past& node : past_) node.a.resize(n);
}

void Passage::remember(double t, std::span<const double> a) {
  std::rotate(past_.begin(), past_.end() - 1, past_.end());  // clang 14 has no std::ranges::rotate
  past_.front().t = t;
  std::ranges::copy(a, past_.front().a.begin());
  known_ = std::min(known_ + 1, past_.size() - 1);  // one more is there for those chosen before
  for (std::size_t& i : chosen_) ++i;
}

std::size_t Passage::choose(double singular) {
  count_ = 0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < known_ && count_ < most_nodes; ++i) {
    const double distance = std::abs(singular - past_[i].t);
    if (distance < constants.spread * farthest) continue;
    chosen_[count_++] = i;
    farthest = distance;
  }
  return count_;
}

void Passage::keep_chosen() {
  for (std::size_t j = 0; j < count_; ++j) {
    std::swap(past_[j], past_[chosen_[j]]);
    chosen_[j] = j;
  }
  known_ = count_;
}

void Passage::go(std::size_t nodes, double t, std::span<const double> q0, std::span<const double> v0,
                 std::span<double> q, std::span<double> v, std::span<double> a) const {
  const double length = t - past_[chosen_[0]].t;
  std::array<double, most_nodes> x{};
  std::array<Weights, most_nodes> w;
  for (std::size_t j = 0; j < nodes; ++j) x[j] = (past_[chosen_[j]].t - past_[chosen_[0]].t) / length;
  for (std::size_t j = 0; j < nodes; ++j) w[j] = weights(std::span(x).first(nodes), j);
  for (std::size_t i = 0; i < q.size(); ++i) {
    Weights sum;
    for (std::size_t j = 0; j < nodes; ++j) {
      const double a_j = past_[chosen_[j]].a[i];
      sum.value += w[j].value * a_j;
      sum.once += w[j].once * a_j;
      sum.twice += w[j].twice * a_j;
    }
    q[i] = q0[i] + length * (v0[i] + length * sum.twice);
    v[i] = v0[i] + length * sum.once;
    if (!a.empty()) a[i] = sum.value;
  }
}

}  // namespace dalembert
