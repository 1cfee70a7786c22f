#include "dalembert/solvers/run/event_watch.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/root.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/run/chebyshev.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dalembert {

namespace {

int sign(double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; }

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool wanted(Crossing crossing, int before) {
  return crossing == Crossing::either || (crossing == Crossing::rising) == (before < 0);
}

}  // namespace

EventWatch::EventWatch(std::vector<FlatEvent> events, OfContacts of_contacts, const std::string& scene,
                       double tolerance)
    : events_(std::move(events)),
      of_contacts_(std::move(of_contacts)),
      accuracy_(tolerance),
      largest_(events_.size()),
      units_(events_.size()),
      largest_before_(events_.size()),
      seen_(events_.size()),
      at_root_(events_.size()),
      before_(events_.size()),
      leaves_(events_.size()),
      returned_(events_.size()) {
  for (const FlatEvent& event : events_) {
    if (!event.function)
      throw InvalidArgument("Event \"" + event.name + "\" of scene \"" + scene + "\" has no function");
    if (event.ends && event.change)
      throw InvalidArgument("Event \"" + event.name + "\" of scene \"" + scene +
                            "\" both ends the run and changes the scene; it can do only one of them");
  }
}

std::vector<EventWatch::Found> EventWatch::restart(const Beginning& beginning) {
  from_ = beginning.start.time;
  asked_for_ = beginning.positive;
  resolved_ = beginning.timed ? events_.size() : asked_for_;
  at_from_.clear();
  rate_at_from_.clear();
  auto never_left = [was = std::exchange(side_, {})](std::size_t e) { return was.empty() || was[e] == 0; };
  leaves_.assign(events_.size(), from_);
  rounded_.reset();
  if (asked_for_ > 0) rounded_.emplace(beginning.system, beginning.length);
  std::vector<Found> jumped;
  for (std::size_t e = 0; e < events_.size(); ++e) {
    int before = 0;
    if (e < asked_for_) {
      forget_behind(e, from_);
      if (never_left(e)) units_[e] = std::max(units_[e], size_of_terms(e, beginning.start));
      if (beginning.before != nullptr) before = first_side(e, value(e, *beginning.before));
    } else {
      largest_[e] = 0.0;
      units_[e] = of_contacts_.unit(e, beginning.start.time);
    }
    at_from_.push_back(value(e, beginning.start));
    rate_at_from_.push_back(e < asked_for_ ? unknown : of_contacts_.rate(e, beginning.start));
    side_.push_back(e < asked_for_ ? first_side(e, at_from_.back()) : at_from_.back() < 0.0 ? -1 : 1);
    if (before * side_[e] < 0) jumped.push_back({{e, from_}, before, wanted(events_[e].crossing, before)});
    const auto next =
        std::ranges::find(beginning.left, e, [](const Found& one) { return one.record.source; });
    if (next != beginning.left.end() && side_[e] == 0) side_[e] = next->before;
    if (side_[e] == 0 && largest_[e] > 0.0) depart(e, beginning);
    at_root_[e] = 0.0;
  }
  return jumped;
}

/// How large the terms are whose sum a function is, where that is round-off of them, as |r| - L of what a rod
/// of length L holds, or its rate; else 0. Terms change with the roundings; what jumps there does not. A root
/// of roundings, as of an arc cosine, is a step as well: it ends where the numbers change by the root of a
/// rounding.
double EventWatch::size_of_terms(std::size_t event, const FlatSample& at) {
  constexpr double few = 256.0;  // above the roundings of the function itself
  static const double many = 16.0 / std::sqrt(epsilon);
  const auto& function = events_[event].function;
  try {
    const double here = function(at);
    rounded_->measure(at);
    const auto change = [&](double roundings) {
      double most = 0.0;
      for (std::size_t pattern = 0; pattern < RoundedSample::patterns; ++pattern) {
        const double by = std::abs(function(rounded_->beside(pattern, roundings)) - here);
        most = std::isnan(by) ? std::numeric_limits<double>::infinity() : std::max(most, by);
      }
      return most;
    };
    const double changes = change(few), size = changes / (few * epsilon);
    if (std::isinf(size) || std::abs(here) > round_off() * size || change(many) < 4.0 * changes) return 0.0;
    return size;
  } catch (...) {  // at the place itself `value` will say so
    return 0.0;
  }
}

/// What has never left 0 may be round-off of terms that were smaller before.
void EventWatch::measure_what_stays(std::size_t event, const FlatSample& at, double value) {
  if (event < asked_for_ && side_[event] == 0 && std::abs(value) > round_off() * units_[event])
    units_[event] = std::max(units_[event], size_of_terms(event, at));
}

std::optional<std::size_t> EventWatch::triggered_at_start(std::size_t first, std::size_t count) const {
  for (std::size_t e = first; e < first + count; ++e)
    if (at_from_[e] < 0.0) return e;
  return std::nullopt;
}

/// What the last step would have come to behind a change has never been.
void EventWatch::forget_behind(std::size_t event, double t) {
  largest_[event] = largest_before_[event];
  for (const Place& one : seen_[event])
    if (one.t <= t) largest_[event] = std::max(largest_[event], one.value);
}

void EventWatch::chatters(std::size_t event, double t) const {
  throw StepFailure{events_[event].name +
                        " chatters: its changes come faster and faster, without end. Let what accumulates "
                        "come to rest, smooth what switches, or end the run before",
                    t};
}

/// What is far above round-off, and d(h) = b h + c h^2 of it, tell the sign; where b h is less than half of
/// it, the way back from c may be lost in round-off. Up to the time that is looked at terms of third order
/// are round-off.
EventWatch::Departure EventWatch::departure(std::size_t event, const Beginning& beginning) {
  const double t = beginning.start.time, noise = std::max(round_off() * size(event), at_root_[event]);
  const double far_above = 16.0 * noise, longest = std::cbrt(16.0 * round_off()) * beginning.time;
  const auto moved = [&](double h) { return value(event, beginning.ahead(t + h)) - at_from_[event]; };
  try {
    for (double h = 4.0 * epsilon * std::max(std::abs(t), beginning.time); h <= longest; h *= 4.0) {
      const double d = moved(h);
      if (std::abs(d) <= far_above) continue;
      const double linear = 4.0 * moved(0.5 * h) - d;
      return {sign(d), t + h, sign(linear) == sign(d) && std::abs(linear) > 0.5 * std::abs(d)};
    }
  } catch (const std::exception&) {  // the motion itself will say so, if it gets there
  }
  return {};
}

void EventWatch::depart(std::size_t event, const Beginning& beginning) {
  const Departure its = departure(event, beginning);
  side_[event] = its.side;
  if (its.side != 0) leaves_[event] = its.at;
  if (beginning.changed != event) return;
  const bool returns = its.side == before_[event];
  if (its.side != 0 && !returns && !its.clear && returned_[event]) chatters(event, beginning.start.time);
  returned_[event] = returns;
}

/// After a change a function may stay at 0, to round-off.
int EventWatch::first_side(std::size_t event, double value) const {
  return std::abs(value) > std::max(round_off() * size(event), at_root_[event]) ? sign(value) : 0;
}

double EventWatch::value(std::size_t event, const FlatSample& at) {
  const auto fail = [&](const std::string& what) {
    const std::string& name = events_[event].name;
    throw StepFailure{"Event " + (name.empty() ? std::to_string(event) : '"' + name + '"') + ' ' + what,
                      at.time};
  };
  double value = 0.0;
  try {
    value = events_[event].function(at);
  } catch (const std::exception& error) {
    fail(std::string("threw \"") + error.what() + '"');
  } catch (...) {
    fail("threw something that is no std::exception");
  }
  if (!std::isfinite(value)) fail("gives no finite number; it must be one in all states of the run");
  largest_[event] = std::max(largest_[event], std::abs(value));
  seen_[event].push_back({at.time, std::abs(value)});
  return value;
}

/// Where the step begins, or where it is clear how the function left 0 there.
EventWatch::Place EventWatch::first_place(std::size_t event, const Read& read, const Interpolant& part) {
  const double t = leaves_[event];
  if (t <= part.nodes.front()) return {part.nodes.front(), part.values.front()};
  return {t, value(event, read(t))};
}

/// Where a function falls below 0 between two nodes above it, faster than an interpolant shows: it falls at
/// one, rises at the other, and the tangents there, which lie below what is convex, meet below 0.
std::vector<EventWatch::Place> EventWatch::dips(std::size_t event, const Read& read, const Values& values) {
  const auto& [nodes, f] = values.whole;
  const double touches = -round_off() * size(event);
  std::vector<Place> found;
  for (std::size_t j = 1; j < values.rates.size(); ++j) {
    const double a = nodes[j - 1], b = nodes[j], f_a = f[j - 1], f_b = f[j];
    const double r_a = values.rates[j - 1], r_b = values.rates[j];
    if (!(f_a > 0.0 && f_b > 0.0 && r_a < 0.0 && r_b > 0.0)) continue;
    const double meet = (f_a - f_b + r_b * (b - a)) / (r_b - r_a);
    if (f_a + r_a * meet > 0.0) continue;
    const auto rate = [&](double t) {
      const double its = of_contacts_.rate(event, read(t));
      if (!std::isnan(its)) return its;  // else it touches, or is below
      return value(event, read(t + std::sqrt(epsilon) * (b - t))) - value(event, read(t));
    };
    const double t = root(rate, a, r_a, b, r_b, 4.0 * epsilon * std::max(std::abs(a), std::abs(b)));
    const double f_t = value(event, read(t));
    if (f_t < touches && t > leaves_[event]) found.push_back({t, f_t});
  }
  return found;
}

/// The nodes of the interpolants, and the points where one turns towards 0, by more than round-off, between
/// two of one sign.
std::vector<EventWatch::Place> EventWatch::places(std::size_t event, const Read& read,
                                                  const std::vector<Interpolant>& parts) {
  if (leaves_[event] >= parts.back().nodes.back()) return {};
  std::vector<Place> places{first_place(event, read, parts.front())};
  for (const Interpolant& p : parts) {
    for (std::size_t j = 1; j < p.nodes.size(); ++j) {
      if (p.nodes[j] <= places.front().t) continue;
      const double a = p.nodes[j - 1], b = p.nodes[j], f_a = p.values[j - 1], f_b = p.values[j];
      const int side = sign(f_b);
      // What begins at 0 may have had the other sign meanwhile.
      const bool from_zero = places.size() == 1 && side_[event] == 0;
      if (side != 0 && (from_zero || side == sign(f_a)) && side * p.slope(j - 1) < 0.0 &&
          side * p.slope(j) > 0.0) {
        const double t = p.turn(a, b, side);
        const double noise = round_off() * size(event), least = std::min(std::abs(f_a), std::abs(f_b));
        // A turn that is shallower than round-off, as of what is constant, does not reach 0.
        const double high = from_zero ? -noise : least > noise ? least - noise : least;
        const double f_t = side * p(t) < high ? value(event, read(t)) : f_b;
        const bool touches = event < asked_for_ && std::abs(f_t) <= noise;
        if (f_t != f_b && !touches) places.push_back({t, f_t});
      }
      places.push_back({b, f_b});
    }
  }
  return places;
}

/// A function that is 0 to round-off where the run ends has crossed 0 if it was not before.
int EventWatch::side_at_end(std::size_t event, const Place& before, const Place& end) const {
  const double zero = round_off() * size(event);
  return std::abs(end.value) <= zero && std::abs(before.value) > zero ? 0 : sign(end.value);
}

/// What was clearly above 0 changes where it is 0, not where its margin is used up.
double EventWatch::root_of(std::size_t event, const Step& step, const Place& a, const Place& b,
                           double exact) {
  const double margin = event < asked_for_ ? 0.0 : of_contacts_.margin(event);
  const double none = a.value > margin ? margin : 0.0;
  const auto function = [&](double t) { return value(event, step.read(t)) - none; };
  return root(function, a.t, a.value - none, b.t, b.value - none, exact);
}

void EventWatch::find(std::size_t event, const Step& step, const std::vector<Interpolant>& parts,
                      const std::vector<Place>& dips, std::vector<Found>& found) {
  auto all = places(event, step.read, parts);
  all.insert(all.end(), dips.begin(), dips.end());
  std::ranges::sort(all, {}, &Place::t);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto [a, f_a] = all[i - 1];
    auto [b, f_b] = all[i];
    int after = sign(f_b);
    if (step.ends_run && i + 1 == all.size()) after = side_at_end(event, all[i - 1], all[i]);
    if (after == 0) f_b = 0.0;
    const int before = side_[event];
    if (before == 0) {
      side_[event] = first_side(event, f_b);
      continue;
    }
    if (after == before) continue;
    // It is 0 at b, or in between; where it was 0 at a that has been found.
    const double exact = 4.0 * epsilon * std::max(std::abs(a), std::abs(b));
    side_[event] = after == 0 ? -before : after;
    // It turned back, but sooner than the step shows.
    if (i == 1 && a == leaves_[event] && a > from_ && sign(f_a) != before) chatters(event, from_);
    if (f_a == 0.0) continue;
    before_[event] = before;
    at_root_[event] = 2.0 * exact * std::abs(f_b - f_a) / (b - a);
    const bool asked = wanted(events_[event].crossing, before);
    if (asked || event < asked_for_)
      found.push_back({{event, root_of(event, step, all[i - 1], {b, f_b}, exact)}, before, asked});
  }
}

/// Whether an interpolant shows a function of contacts as exactly as forces are known: rates and the slopes
/// of positions differ by what steps err by. (What would take the whole step to reach 0, at its largest rate,
/// does not reach it.)
bool EventWatch::shows(std::size_t event, const Values& values) const {
  double fastest = 0.0, least = std::numeric_limits<double>::infinity();
  for (const double rate : values.rates) fastest = std::max(fastest, std::isnan(rate) ? 0.0 : std::abs(rate));
  for (const double value : values.whole.values) least = std::min(least, value);
  const double length = values.whole.nodes.back() - values.whole.nodes.front();
  return fastest * length < least ||
         agrees_in_slope(values.whole, values.rates, accuracy_.of_forces() * size(event));
}

/// The interpolants that show a function. Those of contacts are known as forces are.
std::vector<Interpolant> EventWatch::resolved(std::size_t event, const Step& step, Values values) {
  const auto function = [&](double t) { return value(event, step.read(t)); };
  constexpr std::size_t most_parts = 4096;  // of a step: some hundred periods are still resolved
  const double known = event < asked_for_ ? round_off() : accuracy_.of_forces();
  if (event >= resolved_) {
    if (shows(event, values)) return {std::move(values.whole)};
    const int degree = std::max(step.degree, least_degree);
    values.whole = interpolate(function, from_, step.to, degree);
    for (const double t : check_times(from_, step.to, degree)) values.at_checks.push_back(function(t));
  }
  std::vector<Interpolant> parts;
  const auto collect = [&](const Interpolant& part) {
    parts.push_back(part);
    return false;
  };
  if (!resolve(function, values.whole, values.at_checks, known * size(event), most_parts, collect)) {
    const std::string& name = events_[event].name;
    throw StepFailure{(event < asked_for_ ? "Event \"" + name + '"' : name) +
                          " varies faster than it can be followed within a step of " +
                          std::to_string(step.to - from_) +
                          "; choose a max_step in the options that is shorter than what it does between two "
                          "zeros",
                      from_};
  }
  return parts;
}

std::vector<EventWatch::Found> EventWatch::locate(const Step& step) {
  largest_before_ = largest_;
  for (std::size_t e = asked_for_; e < events_.size(); ++e) units_[e] = of_contacts_.unit(e, from_);
  for (auto& values : seen_) values.clear();
  const int degree = resolved_ > 0 ? std::max(step.degree, least_degree) : step.degree;
  std::vector<Values> all(events_.size());
  const bool rates = static_cast<bool>(of_contacts_.rate);
  for (std::size_t e = 0; e < events_.size(); ++e) {
    all[e].whole = {{from_}, {at_from_[e]}};
    if (rates && e >= asked_for_) all[e].rates = {rate_at_from_[e]};
  }
  for (int j = 1; j <= degree; ++j) {
    const double t = chebyshev_node(from_, step.to, j, degree);
    const FlatSample at = step.read(t);
    for (std::size_t e = 0; e < events_.size(); ++e) {
      all[e].whole.nodes.push_back(t);
      all[e].whole.values.push_back(value(e, at));
      measure_what_stays(e, at, all[e].whole.values.back());
      if (rates && e >= asked_for_) all[e].rates.push_back(of_contacts_.rate(e, at));
    }
  }
  for (const double t : resolved_ > 0 ? check_times(from_, step.to, degree) : std::vector<double>{}) {
    const FlatSample at = step.read(t);
    for (std::size_t e = 0; e < resolved_; ++e) {
      all[e].at_checks.push_back(value(e, at));
      measure_what_stays(e, at, all[e].at_checks.back());
    }
  }
  std::vector<Found> found;
  for (std::size_t e = 0; e < events_.size(); ++e) {
    const double at_end = all[e].whole.values.back();
    if (!all[e].rates.empty()) rate_at_from_[e] = all[e].rates.back();
    const auto low = dips(e, step.read, all[e]);
    const auto parts = resolved(e, step, std::move(all[e]));
    at_from_[e] = at_end;
    find(e, step, parts, low, found);
  }
  std::ranges::stable_sort(found, {}, [](const Found& one) { return one.record.time; });
  from_ = step.to;
  return found;
}

}  // namespace dalembert
