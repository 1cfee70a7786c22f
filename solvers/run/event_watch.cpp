#include "dalembert/solvers/run/event_watch.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/root.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/run/chebyshev.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

int sign(double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; }

bool wanted(Crossing crossing, int before) {
  return crossing == Crossing::either || (crossing == Crossing::rising) == (before < 0);
}

/// The interpolant of a function's values at the Chebyshev nodes of a step, in its barycentric form (Berrut,
/// Trefethen, SIAM Review 46 (2004) 501).
struct Interpolant {
  const std::vector<double>&nodes, &values;

  [[nodiscard]] double weight(std::size_t j) const {
    return (j % 2 == 0 ? 1.0 : -1.0) * (j == 0 || j + 1 == nodes.size() ? 0.5 : 1.0);
  }
  [[nodiscard]] double operator()(double t) const {
    double sum = 0.0, weights = 0.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (t == nodes[j]) return values[j];
      const double w = weight(j) / (t - nodes[j]);
      sum += w * values[j];
      weights += w;
    }
    return sum / weights;
  }
  [[nodiscard]] double slope(std::size_t j) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (k != j) sum += weight(k) * (values[k] - values[j]) / (nodes[j] - nodes[k]);
    return sum / weight(j);
  }
  /// Where between a and b it is closest to 0, or beyond it, seen from the side of `side`; by golden-section
  /// search.
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

EventWatch::EventWatch(std::vector<FlatEvent> events, const Layout& layout)
    : events_(std::move(events)), largest_(events_.size()) {
  for (const FlatEvent& event : events_) {
    if (!event.function)
      throw InvalidArgument("Event \"" + event.name + "\" of scene \"" + layout.scene + "\" has no function");
    if (event.ends && event.change)
      throw InvalidArgument("Event \"" + event.name + "\" of scene \"" + layout.scene +
                            "\" both ends the run and changes the scene; it can do only one of them");
  }
}

void EventWatch::begin_anew(const FlatSample& start, std::size_t positive) {
  from_ = start.time;
  at_from_.clear();
  side_.clear();
  for (std::size_t e = 0; e < events_.size(); ++e) {
    at_from_.push_back(value(e, start));
    side_.push_back(e < positive ? first_side(e, at_from_.back()) : at_from_.back() < 0.0 ? -1 : 1);
  }
}

/// After a change a function may stay at 0, to round-off.
int EventWatch::first_side(std::size_t event, double value) const {
  return std::abs(value) > round_off() * largest_[event] ? sign(value) : 0;
}

double EventWatch::value(std::size_t event, const FlatSample& at) {
  const auto fail = [&](const std::string& what) {
    throw StepFailure{"Event \"" + events_[event].name + "\" " + what, at.time};
  };
  double value = 0.0;
  try {
    value = events_[event].function(at);
  } catch (const std::exception& error) {
    fail(std::string("threw \"") + error.what() + '"');
  } catch (...) {
    fail("threw something that is no std::exception");
  }
  if (!std::isfinite(value)) fail("gives no finite number");
  largest_[event] = std::max(largest_[event], std::abs(value));
  return value;
}

/// The nodes of the step, and the points where the interpolant turns towards 0 between two of one sign.
std::vector<EventWatch::Place> EventWatch::places(std::size_t event, const Read& read,
                                                  const std::vector<double>& values) {
  const Interpolant p{nodes_, values};
  std::vector<Place> places{{nodes_.front(), values.front()}};
  for (std::size_t j = 1; j < nodes_.size(); ++j) {
    const double a = nodes_[j - 1], b = nodes_[j], f_a = values[j - 1], f_b = values[j];
    const int side = sign(f_b);
    // What begins at 0 may have had the other sign meanwhile.
    const bool from_zero = j == 1 && side_[event] == 0;
    if (side != 0 && (from_zero || side == sign(f_a)) && side * p.slope(j - 1) < 0.0 &&
        side * p.slope(j) > 0.0) {
      const double t = p.turn(a, b, side);
      const double high = from_zero ? -round_off() * largest_[event] : std::min(std::abs(f_a), std::abs(f_b));
      if (side * p(t) < high) places.push_back({t, value(event, read(t))});
    }
    places.push_back({b, f_b});
  }
  return places;
}

void EventWatch::find(std::size_t event, const Read& read, const std::vector<double>& values,
                      std::vector<Occurrence>& occurred) {
  const auto function = [&](double t) { return value(event, read(t)); };
  const auto all = places(event, read, values);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto [a, f_a] = all[i - 1];
    const auto [b, f_b] = all[i];
    const int before = side_[event], after = sign(f_b);
    if (before == 0) {
      side_[event] = first_side(event, f_b);
      continue;
    }
    if (after == before) continue;
    // It is 0 at b, or in between; where it was 0 at a that has been found.
    const double exact = 4.0 * epsilon * std::max(std::abs(a), std::abs(b));
    side_[event] = after == 0 ? -before : after;
    if (f_a == 0.0) continue;
    if (wanted(events_[event].crossing, before))
      occurred.push_back({event, root(function, a, f_a, b, f_b, exact)});
  }
}

std::vector<Occurrence> EventWatch::look(const Read& read, double to, int degree) {
  std::vector<std::vector<double>> values;
  for (const double first : at_from_) values.push_back({first});
  nodes_ = {from_};
  for (int j = 1; j <= degree; ++j) {
    nodes_.push_back(chebyshev_node(from_, to, j, degree));
    const FlatSample at = read(nodes_.back());
    for (std::size_t e = 0; e < events_.size(); ++e) values[e].push_back(value(e, at));
  }
  std::vector<Occurrence> occurred;
  for (std::size_t e = 0; e < events_.size(); ++e) find(e, read, values[e], occurred);
  std::ranges::stable_sort(occurred, {}, &Occurrence::time);
  for (std::size_t e = 0; e < events_.size(); ++e) at_from_[e] = values[e].back();
  from_ = to;
  return occurred;
}

}  // namespace dalembert
