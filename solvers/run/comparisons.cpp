#include "dalembert/solvers/run/comparisons.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/root.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/run/interpolant.h>
#include <dalembert/solvers/run/roundings.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dalembert {

namespace {

constexpr double infinitely_far = std::numeric_limits<double>::infinity();
/// A difference so many times that at the switch is no round-off of it.
constexpr double clearly = 8.0;
constexpr std::size_t most_parts_of_step = 4096;

/// Comparisons of equal numbers.
std::size_t undecided(const Branches::Sides& sides) {
  std::size_t count = 0;
  for (const auto& batch : sides)
    count += static_cast<std::size_t>(std::ranges::count(batch, 0, &Branches::Comparison::side));
  return count;
}

}  // namespace

Comparisons::Comparisons(const Problem& problem, const Start& start, double t, double tolerance,
                         const Branches::Sides& known)
    : equations_(problem, start, tolerance),
      time_(start.scales.time),
      coordinates_(start.q.size()),
      from_(t) {
  if (!equations_.record({t, start.q, start.v}, nullptr, recorded_)) recorded_.clear();
  // Of what is not in force, as a contact that has opened, nothing is recorded.
  recorded_.resize(std::max(recorded_.size(), known.size()));
  for (std::size_t b = 0; b < known.size(); ++b)
    if (!known[b].empty()) recorded_[b] = known[b];
  any_ = std::ranges::any_of(recorded_, [](const auto& batch) { return !batch.empty(); });
  if (!any_) return;
  equations_.start_listening(problem, start);
  held_ = recorded_;
  list_margins();
  find_switch_at_start(start);
}

Comparisons::Comparisons(const Problem& problem, const Start& start, double tolerance, const Behind& behind)
    : Comparisons(problem, start, behind.t, tolerance, behind.sides) {
  at_start_.reset();
  from_ = behind.checked;
  list_margins();
}

/// Between two sides, at a corner of an equation, a motion goes to where the accelerations lead in an
/// instant; what stays there is evaluated as it is.
void Comparisons::find_switch_at_start(const Start& start) {
  std::size_t least = undecided(held_);
  Switch one{};
  one.at = {from_, start.q, start.v, start.a};
  one.step = time_;
  for (double ahead = constants.instant_after * time_; least > 0 && ahead < 1e-3 * time_; ahead *= clearly) {
    move(one.at, ahead, other_);
    if (!equations_.record(other_.instant(), nullptr, recorded_) || undecided(recorded_) >= least) continue;
    least = undecided(recorded_);
    one.behind = recorded_;
    one.ahead = ahead;
  }
  if (one.behind.empty()) return;
  const auto leaves = std::ranges::find_if(
      margins_, [&](const Margin& its) { return its.side == 0 && side_of(its, one.behind) != 0; });
  if (leaves == margins_.end()) return;
  leaves->side = -side_of(*leaves, one.behind);
  one.margin = static_cast<std::size_t>(leaves - margins_.begin());
  one.distance = rounding(one.margin, one.at);
  one.clear = true;
  at_start_ = std::move(one);
}

void Comparisons::go_behind_start() {
  if (!at_start_) return;
  held_ = at_start_->behind;
  at_start_.reset();
  list_margins();
}

void Comparisons::list_margins() {
  margins_.clear();
  at_from_.clear();
  for (std::size_t b = 0; b < held_.size(); ++b)
    for (std::size_t k = 0; k < held_[b].size(); ++k) margins_.push_back({b, k, held_[b][k].side});
  in_step_.clear();
  for (std::vector<double>* all : {&at_from_, &at_end_}) all->reserve(margins_.size());
  for (std::vector<double>* all : {&least_, &bend_}) all->resize(margins_.size());
  suspects_.reserve(margins_.size());
  passed_.reserve(margins_.size());
  for (std::vector<double>* all : {&motion_.q, &motion_.v}) all->resize(coordinates_);
}

/// What is no longer compared has left its side.
int Comparisons::side_of(const Margin& of, const Branches::Sides& recorded) {
  const bool is_made = of.batch < recorded.size() && of.comparison < recorded[of.batch].size();
  return is_made ? recorded[of.batch][of.comparison].side : -1;
}

/// How far what was recorded is from leaving its side: negative behind.
double Comparisons::margin(const Margin& of, const Branches::Sides& recorded) {
  if (of.batch >= recorded.size() || of.comparison >= recorded[of.batch].size()) return infinitely_far;
  const double difference = recorded[of.batch][of.comparison].difference;
  if (std::isnan(difference)) return infinitely_far;
  return of.side == 0 ? (difference == 0.0 ? 1.0 : -1.0) : of.side * difference;
}

bool Comparisons::hear_step(double t, bool sketched) {
  motion_.t = t;
  motion_.q.resize(coordinates_);
  motion_.v.resize(coordinates_);
  if (sketched) {
    stepper_->sketch(t, motion_.q, motion_.v);
  } else {
    stepper_->interpolate(t, motion_.q, motion_.v);
  }
  return equations_.record(motion_.instant(), &held_, recorded_);
}

void Comparisons::find_margins(double t, bool sketched, std::vector<double>& all) {
  all.assign(margins_.size(), infinitely_far);
  if (!hear_step(t, sketched)) return;
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = margin(margins_[k], recorded_);
}

/// Of the motion in the step. All are recorded together, each time once: one evaluation of the equations
/// serves every margin.
double Comparisons::margin_at(std::size_t k, double t) {
  std::vector<double>& all = in_step_[t];
  if (all.empty()) find_margins(t, false, all);
  return all[k];
}

/// By how much margins bend over the part of a step that is looked at: with all their values between its
/// ends.
void Comparisons::note_bend(double t, double to, const Branches::Sides& recorded) {
  const double x = (t - from_) / (to - from_);
  for (std::size_t k = 0; k < margins_.size(); ++k) {
    const double value = margin(margins_[k], recorded);
    least_[k] = std::min(least_[k], value);
    const double bend = 2.0 * std::abs(value - ((1.0 - x) * at_from_[k] + x * at_end_[k]));
    if (!(bend <= bend_[k])) bend_[k] = bend;
  }
}

/// Those that may have left their side in the step: they are behind somewhere, or closer to where they switch
/// than they bend within the step. What the stepper compared on its way costs nothing; it leaves out what
/// lies around 0.65. Where something depends on time, which steps do not follow, all that vary.
const std::vector<std::size_t>& Comparisons::suspects(double to) {
  constexpr double between_stages = 0.65;
  if (at_from_.empty()) find_margins(from_, false, at_from_);
  find_margins(to, false, at_end_);
  for (std::size_t k = 0; k < margins_.size(); ++k) least_[k] = std::min(at_from_[k], at_end_[k]);
  bend_.assign(margins_.size(), 0.0);
  const auto on_the_way = from_ == start_of_step_ ? stepper_->compared() : std::span<const Compared>{};
  for (const Compared& one : on_the_way) note_bend(one.t, to, one.sides);
  const double x = on_the_way.empty() ? 0.5 : between_stages, t = from_ + x * (to - from_);
  if (!hear_step(t, true)) recorded_.clear();
  note_bend(t, to, recorded_);
  suspects_.clear();
  for (std::size_t k = 0; k < margins_.size(); ++k) {
    if (std::ranges::find(passed_, margins_[k]) != passed_.end()) continue;
    const bool constant = bend_[k] == 0.0 && at_from_[k] == at_end_[k] && least_[k] > 0.0;
    if (!constant && (equations_.system().timed_batch(margins_[k].batch) || !(least_[k] > bend_[k])))
      suspects_.push_back(k);
  }
  return suspects_;
}

/// Where a margin first becomes negative, if it does before `until`, among its interpolants: those of all
/// margins have the same nodes. One that is 0 where the step ends, as at a sample at the time of a switch, is
/// left there if it goes on so. Throws StepFailure where it cannot be followed.
std::optional<Comparisons::Bracket> Comparisons::first_root(std::size_t k, double until, double to) {
  const FunctionOfTime f = [&](double t) { return margin_at(k, t); };
  const int degree = std::max(stepper_->degree(), least_degree);
  const Interpolant whole = interpolate(f, from_, to, degree);
  if (!std::ranges::all_of(whole.values, [](double x) { return std::isfinite(x); })) return std::nullopt;
  if (whole.values.front() < 0.0) return Bracket{from_, 1.0, from_, whole.values.front(), k};
  std::vector<double> checks;
  for (const double t : check_times(from_, to, degree)) checks.push_back(f(t));
  const double rounding = constants.roundings_at_contacts * epsilon * largest(whole.values);
  std::optional<Bracket> first;
  const auto leaves_in = [&](const Interpolant& p) {
    for (std::size_t j = 1; j < p.nodes.size() && !first; ++j) {
      const double a = p.nodes[j - 1], b = p.nodes[j], f_a = p.values[j - 1], f_b = p.values[j];
      if (f_b < 0.0 || (f_b == 0.0 && b == to)) {
        first = Bracket{a, f_a, b, f_b, k};
      } else if (p.slope(j - 1) < 0.0 && p.slope(j) > 0.0) {
        const double t = p.turn(a, b, 1), f_t = f(t);
        if (f_t < 0.0) first = Bracket{a, f_a, t, f_t, k};
      }
    }
    return first.has_value() || p.nodes.back() >= until;
  };
  if (resolve(f, whole, checks, rounding, most_parts_of_step, leaves_in)) return first;
  throw StepFailure{equations_.system().label_of_batch(margins_[k].batch) +
                        " compares what varies faster than can be followed within a step of " +
                        std::to_string(to - from_) + "; choose a max_step in the options that is shorter",
                    from_};
}

std::optional<Comparisons::Root> Comparisons::first_switch(double to) {
  std::optional<Root> first;
  for (const std::size_t k : suspects(to)) {
    const auto bracket = first_root(k, first ? first->t : to, to);
    if (!bracket || (first && bracket->a >= first->t)) continue;
    const auto f = [&](double t) { return margin_at(k, t); };
    const double exact = 4.0 * epsilon * std::max(std::abs(bracket->a), std::abs(bracket->b));
    const double t = bracket->a < bracket->b
                         ? root(f, bracket->a, bracket->f_a, bracket->b, bracket->f_b, exact)
                         : bracket->b;
    if (!first || t < first->t) first = Root{t, k};
  }
  return first;
}

/// The margin of a motion that goes on with its own accelerations.
double Comparisons::margin_ahead(std::size_t k, const Motion& from, double ahead) {
  move(from, ahead, other_);
  return equations_.record(other_.instant(), &held_, recorded_) ? margin(margins_[k], recorded_)
                                                                : -infinitely_far;
}

/// What roundings of the coordinates make of a margin.
double Comparisons::rounding(std::size_t k, const Motion& at) {
  const double here = margin_ahead(k, at, 0.0);
  move(at, 0.0, other_);
  double most = 0.0;
  round_by_turns(at.q, other_.q, [&] {
    if (equations_.record(other_.instant(), &held_, recorded_))
      most = std::max(most, std::abs(margin(margins_[k], recorded_) - here));
  });
  return most;
}

/// The sides where a switch has been left.
bool Comparisons::hear_behind(Switch& one) {
  move(one.at, one.ahead, other_);
  return equations_.record(other_.instant(), nullptr, one.behind);
}

/// The motion behind has left its side: a difference that is 0 there, as of multipliers that are round-off,
/// is not behind yet.
Comparisons::Switch Comparisons::behind(const Root& root, double step) {
  Switch one{};
  one.margin = root.margin;
  one.step = step;
  one.distance =
      hear_step(root.t, false) ? std::abs(margin(margins_[root.margin], recorded_)) : infinitely_far;
  one.at = motion_;
  if (!equations_.accelerate(one.at, held_)) throw linearly_dependent(root.t);
  one.distance = std::max(one.distance, rounding(root.margin, one.at));
  const Margin& its = margins_[root.margin];
  one.ahead = 16.0 * epsilon * std::max(std::abs(root.t), time_);
  for (; one.ahead < 1e-3 * step; one.ahead *= 2.0) {
    const double margin = margin_ahead(root.margin, one.at, one.ahead);
    one.clear = margin < 0.0 && (its.side == 0 || -margin >= clearly * one.distance) && hear_behind(one) &&
                side_of(its, one.behind) != 0;
    if (one.clear) return one;
  }
  if (!hear_behind(one)) {
    equations_.evaluate(other_.instant());  // throws what fails there
    one.behind = held_;
  }
  return one;
}

/// Whether the step, which was taken on other sides, goes wrong on those that hold from a switch `until` the
/// next: also in between, as a push by half a sine is 0 at both ends.
bool Comparisons::goes_wrong(const Branches::Sides& taken, double until) {
  std::vector<double> none(coordinates_);
  Motion there{until, none, none, {}};
  auto times = check_times(from_, until, std::max(stepper_->degree(), least_degree));
  times.push_back(until);
  return std::ranges::any_of(times, [&](double t) {
    there.t = t;
    stepper_->interpolate(t, there.q, there.v);
    return equations_.differ(there, taken, held_);
  });
}

std::optional<Comparisons::Switch> Comparisons::leave(TimeStepper& stepper) {
  const double from = from_, to = stepper.time();
  if (!any_ || !(to > from)) return std::nullopt;
  stepper_ = &stepper;
  start_of_step_ = from;
  passed_.clear();
  in_step_.clear();
  const Branches holding(nullptr, &held_);
  std::optional<Switch> last;  // that had no effect where it is
  Branches::Sides taken, before_last;
  const auto next = [&] { return from_ < to ? first_switch(to) : std::nullopt; };
  for (auto root = next(); root || last; root = next()) {
    if (last && goes_wrong(taken, root ? root->t : to)) {
      held_ = std::move(before_last);
      list_margins();
      return last;
    }
    if (!root) break;
    if (!last) taken = held_;
    Switch one = behind(*root, to - from);
    if (corner(one) || impulse(one) || equations_.differ(one.at, taken, one.behind)) return one;
    if (!one.clear) passed_.push_back(margins_[root->margin]);
    from_ = std::min(to, root->t + one.ahead);
    before_last = std::exchange(held_, one.behind);
    list_margins();
    last = std::move(one);
  }
  std::swap(at_from_, at_end_);
  from_ = to;
  return std::nullopt;
}

void Comparisons::refuse_corner(const Switch& one, std::size_t row) const {
  throw StepFailure{
      equations_.system().row_label(row) +
          " changes its gradient by a jump here: the velocity before does not satisfy it behind. "
          "That is an impact, which the equations do not describe; end the run here, or round it "
          "off",
      one.at.t};
}

std::optional<std::size_t> Comparisons::impulse(const Switch& one) {
  move(one.at, one.ahead, other_);
  return equations_.impulse(one.at, other_.instant(), held_, one.behind);
}

void Comparisons::require_no_impulse(const Switch& one) {
  if (const auto batch = impulse(one))
    throw StepFailure{
        equations_.system().label_of_batch(*batch) +
            " jumps here, or its momenta do: that is an impulse, which the equations do not "
            "describe. Smooth the jump; or end the run here, and begin another with the velocities behind it",
        one.at.t};
}

/// Whether the motion before the switch would return by itself: it touches where it turns, and either side
/// goes on.
bool Comparisons::turns_back(const Switch& one, double from) {
  for (double ahead = from; ahead < 1e-3 * one.step; ahead *= 2.0)
    if (margin_ahead(one.margin, one.at, ahead) > 0.0) return true;
  return false;
}

void Comparisons::require_leaving(const Switch& one, std::span<const double> a) {
  Motion at = one.at;
  at.a.assign(a.begin(), a.end());
  for (double ahead = 4.0 * one.ahead; ahead < 1e-3 * one.step; ahead *= clearly) {
    const double margin = margin_ahead(one.margin, at, ahead);
    if (margins_[one.margin].side != 0 && std::abs(margin) < clearly * one.distance) continue;
    if (margin < 0.0) return;
    if (!turns_back(one, ahead)) chatters(one);
    return;
  }
}

void Comparisons::chatters(const Switch& one) {
  if (const auto message = equations_.would_stick(one.at, held_, one.behind))
    throw StepFailure{*message, one.at.t};
  throw StepFailure{equations_.system().label_of_batch(margins_[one.margin].batch) +
                        " switches here, and on both sides the motion is driven back to where it does: it "
                        "would chatter. Smooth the switch, or end the run here",
                    one.at.t};
}

}  // namespace dalembert
