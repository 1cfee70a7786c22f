#include "dalembert/solvers/certificate/two_runs.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/certificate/matching_events.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

std::string words_of_time(double t) {
  std::ostringstream out;
  out.precision(6);
  out << "t = " << t;
  return out.str();
}

/// Whether one of these numbers changes at an event by more than the other run gives it, or than roundings of
/// the largest.
bool jumps(std::span<const double> before, std::span<const double> after, std::span<const double> other,
           double roundings) {
  double largest = 0.0;
  for (const double x : after) largest = larger(largest, std::abs(x));
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!(std::abs(after[i] - before[i]) <=
          larger(std::abs(before[i] - other[i]), roundings * epsilon * largest)))
      return true;
  return false;
}

/// What jumps at an event. One that changes nothing starts a run anew, with other round-off. Where contacts
/// or friction change, velocities and forces may jump whatever they show: of impacts without end a run lists
/// some.
struct Jump {
  bool positions, velocities, forces;
  [[nodiscard]] bool any() const { return positions || velocities || forces; }
};
Jump jump_at(const Record& run, std::size_t k, const FlatSample& other, double roundings) {
  if (run.events[k].kind != EventKind::event) return {false, true, true};
  const FlatSample before = run.at_events->sample(k), after = run.after_events->sample(k);
  const auto jump = [&](auto numbers) {
    return jumps(before.*numbers, after.*numbers, other.*numbers, roundings);
  };
  return {jump(&FlatSample::q), jump(&FlatSample::v), jump(&FlatSample::a) || jump(&FlatSample::lambda)};
}

/// But for what jumps.
bool is_known(const Certainty& its) { return its.doubt == Doubt::none || its.doubt == Doubt::at_a_jump; }

/// Results are sums of as many terms as the scene has rows and coordinates.
double roundings_of_sums(const Record& run) { return 10.0 + static_cast<double>(run.coordinates + run.rows); }

}  // namespace

TwoRuns::TwoRuns(std::shared_ptr<const Record> run, std::shared_ptr<const Record> reference,
                 std::string stopped, PassedOver passed_over)
    : run_(std::move(run)), reference_(std::move(reference)), passed_over_(std::move(passed_over)) {
  const Statistics& better = reference_->statistics;
  if (better.length > 0.0) length_ = better.length;
  unit_.assign(run_->coordinates, length_);
  for (const Layout::Rotor& rotor : run_->layout->rotors)
    unit_[static_cast<std::size_t>(rotor.coordinate)] = 1.0;
  if (better.time > 0.0) time_ = better.time;
  for (std::size_t i = 0; i < run_->times.size(); ++i) {
    for (const double lambda : run_->sample(i).lambda)
      if (std::abs(lambda) > largest_force_) largest_force_ = std::abs(lambda);  // unless NaN
  }
  match_samples();
  match_events();
  set_roundings();
  const double q = better.accuracy / run_->statistics.accuracy;
  if (q > most_of_better && q <= 1.0 - most_of_better) bound_ = 1.0 / (1.0 - q);
  find_jumps();
  if (!stopped.empty()) {
    const double end = reference_->times.empty() ? -unknown : reference_->times.back();
    doubt_from(std::nextafter(end, unknown), Doubt::no_counterpart,
               "the more accurate run stopped: " + stopped);
  }
  find_horizon();
  if (q > 1.0 - most_of_better) {
    std::ostringstream why;
    why << "there is no more accurate run: it claims an accuracy of " << better.accuracy << ", this one of "
        << run_->statistics.accuracy << "; double precision, or the least tolerance, gives no more";
    doubt_from(-unknown, Doubt::no_better_run, why.str());
  }
  for (const Record* one : {run_.get(), reference_.get()}) {
    if (!one->statistics.audit.passed())
      doubt_from(-unknown, Doubt::breaks_a_law, "a law of mechanics is broken, see audit()");
  }
  complete_ = std::ranges::all_of(samples_, is_known) && std::ranges::all_of(events_, is_known);
}

/// The earliest doubt says why; where two begin together, the later one.
void TwoRuns::doubt_from(double time, Doubt why, const std::string& words) {
  if (time > known_until_) return;
  bool any = false;
  const auto mark = [&](Certainty& its, double t) {
    if (t < time) return;
    its.doubt = why;
    any = true;
  };
  for (std::size_t i = 0; i < samples_.size(); ++i) mark(samples_[i], run_->times[i]);
  for (std::size_t k = 0; k < events_.size(); ++k) mark(events_[k], run_->events[k].time);
  if (!any) return;
  known_until_ = time;
  reservation_ =
      (std::isfinite(time) ? "from " + words_of_time(time) + " on nothing is known: " : "") + words;
}

/// Samples at the same times; where an event ended both runs, these ends.
void TwoRuns::match_samples() {
  const std::vector<double>&times = run_->times, &others = reference_->times;
  samples_.resize(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto same = std::ranges::lower_bound(others, times[i]);
    samples_[i].counterpart = static_cast<std::size_t>(same - others.begin());
    if (same == others.end() || *same != times[i]) samples_[i].doubt = Doubt::no_counterpart;
  }
  const auto ended = [](const Record& of) {
    return !of.times.empty() && !of.events.empty() && of.times.back() == of.events.back().time;
  };
  if (!ended(*run_) || !ended(*reference_)) return;
  samples_.back() = {.doubt = Doubt::none, .counterpart = others.size() - 1};
}

void TwoRuns::match_events() {
  const MatchingEvents matching(*run_, *reference_);
  events_.resize(run_->events.size());
  for (std::size_t k = 0; k < events_.size(); ++k) {
    const auto& other = matching.counterparts()[k];
    const Doubt of_match = matching.ends_earlier(k) ? Doubt::at_a_jump : Doubt::none;
    events_[k] = {.doubt = other ? of_match : Doubt::no_counterpart, .counterpart = other.value_or(0)};
  }
  if (matching.part_at() < unknown)
    doubt_from(matching.part_at(), Doubt::other_events, matching.difference());
}

/// Contacts and friction change where something is 0 up to what their solvers tell from it.
void TwoRuns::set_roundings() {
  const double of_sum = roundings_of_sums(*run_);
  for (Certainty& its : samples_) its.roundings = of_sum;
  for (std::size_t k = 0; k < events_.size(); ++k) {
    const bool asked_for = run_->events[k].kind == EventKind::event;
    events_[k].roundings = asked_for ? of_sum : std::max(of_sum, constants.roundings_at_contacts);
    if (events_[k].doubt == Doubt::none)
      set_round_off(events_[k], difference(run_->at_events->sample(k),
                                           reference_->at_events->sample(events_[k].counterpart)));
  }
}

/// Where a sample lies between the two times of a jump, or as near to them as these are known: to a part of
/// their difference, and to round-off. A rest begins for a run at the last impact that it lists. What happens
/// as the run begins is not looked for: its time is exact.
void TwoRuns::find_jumps() {
  if (samples_.empty()) return;
  for (std::size_t k = 0; k < events_.size(); ++k) {
    if (!is_known(events_[k])) continue;
    const std::size_t j = events_[k].counterpart;
    const Jump jump =
        jump_at(*run_, k, reference_->at_events->sample(j), roundings_of_sums(*run_) / most_of_better);
    if (!jump.any()) continue;
    const double a = run_->events[k].time, b = reference_->events[j].time,
                 part = std::max(most_of_better, bound_ - 1.0);
    if (a == b && a == run_->times.front()) continue;
    const double more = std::max({part * std::abs(a - b), round_off_of_time(k), run_->events[k].uncertain});
    double from = std::min(a, b);
    if (events_[k].doubt == Doubt::at_a_jump)
      from = std::min({from, run_->at_events->times[k], reference_->at_events->times[j]});
    from -= more;
    const double to = std::max(a, b) + more;
    const std::vector<double>& times = run_->times;
    for (auto i = static_cast<std::size_t>(std::ranges::lower_bound(times, from) - times.begin());
         i < times.size() && times[i] <= to; ++i) {
      Certainty& its = samples_[i];
      its.moved = its.moved || jump.positions;
      its.kicked = its.kicked || jump.velocities;
      its.of_states = std::max(its.of_states, events_[k].of_states);
      if (its.doubt == Doubt::none && times[i] == reference_->times[its.counterpart])
        its.doubt = Doubt::at_a_jump;
    }
  }
}

/// Of states, in the measure of Options::tolerance: as a part of the scene's length, and of that over its
/// time.
double TwoRuns::difference(const FlatSample& a, const FlatSample& b) const {
  double most = 0.0;
  for (std::size_t i = 0; i < unit_.size(); ++i)
    most =
        std::max({most, std::abs(a.q[i] - b.q[i]) / unit_[i], std::abs(a.v[i] - b.v[i]) * time_ / unit_[i]});
  return most;
}

/// What round-off adds up to, grown with the motion as other errors have. Of the whole run at any time:
/// within a long step its end's is everywhere.
void TwoRuns::set_round_off(Certainty& its, double difference) const {
  const double noise = epsilon + reference_->statistics.round_off;
  its.of_states = noise * std::max(1.0, difference / run_->statistics.accuracy);
  its.round_off = its.of_states / std::max(difference, its.of_states);
}

void TwoRuns::find_horizon() {
  double horizon = unknown;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Certainty& its = samples_[i];
    if (its.doubt != Doubt::none) continue;
    const double t = run_->times[i], apart = difference(run_->sample(i), reference_->sample(its.counterpart));
    set_round_off(its, apart);
    if (apart > parted) horizon = std::min(horizon, t);
  }
  for (std::size_t k = 0; k < events_.size(); ++k) {
    const Certainty& its = events_[k];
    if (its.doubt != Doubt::none) continue;
    const double t = run_->events[k].time, apart = difference(run_->at_events->sample(k),
                                                              reference_->at_events->sample(its.counterpart));
    if (apart > parted) horizon = std::min(horizon, t);
  }
  if (horizon == unknown) return;
  std::ostringstream why;
  why << "the runs have parted, by more than a tenth of the scene's length: within that time errors have "
         "grown "
      << parted / run_->statistics.accuracy
      << " times. Where growth is exponential, as in chaos, a hundredth of the tolerance reaches little "
         "further";
  doubt_from(horizon, Doubt::horizon, why.str());
}

TwoRuns::Moved TwoRuns::moved(const FlatSample& at) const {
  Moved to{passed_over_, at};
  const auto add = [](std::span<const double>& x, std::vector<double>& by) {
    for (std::size_t i = 0; i < by.size(); ++i) by[i] += x[i];
    x = by;
  };
  add(to.flat.q, to.numbers.q);
  add(to.flat.v, to.numbers.v);
  add(to.flat.a, to.numbers.a);
  add(to.flat.lambda, to.numbers.lambda);
  add(to.flat.forces, to.numbers.forces);
  return to;
}

double TwoRuns::round_off(double difference, double magnitude, const Certainty& its) const {
  return std::max(its.roundings * epsilon * magnitude, difference * its.round_off) / most_of_better;
}

double TwoRuns::error(double difference, double magnitude, const Certainty& its) const {
  if (its.doubt != Doubt::none || std::isnan(difference)) return unknown;
  return std::max(bound_ * difference, round_off(difference, magnitude, its));
}

/// What is 0 up to round-off is so for as long as the scene takes to move by that, at whatever time; the time
/// itself is a sum of steps.
double TwoRuns::round_off_of_time(std::size_t k) const {
  const Certainty& its = events_[k];
  if (!is_known(its)) return unknown;
  const double of_sum = roundings_of_sums(*run_) * epsilon * std::abs(run_->events[k].time);
  return std::max(
      {round_off(0.0, time_, its), of_sum / most_of_better, its.of_states * time_ / most_of_better});
}

double TwoRuns::error_of_time(std::size_t k) const {
  const Certainty& its = events_[k];
  if (!is_known(its)) return unknown;
  const double apart = std::abs(run_->events[k].time - reference_->events[its.counterpart].time);
  return std::max({bound_ * apart, round_off_of_time(k), run_->events[k].uncertain});
}

}  // namespace dalembert
