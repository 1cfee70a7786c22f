#include "dalembert/solvers/run/event_watch.h"

#include <dalembert/solvers/base/root.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/run/chebyshev.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

int sign(double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; }

bool wanted(Crossing crossing, int before) {
  return crossing == Crossing::either || (crossing == Crossing::rising) == (before < 0);
}

/// The interpolant of a function's values at the nodes of a step, in barycentric form: the weights are 1, -1,
/// 1,
/// ..., at the ends one half of that.
struct Interpolant {
  Interpolant(const std::vector<double>& at_nodes, double from, double to) : values(at_nodes) {
    for (int j = 0; j <= degree(); ++j) nodes.push_back(chebyshev_node(from, to, j, degree()));
  }
  const std::vector<double>& values;
  std::vector<double> nodes{};

  [[nodiscard]] int degree() const { return static_cast<int>(values.size()) - 1; }
  [[nodiscard]] double weight(std::size_t j) const {
    return (j % 2 == 0 ? 1.0 : -1.0) * (j == 0 || j + 1 == values.size() ? 0.5 : 1.0);
  }
  [[nodiscard]] double operator()(double t) const {
    double above = 0.0, below = 0.0;
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (t == nodes[j]) return values[j];
      const double w = weight(j) / (t - nodes[j]);
      above += w * values[j];
      below += w;
    }
    return above / below;
  }
  /// At a node.
  [[nodiscard]] double slope(std::size_t i) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < values.size(); ++j)
      if (j != i) sum += weight(j) / weight(i) * (values[j] - values[i]) / (nodes[i] - nodes[j]);
    return sum;
  }
  /// Whether it falls towards 0 behind node i, and away from it before the next one, seen from `side`.
  [[nodiscard]] bool turns_behind(std::size_t i, int side) const {
    return side * slope(i) < 0.0 && side * slope(i + 1) > 0.0;
  }
  /// Where between a and b it is closest to 0, or beyond it, seen from the side of `side`; by golden
  /// sections.
  [[nodiscard]] double turn(double a, double b, int side) const {
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
};

}  // namespace

EventWatch::EventWatch(std::vector<FlatEvent> events, const Layout& layout) : events_(std::move(events)) {
  for (const FlatEvent& event : events_) {
    if (!event.function)
      throw InvalidArgument("Event \"" + event.name + "\" of scene \"" + layout.scene + "\" has no function");
  }
}

void EventWatch::begin_anew(const FlatSample& start, std::size_t positive) {
  from_ = start.time;
  at_from_.clear();
  side_.clear();
  for (std::size_t e = 0; e < events_.size(); ++e) {
    at_from_.push_back(value(e, start));
    side_.push_back(sign(at_from_.back()));
    if (side_.back() == 0 && e >= positive) side_.back() = 1;
  }
}

double EventWatch::value(std::size_t event, const FlatSample& at) const {
  const auto fail = [&](const std::string& what) {
    throw StepFailure{"Event \"" + events_[event].name + "\" " + what, at.time};
  };
  double value = 0.0;
  try {
    value = events_[event].function(at);
  } catch (const std::exception& error) {
    fail(std::string("threw \"") + error.what() + '"');
  }
  if (!std::isfinite(value)) fail("gives no finite number");
  return value;
}

/// The nodes of the step, and where the interpolant turns towards 0 between two of one sign.
std::vector<EventWatch::Place> EventWatch::places(std::size_t event, const Read& read,
                                                  const std::vector<double>& values, double to) const {
  const Interpolant p(values, from_, to);
  std::vector<Place> places{{from_, values.front()}};
  for (std::size_t j = 1; j < values.size(); ++j) {
    const double a = p.nodes[j - 1], b = p.nodes[j], f_a = values[j - 1], f_b = values[j];
    const int side = sign(f_a);
    if (side != 0 && side == sign(f_b) && p.turns_behind(j - 1, side)) {
      const double t = p.turn(a, b, side);
      if (side * p(t) < std::min(std::abs(f_a), std::abs(f_b))) places.push_back({t, value(event, read(t))});
    }
    places.push_back({b, f_b});
  }
  return places;
}

void EventWatch::find(std::size_t event, const Read& read, const std::vector<double>& values, double to,
                      std::vector<Occurrence>& occurred) {
  const auto function = [&](double t) { return value(event, read(t)); };
  const auto all = places(event, read, values, to);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto [a, f_a] = all[i - 1];
    const auto [b, f_b] = all[i];
    const int before = side_[event], after = sign(f_b);
    if (after == before || before == 0) {
      side_[event] = after == 0 ? before : after;
      continue;
    }
    // It is 0 at b, or in between; where it was 0 at a that has been found.
    const double exact = 4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
    side_[event] = after == 0 ? -before : after;
    if (f_a == 0.0) continue;
    if (wanted(events_[event].crossing, before))
      occurred.push_back({event, root(function, a, f_a, b, f_b, exact)});
  }
}

std::vector<Occurrence> EventWatch::look(const Read& read, double to, int degree) {
  std::vector<std::vector<double>> values;
  for (const double first : at_from_) values.push_back({first});
  for (int j = 1; j <= degree; ++j) {
    const FlatSample at = read(chebyshev_node(from_, to, j, degree));
    for (std::size_t e = 0; e < events_.size(); ++e) values[e].push_back(value(e, at));
  }
  std::vector<Occurrence> occurred;
  for (std::size_t e = 0; e < events_.size(); ++e) find(e, read, values[e], to, occurred);
  std::ranges::stable_sort(occurred, {}, &Occurrence::time);
  for (std::size_t e = 0; e < events_.size(); ++e) at_from_[e] = values[e].back();
  from_ = to;
  return occurred;
}

}  // namespace dalembert
