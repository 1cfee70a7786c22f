#include "dalembert/solvers/run/interpolant.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/run/chebyshev.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dalembert {

namespace {

/// Of a step, the width of the flat top of a smooth function: the root of round-off.
constexpr double shortest_part = 1.5e-8;
/// Of a step: times next to each other.
constexpr double next_to_each_other = 1e-9;

double weight_of(std::size_t j, std::size_t nodes) {
  return (j % 2 == 0 ? 1.0 : -1.0) * (j == 0 || j + 1 == nodes ? 0.5 : 1.0);
}

}  // namespace

double Interpolant::operator()(double t) const {
  double sum = 0.0, weights = 0.0;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    if (t == nodes[j]) return values[j];
    const double w = weight_of(j, nodes.size()) / (t - nodes[j]);
    sum += w * values[j];
    weights += w;
  }
  return sum / weights;
}

double Interpolant::slope(std::size_t node) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (k != node) sum += weight_of(k, nodes.size()) * (values[k] - values[node]) / (nodes[node] - nodes[k]);
  return sum / weight_of(node, nodes.size());
}

double Interpolant::turn(double a, double b, int side) const {
  constexpr double section = 0.6180339887498949;
  const auto height = [&](double t) { return side * (*this)(t); };
  double low = b - section * (b - a), high = a + section * (b - a);
  double f_low = height(low), f_high = height(high);
  for (int i = 0; i < 40; ++i) {  // to 1e-8 of the interval, where an extremum is flat to round-off
    if (f_low < f_high) {
      b = std::exchange(high, low);
      f_high = f_low;
      low = b - section * (b - a);
      f_low = height(low);
    } else {
      a = std::exchange(low, high);
      f_low = f_high;
      high = a + section * (b - a);
      f_high = height(high);
    }
  }
  return 0.5 * (a + b);
}

Interpolant interpolate(const FunctionOfTime& f, double from, double to, int degree) {
  Interpolant p;
  for (int j = 0; j <= degree; ++j) {
    p.nodes.push_back(chebyshev_node(from, to, j, degree));
    p.values.push_back(f(p.nodes.back()));
  }
  return p;
}

std::vector<double> check_times(double from, double to, int degree) {
  std::vector<double> times;
  for (const int j : {degree / 3, (2 * degree) / 3}) {
    const double angle = (j + 0.5) * std::numbers::pi / degree;
    times.push_back(0.5 * (from + to) - 0.5 * (to - from) * std::cos(angle));
  }
  return times;
}

namespace {

/// How much an interpolant and its function disagree.
double disagreement_of(const Interpolant& p, const std::vector<double>& at_checks) {
  const auto times = check_times(p.nodes.front(), p.nodes.back(), p.degree());
  double most = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) most = std::max(most, std::abs(p(times[i]) - at_checks[i]));
  return most;
}

/// What an interpolant and further values span, and the least of their sizes.
struct Range {
  double low, high, least;

  Range(const Interpolant& p, const std::vector<double>& more)
      : low(p.values[0]), high(low), least(std::abs(low)) {
    for (const auto* part : {&p.values, &more}) {
      for (const double value : *part) {
        low = std::min(low, value);
        high = std::max(high, value);
        least = std::min(least, std::abs(value));
      }
    }
  }
  /// Whether an error of so much does not matter to where they turn.
  [[nodiscard]] bool shows_all(double error, double round_off) const {
    return error <= std::max(constants.unresolved_by_interpolant * (high - low), round_off);
  }
  /// Whether they lie on one side of 0, further from it than an error of so much reaches.
  [[nodiscard]] bool out_of_reach(double error) const {
    return low * high > 0.0 && constants.beside_a_kink * error < least;
  }
};

/// Of an interpolant whose nodes are on one side of 0: whether its function has a kink between two of them
/// and may reach 0 there. The checks may lie where a kink does not show, so each gap towards which the
/// function falls from both sides is looked into.
bool has_kink_towards_zero(const FunctionOfTime& f, const Interpolant& p, const Range& range) {
  const double side = range.low > 0.0 ? 1.0 : -1.0;
  const auto height = [&](std::size_t j) { return side * p.values[j]; };
  for (std::size_t j = 0; j + 1 < p.nodes.size(); ++j) {
    const bool falls = j == 0 || height(j) < height(j - 1),
               rises = j + 2 == p.nodes.size() || height(j + 2) > height(j + 1);
    const double middle = 0.5 * (p.nodes[j] + p.nodes[j + 1]);
    if (falls && rises && !range.out_of_reach(std::abs(p(middle) - f(middle)))) return true;
  }
  return false;
}

bool agrees(const FunctionOfTime& f, const Interpolant& p, const std::vector<double>& at_checks,
            double round_off) {
  const Range range(p, at_checks);
  const double error = disagreement_of(p, at_checks);
  return range.shows_all(error, round_off) ||
         (range.out_of_reach(error) && !has_kink_towards_zero(f, p, range));
}

}  // namespace

/// A slope that differs by d next to a node displaces the cubic between it and the next one, at a distance h,
/// by at most 4/27 h d.
bool agrees_in_slope(const Interpolant& p, const std::vector<double>& rates, double round_off) {
  double error = 0.0;
  for (std::size_t j = 0; j < rates.size(); ++j) {
    if (std::isnan(rates[j])) continue;
    const double before = j > 0 ? p.nodes[j] - p.nodes[j - 1] : 0.0,
                 behind = j + 1 < rates.size() ? p.nodes[j + 1] - p.nodes[j] : 0.0;
    error = std::max(error, 4.0 / 27.0 * std::max(before, behind) * std::abs(p.slope(j) - rates[j]));
  }
  const Range range(p, {});
  return range.shows_all(error, round_off) || range.out_of_reach(error);
}

namespace {

/// Whether a function differs between times next to each other by what its interpolant misses.
bool is_noise(const FunctionOfTime& f, const Interpolant& p, const std::vector<double>& at_checks) {
  const double from = p.nodes.front(), to = p.nodes.back(), missed = disagreement_of(p, at_checks);
  const auto times = check_times(from, to, p.degree());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i],
                 apart = std::max(next_to_each_other * (to - from), 4.0 * epsilon * std::abs(t));
    for (const double beside : {t - apart, t + apart})
      if (std::abs(f(beside) - at_checks[i]) > 0.1 * missed) return true;
  }
  return false;
}

/// Parts of a function that are still to be shown, the next one last.
class Parts {
 public:
  Parts(const FunctionOfTime& f, const Interpolant& whole, double round_off)
      : f_(f),
        degree_(whole.degree()),
        round_off_(round_off),
        shortest_(shortest_part * (whole.nodes.back() - whole.nodes.front())) {
    halve(whole);
  }
  [[nodiscard]] bool any() const { return !left_.empty(); }
  /// The next one, halved until it is resolved or as short as may be.
  [[nodiscard]] Interpolant next() {
    for (;;) {
      const auto [a, b] = left_.back();
      left_.pop_back();
      Interpolant p = interpolate(f_, a, b, degree_);
      std::vector<double> checks;
      for (const double t : check_times(a, b, degree_)) checks.push_back(f_(t));
      const bool shortest = b - a <= std::max(shortest_, 64.0 * epsilon * std::abs(b));
      if (shortest || agrees(f_, p, checks, round_off_)) return p;
      halve(p);
    }
  }

 private:
  void halve(const Interpolant& p) {
    const double a = p.nodes.front(), b = p.nodes.back(), middle = 0.5 * (a + b);
    left_.emplace_back(middle, b);
    left_.emplace_back(a, middle);
  }

  const FunctionOfTime& f_;
  int degree_;
  double round_off_, shortest_;
  std::vector<std::pair<double, double>> left_;
};

}  // namespace

bool resolve(const FunctionOfTime& f, const Interpolant& first, const std::vector<double>& at_checks,
             double round_off, std::size_t most_parts, const ShowPart& show) {
  if (agrees(f, first, at_checks, round_off) || is_noise(f, first, at_checks)) {
    (void)show(first);
    return true;
  }
  Parts parts(f, first, round_off);
  for (std::size_t shown = 0; parts.any(); ++shown) {
    if (shown == most_parts) return false;
    if (show(parts.next())) return true;
  }
  return true;
}

}  // namespace dalembert
