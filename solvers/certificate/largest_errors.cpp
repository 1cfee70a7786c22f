#include "dalembert/solvers/certificate/largest_errors.h"

#include <dalembert/core/places.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace dalembert {

namespace {

double distance(std::span<const double> a, std::span<const double> b) {
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square);
}

double norm_of_state(std::span<const double> a) {
  double square = 0.0;
  for (const double x : a) square += x * x;
  return std::sqrt(square);
}

/// Of some of the amplitudes; 0 if there are none.
double norm_of(Places own, const std::vector<double>& amplitudes) {
  return amplitudes.empty() ? 0.0 : norm_of_state(own.in(std::span<const double>(amplitudes)));
}

/// Goes through samples or events, and keeps the largest error of each kind.
class Search {
 public:
  explicit Search(const TwoRuns& runs) : runs_(runs), layout_(*runs.run()->layout) {}

  void compare(const FlatSample& a, const FlatSample& b, const Certainty& its) {
    const Certainty of_positions = its.of_positions(), of_velocities = its.of_velocities();
    if (its.doubt == Doubt::at_a_jump) {
      ++found.beside_jumps;
    } else if (its.doubt != Doubt::none) {
      ++found.beyond;
      return;
    }
    const auto dimension = static_cast<std::size_t>(layout_.dimension);
    const PassedOver& amplitude = runs_.passed_over();
    for (const auto& p : layout_.particles) {
      const auto own = Places::from(static_cast<std::size_t>(p.coordinate), dimension);
      keep(found.position, a.time, p.name, own.in(a.q), own.in(b.q), runs_.length(), of_positions,
           norm_of(own, amplitude.q));
      keep(found.velocity, a.time, p.name, own.in(a.v), own.in(b.v), runs_.speed(), of_velocities,
           norm_of(own, amplitude.v));
    }
    for (const auto& r : layout_.rotors) {
      const auto own = Places::from(static_cast<std::size_t>(r.coordinate), 1);
      keep(found.angle, a.time, r.name, own.in(a.q), own.in(b.q), 1.0, of_positions,
           norm_of(own, amplitude.q));
      keep(found.angular_velocity, a.time, r.name, own.in(a.v), own.in(b.v), runs_.speed() / runs_.length(),
           of_velocities, norm_of(own, amplitude.v));
    }
    compare_forces(a, b, its);
  }

  void compare_impulses(std::size_t k) {
    const Certainty& its = runs_.event(k);
    const Record &run = *runs_.run(), &other = *runs_.reference();
    if (its.doubt != Doubt::none || run.impulses.empty() || other.impulses.empty()) return;
    const auto of = [](const Record& record, std::size_t event) {
      return std::span(record.impulses).subspan(event * record.rows, record.rows);
    };
    for (const auto& c : layout_.constraints)
      if (!c.internal)
        keep(found.impulse, run.events[k].time, c.label(), c.own_rows().in(of(run, k)),
             c.own_rows().in(of(other, its.counterpart)), 0.0, its);
  }

  void compare_time(std::size_t k) {
    const double error = runs_.error_of_time(k);
    if (!std::isfinite(error)) return;
    const EventRecord& one = runs_.run()->events[k];
    take(found.event_time, error, one.time,
         one.kind == EventKind::event ? "event " + std::to_string(one.source)
                                      : layout_.constraints[one.source].label());
  }

  LargestErrors found;

 private:
  void compare_forces(const FlatSample& a, const FlatSample& b, const Certainty& its) {
    bool undetermined = false;
    for (const auto& c : layout_.constraints) {
      if (c.internal) continue;
      const auto own = c.own_rows().in(a.lambda), other = c.own_rows().in(b.lambda);
      const double apart = distance(own, other);
      if (std::isnan(apart)) {
        undetermined = true;
        continue;
      }
      if (its.doubt == Doubt::none)
        take(found.force,
             larger(runs_.error_of_force(apart, its), norm_of(c.own_rows(), runs_.passed_over().lambda)),
             a.time, c.label());
    }
    if (undetermined) ++found.undetermined;
  }

  void keep(LargestError& most, double time, const std::string& of, std::span<const double> a,
            std::span<const double> b, double unit, const Certainty& its, double amplitude = 0.0) {
    if (its.doubt == Doubt::none)
      take(most, larger(runs_.error_of_state(distance(a, b), norm_of_state(a), unit, its), amplitude), time,
           of);
  }
  static void take(LargestError& most, double error, double time, const std::string& of) {
    if (!(error <= most.error)) most = {error, time, of};
  }

  const TwoRuns& runs_;
  const Layout& layout_;
};

}  // namespace

LargestErrors largest_errors(const TwoRuns& runs) {
  Search search(runs);
  const Record &run = *runs.run(), &other = *runs.reference();
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    const Certainty& its = runs.sample(i);
    const bool there = its.counterpart < other.times.size();
    search.compare(run.sample(i), there ? other.sample(its.counterpart) : run.sample(i), its);
  }
  for (std::size_t k = 0; k < run.events.size(); ++k) {
    const Certainty& its = runs.event(k);
    search.compare_time(k);
    if (its.doubt != Doubt::none) {
      ++(its.doubt == Doubt::at_a_jump ? search.found.rests : search.found.beyond);
      continue;
    }
    search.compare(run.at_events->sample(k), other.at_events->sample(its.counterpart), its);
    if (run.after_events && other.after_events)
      search.compare(run.after_events->sample(k), other.after_events->sample(its.counterpart), its);
    search.compare_impulses(k);
  }
  return search.found;
}

}  // namespace dalembert
