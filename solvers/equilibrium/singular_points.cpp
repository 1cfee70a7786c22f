#include "dalembert/solvers/equilibrium/singular_points.h"

#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/root.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>

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
/// Half the interval in which a branch is interpolated, in steps: two zeros of one eigenvalue halve it. From
/// a quarter of it to twice as much, by 10 to 16 points, all tests find the same.
constexpr double widest = 0.1, narrowest = 1e-3;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Whether an eigenvalue is 0 as exactly as a position is known, beside itself elsewhere.
bool is_none_beside(double value, double other) {
  return other != 0.0 && std::abs(value) <= std::sqrt(rank_threshold) * std::abs(other);
}

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

/// The Lagrange polynomials of some places at x.
VectorXd weights(std::span<const double> places, double x) {
  VectorXd w = VectorXd::Ones(std::ssize(places));
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j)
      if (j != i) w[static_cast<Index>(i)] *= (x - places[j]) / (places[i] - places[j]);
  return w;
}

/// Points on a branch and their places along a chord, between which it is a polynomial.
struct Polynomial {
  std::vector<double> places{};
  std::vector<Node> nodes{};

  void add(double place, Node node) {
    places.push_back(place);
    nodes.push_back(std::move(node));
  }
  /// To be corrected.
  [[nodiscard]] Node at(double x) const {
    const VectorXd w = weights(places, x);
    Node sum = nodes.front();
    sum.x.setZero();
    std::ranges::fill(sum.lambda, 0.0);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double share = w[static_cast<Index>(k)];
      sum.x += share * nodes[k].x;
      for (std::size_t r = 0; r < sum.lambda.size(); ++r) sum.lambda[r] += share * nodes[k].lambda[r];
    }
    return sum;
  }
};

/// The middle of an interval along the chord, about `way` if it lies within the range of the parameter.
double within_range(const Node& a, const Node& b, double way, double width) {
  const double slope = b.fraction() - a.fraction();
  if (slope == 0.0) return way;
  const auto [first, last] = std::minmax({-a.fraction() / slope, (1.0 - a.fraction()) / slope});
  return last - first > 2.0 * width ? std::clamp(way, first + width, last - width) : 0.5 * (first + last);
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

/// By (1) below an eigenvalue and the slope of the parameter are 0 at once. Along the branch p - p0 and the
/// eigenvalue are even there, and only the slope changes its sign.
std::optional<SingularPoints::Zero> SingularPoints::turning(const Node& a, const Node& b) const {
  const VectorXd along = (b.x - a.x).normalized();
  auto zero = nearest(a, b, [&](const Node& node) { return corrector_->parameter_slope(node, along); });
  if (!zero) return std::nullopt;
  const auto vanishes = [&](const Pair& pair) {
    return is_none_beside(zero->at.stiffness.values[pair.second], a.stiffness.values[pair.first]);
  };
  zero->turns = false;
  zero->count = std::ranges::count_if(follow(a, zero->at).pairs, vanishes);
  if (zero->count == 0) return std::nullopt;
  return zero;
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
  const auto add = [&](std::optional<Zero> zero, bool certain) {
    found.missed = found.missed || (certain && !zero);
    if (zero) found.zeros.push_back(std::move(*zero));
  };
  for (const Pair& pair : followed.pairs) {
    const double at_a = a.stiffness.values[pair.first], at_b = b.stiffness.values[pair.second];
    const bool changes = (at_a < 0.0) != (at_b < 0.0);
    left = left != changes;
    // One that is 0 at an end passes 0 there, or turns.
    const bool at_an_end = is_none_beside(at_a, at_b) || is_none_beside(at_b, at_a);
    if (changes || at_an_end) add(locate(a, b, pair), !at_an_end);
  }
  if (left) add(locate_determinant(a, b), true);
}

/// First roughly, by points that are corrected. Close to the zero that fails: two branches may intersect
/// there, Newton's matrix is singular, and a residual of round-off leaves its root sideways. So the branch is
/// interpolated then.
std::optional<SingularPoints::Zero> SingularPoints::nearest(const Node& a, const Node& b,
                                                            const Function& value) const {
  const auto on_way = [&](double way) {
    const auto next = on_chord(a, b, way);
    const double there = next ? value(*next) : 0.0;  // that ends the search
    return std::isnan(there) ? 0.0 : there;
  };
  const double at_a = value(a), at_b = value(b);
  double way = std::abs(at_a) < std::abs(at_b) ? 0.0 : 1.0;
  if ((at_a < 0.0) != (at_b < 0.0)) way = root(on_way, 0.0, at_a, 1.0, at_b, exact);
  for (double width = widest * step_; width > narrowest * step_; width *= 0.5)
    if (auto zero = interpolated(a, b, way, width / (b.x - a.x).norm(), value)) return zero;
  return std::nullopt;
}

/// Branches are analytic, also where they intersect: through points on both sides, at Chebyshev's places
/// along the chord, the polynomial errs by (width/r)^12/2048 if the next singularity is r away. Each point is
/// sought where the others have it, from the ends to the middle, so that it is of the same branch.
///
/// With psi on the left of K's eigenvalue mu, a branch (x(s), p(s)) of R(x, p) = 0 satisfies
///
///   mu psi.x' + psi.R_p p' = 0                                                                        (1)
///
/// Where mu = 0 either p' is 0 and psi.R_p is not: a fold; or p' is not 0: psi.R_p is, and branches
/// intersect.
std::optional<SingularPoints::Zero> SingularPoints::interpolated(const Node& a, const Node& b, double way,
                                                                 double width, const Function& value) const {
  constexpr int count = 12;
  const VectorXd chord = b.x - a.x, along = chord.normalized();
  const double centre = within_range(a, b, way, width);
  Polynomial branch{{0.0, 1.0}, {a, b}}, near{std::vector<double>(count), std::vector<Node>(count)};
  VectorXd values(count), slopes(count);
  for (int k = 0; k < count; ++k) {
    const int place = k % 2 == 0 ? k / 2 : count - 1 - k / 2;
    const double at = centre + width * std::cos((place + 0.5) / count * std::numbers::pi);
    if (at == 0.0 || at == 1.0) return std::nullopt;
    const Node guess = branch.at(at);
    auto next = corrector_->correct(guess, along);
    // One farther off than the nearest point that is known is of another branch.
    double apart = std::abs(at);
    for (const double known : branch.places) apart = std::min(apart, std::abs(at - known));
    if (!next || (next->x - guess.x).norm() > apart * chord.norm()) return std::nullopt;
    values[place] = value(*next);
    if (std::isnan(values[place])) return std::nullopt;
    slopes[place] = corrector_->parameter_slope(*next, along);
    branch.add(at, *next);
    near.places[static_cast<std::size_t>(place)] = at;
    near.nodes[static_cast<std::size_t>(place)] = std::move(*next);
  }
  const auto is_negative = [&](Index k) { return values[k] < 0.0; };
  int changes = 0;
  for (Index k = 1; k < count; ++k) changes += is_negative(k - 1) != is_negative(k);
  const auto eigenvalue = [&](double x) { return weights(near.places, x).dot(values); };
  const double low = centre - width, high = centre + width, below = eigenvalue(low), above = eigenvalue(high);
  if (changes > 1 || (below < 0.0) == (above < 0.0)) return std::nullopt;
  const double zero = root(eigenvalue, low, below, high, above, exact * width);
  auto found = corrector_->finished(near.at(zero));
  if (!found) return std::nullopt;
  const double slope = weights(near.places, zero).dot(slopes);
  return Zero{std::move(*found), std::abs(slope) <= std::sqrt(rank_threshold) * slopes.cwiseAbs().maxCoeff()};
}

std::optional<SingularPoints::Zero> SingularPoints::locate(const Node& a, const Node& b, Pair pair) const {
  const auto eigenvalue = [&](const Node& node) {
    if (&node == &a) return a.stiffness.values[pair.first];
    if (&node == &b) return b.stiffness.values[pair.second];
    return node.stiffness.values.size() > 0 ? node.stiffness.values[place_of(node, a, b, pair)] : unknown;
  };
  auto zero = nearest(a, b, eigenvalue);
  if (!zero || zero->at.stiffness.values.size() == 0) return locate_determinant(a, b);
  // Where points on the way are of another branch an eigenvalue jumps, and is 0 nowhere.
  constexpr double jump = 0.1;
  const double size =
      std::max(std::abs(a.stiffness.values[pair.first]), std::abs(b.stiffness.values[pair.second]));
  if (std::abs(eigenvalue(zero->at)) > jump * size) return std::nullopt;
  const auto none = [size](const Node& node) {
    return std::ranges::count_if(node.stiffness.values,
                                 [size](double value) { return is_none_beside(value, size); });
  };
  zero->count = std::max<std::ptrdiff_t>(1, none(zero->at) - std::min(none(a), none(b)));
  return zero;
}

/// Where two eigenvalues are 0 so close to each other that they are complex before it. There they have one
/// shape, to round-off that of either where both are real: they are as far from 0 there as its root.
std::optional<SingularPoints::Zero> SingularPoints::locate_determinant(const Node& a, const Node& b) const {
  if (a.stiffness.negative == b.stiffness.negative) return std::nullopt;
  auto zero = nearest(a, b, [&](const Node& node) { return determinant(node, a); });
  if (!zero) return std::nullopt;
  Node& near = zero->at;
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
  return zero;
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
