#include "dalembert/solvers/equilibrium/singular_points.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/root.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The fraction of the way between two points to which a point is located directly: adjacent numbers.
constexpr double exact = 1e-14;
/// Covectors of orthonormal shapes give their cosines: two shapes of which each is more than this of the
/// other are the same, as sqrt(1 - 0.8^2) < 0.8 is left for all others.
constexpr double same_shape = 0.8;
constexpr int most_divisions = 10;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The place in b of what is most alike to both ends of a pair.
Index place_of(const Node& at, const Node& a, const Node& b, std::pair<Index, Index> pair) {
  const Eigen::MatrixXd& shapes = at.stiffness.shapes;
  const VectorXd to_a = shapes.transpose() * a.stiffness.duals.col(pair.first),
                 to_b = shapes.transpose() * b.stiffness.duals.col(pair.second),
                 alike = to_a.cwiseAbs() + to_b.cwiseAbs();
  Index place = 0;
  if (alike.size() > 0) (void)alike.maxCoeff(&place);
  return place;
}

/// Of the stiffness, over that at another point.
double determinant(const Node& at, const Node& unit) {
  const double size = std::exp(at.stiffness.log_determinant - unit.stiffness.log_determinant);
  return at.stiffness.negative ? -size : size;
}

/// The Lagrange polynomials of some nodes at x.
template <std::size_t N>
std::array<double, N> weights(const std::array<double, N>& nodes, double x) {
  std::array<double, N> w;
  for (std::size_t i = 0; i < N; ++i) {
    w[i] = 1.0;
    for (std::size_t j = 0; j < N; ++j)
      if (j != i) w[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
  }
  return w;
}

/// Two vibrations of an undamped scene that meet: half of their distance squared, and their frequency; < 0
/// before, where both are on the imaginary axis, > 0 after, off it to either side. (It passes 0 with a slope,
/// and is known to round-off where either eigenvalue is known to its square root.)
std::pair<double, double> meeting(const std::vector<Vibration>& all, std::size_t rank,
                                  std::complex<double> last) {
  if (rank < all.size() && all[rank].grows())
    return {all[rank].s.real() * all[rank].s.real(), all[rank].s.imag()};
  const double frequency = last.imag();
  if (frequency == 0.0) {  // it meets its conjugate
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vibration& v : all)
      if (!v.grows() && v.s.imag() > 0.0) nearest = std::min(nearest, v.s.imag());
    return {-(std::isfinite(nearest) ? nearest * nearest : last.real() * last.real()), 0.0};
  }
  double first = std::numeric_limits<double>::infinity(), second = first;  // distances from the frequency
  for (const Vibration& v : all) {
    if (v.grows()) continue;
    const double off = v.s.imag() - frequency;
    if (std::abs(off) < std::abs(first))
      second = std::exchange(first, off);
    else if (std::abs(off) < std::abs(second))
      second = off;
  }
  if (!std::isfinite(second)) return {-last.real() * last.real(), frequency};  // the step is halved
  return {-0.25 * (first - second) * (first - second), frequency + 0.5 * (first + second)};
}

/// The number of eigenvalues with their conjugates.
int eigenvalues_of(const Node& node) {
  int sum = 0;
  for (const Vibration& v : node.vibrations) sum += v.s.imag() > 0.0 ? 2 : 1;
  return sum;
}

}  // namespace

SingularPoints::Found SingularPoints::between(const Node* before, const Node& a, const Node& b) const {
  Found found;
  zeros(before, a, b, 0, found);
  flutters(a, b, 0, found);
  return found;
}

std::optional<Node> SingularPoints::on_chord(const Node& a, const Node& b, double way) const {
  Node guess = way < 0.5 ? a : b;
  guess.x = a.x + way * (b.x - a.x);
  return corrector_->correct(guess, (b.x - a.x).normalized());
}

SingularPoints::Followed SingularPoints::follow(const Node& a, const Node& b) {
  const Index m = a.stiffness.values.size(), n = b.stiffness.values.size();
  const Eigen::MatrixXd to_b = (a.stiffness.duals.transpose() * b.stiffness.shapes).cwiseAbs(),
                        to_a = (a.stiffness.shapes.transpose() * b.stiffness.duals).cwiseAbs();
  Followed found;
  found.alike = to_b.cwiseProduct(to_a).cwiseSqrt();
  std::vector<char> taken(static_cast<std::size_t>(n), 0);
  for (Index i = 0; i < m; ++i) {
    Index j = 0;
    const bool known = n > 0 && found.alike.row(i).maxCoeff(&j) > same_shape;
    if (!known || std::exchange(taken[static_cast<std::size_t>(j)], 1) == 1)
      found.of_a.push_back(i);
    else
      found.pairs.emplace_back(i, j);
  }
  for (Index j = 0; j < n; ++j)
    if (taken[static_cast<std::size_t>(j)] == 0) found.of_b.push_back(j);
  return found;
}

/// Whether something that is not known again may have passed 0: shapes of one frequency are not told from
/// each other, but they are from those on the other side of 0. Where two meet and become complex, or the
/// other way round, others beside them may have passed.
bool SingularPoints::Followed::matters(const Node& a, const Node& b) const {
  constexpr double alike_at_all = 0.5;  // a shape among two others is at least sqrt(1/2) of one
  const auto below_a = [&](Index i) { return a.stiffness.values[i] < 0.0; };
  const auto below_b = [&](Index j) { return b.stiffness.values[j] < 0.0; };
  for (const Index i : of_a) {
    for (const Index j : of_b)
      if (below_a(i) != below_b(j) && alike(i, j) > alike_at_all) return true;
  }
  const auto below = std::ranges::count_if(of_a, below_a) + std::ranges::count_if(of_b, below_b);
  return of_a.size() != of_b.size() && below > 0 && below < std::ssize(of_a) + std::ssize(of_b);
}

void SingularPoints::Followed::pair_the_rest() {
  for (std::size_t k = 0; k < std::min(of_a.size(), of_b.size()); ++k) pairs.emplace_back(of_a[k], of_b[k]);
}

bool SingularPoints::may_have_turned(const Node* before, const Node& a, const Node& b,
                                     const Followed& followed) {
  if (before == nullptr) return false;
  const double ratio = (b.x - a.x).norm() / (a.x - before->x).norm();
  const Followed earlier = follow(*before, a);
  return std::ranges::any_of(earlier.pairs, [&](const Pair& pair) {
    const double first = before->stiffness.values[pair.first], now = a.stiffness.values[pair.second];
    const auto next = std::ranges::find(followed.pairs, pair.second, &Pair::first);
    if (next == followed.pairs.end() || now == 0.0) return false;
    const double then = b.stiffness.values[next->second], expected = now + ratio * (now - first);
    return (now < 0.0) == (then < 0.0) && (now < 0.0) != (expected < 0.0);
  });
}

void SingularPoints::zeros(const Node* before, const Node& a, const Node& b, int depth, Found& found) const {
  Followed followed = follow(a, b);
  const bool first = before == nullptr && depth == 0;  // nothing tells where eigenvalues head for
  const bool clear = !first && !followed.matters(a, b) && !may_have_turned(before, a, b, followed);
  if (!clear && depth < most_divisions && (b.x - a.x).norm() > exact) {
    if (const auto middle = on_chord(a, b, 0.5)) {
      zeros(before, a, *middle, depth + 1, found);
      zeros(&a, *middle, b, depth + 1, found);
      return;
    }
  }
  followed.pair_the_rest();
  bool left = a.stiffness.negative != b.stiffness.negative;  // a change of the determinant's sign
  for (const Pair& pair : followed.pairs) {
    if ((a.stiffness.values[pair.first] < 0.0) == (b.stiffness.values[pair.second] < 0.0)) continue;
    left = !left;
    if (auto zero = locate(a, b, pair)) found.zeros.push_back(std::move(*zero));
  }
  if (!left) return;
  if (auto zero = locate_determinant(a, b)) found.zeros.push_back(std::move(*zero));
}

/// First roughly, by points that are corrected. Close to the zero that fails: two branches may intersect
/// there, and Newton's matrix is singular. So the branch is interpolated then.
Node SingularPoints::nearest(const Node& a, const Node& b, const Function& value) const {
  std::optional<Node> near;
  const auto on_way = [&](double way) {
    auto next = on_chord(a, b, way);
    if (!next) return 0.0;  // that ends the search with what there is
    near = std::move(next);
    const double there = value(*near);
    return std::isnan(there) ? 0.0 : there;
  };
  (void)root(on_way, 0.0, value(a), 1.0, value(b), exact);
  if (!near) near = b;
  if (auto better = interpolated(a, b, *near, value)) near = std::move(better);
  return std::move(*near);
}

std::optional<SingularPoints::Zero> SingularPoints::locate(const Node& a, const Node& b, Pair pair) const {
  const auto eigenvalue = [&](const Node& node) {
    if (&node == &a) return a.stiffness.values[pair.first];
    if (&node == &b) return b.stiffness.values[pair.second];
    return node.stiffness.values.size() > 0 ? node.stiffness.values[place_of(node, a, b, pair)] : unknown;
  };
  Node near = nearest(a, b, eigenvalue);
  if (near.stiffness.values.size() == 0) return locate_determinant(a, b);
  const Index place = place_of(near, a, b, pair);
  // Where points on the way are of another branch an eigenvalue jumps, and is 0 nowhere.
  constexpr double jump = 0.1;
  const double size =
      std::max(std::abs(a.stiffness.values[pair.first]), std::abs(b.stiffness.values[pair.second]));
  if (std::abs(near.stiffness.values[place]) > jump * size) return std::nullopt;
  return Zero{std::move(near), place};
}

/// Where two eigenvalues are 0 so close to each other that they are complex before it. There they have one
/// shape, to round-off that of either where both are real: they are as far from 0 there as its root.
std::optional<SingularPoints::Zero> SingularPoints::locate_determinant(const Node& a, const Node& b) const {
  Node near = nearest(a, b, [&](const Node& node) { return determinant(node, a); });
  Node beside = b.stiffness.values.size() > a.stiffness.values.size() ? b : a;
  if (near.stiffness.values.size() < beside.stiffness.values.size()) {
    for (double way = 0.5; way > std::sqrt(exact); way *= 0.5) {
      Node guess = near;
      guess.x += way * (beside.x - near.x);
      auto next = corrector_->correct(guess, (b.x - a.x).normalized());
      if (!next || next->stiffness.values.size() < beside.stiffness.values.size()) break;
      beside = std::move(*next);
    }
    near.stiffness = beside.stiffness;
  }
  if (near.stiffness.values.size() == 0) return std::nullopt;
  Index place = 0;
  (void)near.stiffness.values.cwiseAbs().minCoeff(&place);
  return Zero{std::move(near), place};
}

/// Branches are analytic, also where they intersect: through points on both sides, at Chebyshev's places
/// along the chord, the polynomial errs by (width/r)^8/128 if the next singularity is r away.
std::optional<Node> SingularPoints::interpolated(const Node& a, const Node& b, const Node& near,
                                                 const Function& value) const {
  constexpr std::size_t count = 8;
  const VectorXd along = (b.x - a.x).normalized();
  const double width = 0.1 * step_;
  std::array<double, count> ways, values;
  std::array<Node, count> nodes;
  for (std::size_t k = 0; k < count; ++k) {
    ways[k] = std::cos((static_cast<double>(k) + 0.5) / count * std::numbers::pi);
    Node guess = near;
    guess.x += width * ways[k] * along;
    if (guess.fraction() < 0.0 || guess.fraction() > 1.0) return std::nullopt;
    auto next = corrector_->correct(guess, along);
    if (!next || (next->x - near.x).norm() > 2.0 * width) return std::nullopt;
    nodes[k] = std::move(*next);
    values[k] = value(nodes[k]);
    if (std::isnan(values[k])) return std::nullopt;
  }
  const auto eigenvalue = [&](double way) {
    const auto w = weights(ways, way);
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += w[k] * values[k];
    return sum;
  };
  if ((values[0] > 0.0) == (values[count - 1] > 0.0)) return std::nullopt;
  const auto w =
      weights(ways, root(eigenvalue, ways[0], values[0], ways[count - 1], values[count - 1], exact));
  Node found = near;
  found.x.setZero();
  std::ranges::fill(found.lambda, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    found.x += w[k] * nodes[k].x;
    for (std::size_t r = 0; r < found.lambda.size(); ++r) found.lambda[r] += w[k] * nodes[k].lambda[r];
  }
  return corrector_->finished(std::move(found));
}

/// A pair of real eigenvalues becomes one vibration without a change of stability, and might hide one: where
/// both their numbers change the step is divided, and where several begin to grow.
void SingularPoints::flutters(const Node& a, const Node& b, int depth, Found& found) const {
  const auto vibrating = [](const Node& node) {
    return std::ranges::count_if(node.vibrations,
                                 [](const Vibration& v) { return v.grows() && v.s.imag() > 0.0; });
  };
  const auto vibrating_a = vibrating(a), vibrating_b = vibrating(b);
  const bool both = vibrating_a != vibrating_b && a.growing() - vibrating_a != b.growing() - vibrating_b;
  const bool several = a.state.motion != nullptr && std::abs(a.growing() - b.growing()) > 1;
  if ((both || several) && depth < most_divisions && (b.x - a.x).norm() > exact) {
    if (const auto middle = on_chord(a, b, 0.5)) {
      flutters(a, *middle, depth + 1, found);
      flutters(*middle, b, depth + 1, found);
      return;
    }
  }
  const auto [fewer, more] = std::minmax({a.growing(), b.growing()});
  for (auto rank = fewer; rank < more; ++rank) {
    if (auto flutter = locate_flutter(a, b, static_cast<std::size_t>(rank), found.missed))
      found.flutters.push_back(std::move(*flutter));
    else if (a.state.motion != nullptr && !both)  // no two have become one: something has crossed
      found.missed = true;
  }
}

/// Where the vibration of a rank, by decreasing growth, begins to grow: with damping where its real part is
/// 0; without where it meets another on the imaginary axis, or its conjugate at 0.
std::optional<SingularPoints::Flutter> SingularPoints::locate_flutter(const Node& a, const Node& b,
                                                                      std::size_t rank, bool& missed) const {
  const bool grows_at_b = b.growing() > a.growing();
  const Node &steady = grows_at_b ? a : b, &grown = grows_at_b ? b : a;
  Vibration last = grown.vibrations[rank];
  const bool damped =
      rank < steady.vibrations.size() && steady.vibrations[rank].s.real() < -steady.vibrations[rank].error;
  const bool vibrates = last.s.imag() > 0.0;
  std::optional<Node> near = grown;
  double frequency = last.s.imag();
  const auto excess = [&](const Node& node) {
    const bool there = rank < node.vibrations.size();
    frequency = 0.0;
    if (!vibrates && eigenvalues_of(node) < eigenvalues_of(steady)) return 0.0;  // one has become 0
    if (there && node.vibrations[rank].grows()) last = node.vibrations[rank];
    if (!damped) {
      const auto [off, of_both] = meeting(node.vibrations, rank, last.s);
      frequency = of_both;
      return off;
    }
    frequency = there ? node.vibrations[rank].s.imag() : last.s.imag();
    return there ? node.vibrations[rank].s.real() : -last.s.real();
  };
  bool found = true;
  const auto on_way = [&](double way) {
    auto next = on_chord(steady, grown, way);
    found = found && next.has_value();
    if (!next) return 0.0;
    near = std::move(next);
    return excess(*near);
  };
  const auto growth = [damped](double x) { return damped ? std::abs(x) : std::sqrt(std::abs(x)); };
  const double before = excess(steady), after = excess(grown);
  const double way = root(on_way, 0.0, before, 1.0, after, exact);
  if (!vibrates && eigenvalues_of(*near) < eigenvalues_of(steady)) {
    // Within round-off of its terms an eigenvalue counts as 0: the secant from just outside, of which the
    // error is the square of its width.
    constexpr double widest = 1e-3;
    for (double width = std::sqrt(exact); width < widest; width *= 10.0) {
      const double first = on_way(way - width), second = on_way(way + width);
      if (!(first * second < 0.0)) continue;
      (void)on_way(way + width * (first + second) / (first - second));
      break;
    }
  }
  // What turns into steady growth and not into a vibration that is just kept up is no flutter's limit; nor is
  // a jump, where two become others.
  const double left = growth(excess(*near));
  const double size = vibrates ? frequency : std::max(growth(before), growth(after));
  if (!(left <= std::sqrt(rank_threshold) * size)) {
    missed = missed || !found;
    return std::nullopt;
  }
  return Flutter{std::move(*near), frequency};
}

}  // namespace dalembert
