#include "dalembert/solvers/contact/contacts.h"

#include <dalembert/core/analysis/islands.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/contact_accelerations.h>
#include <dalembert/solvers/contact/contact_law.h>
#include <dalembert/solvers/contact/contact_resolution.h>
#include <dalembert/solvers/contact/contacts_at_start.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace dalembert {

namespace {

/// The gap up to which a change of the scene leaves a contact closed.
double left_closed(const ContactState& contact, const ContactAccuracy& known) {
  return start_tolerance * known.scales.length * contact.gradient;
}

}  // namespace

Contacts::Contacts(std::shared_ptr<const System> stated, const Scales& scales, double tolerance,
                   const Instant& start, double duration, bool friction)
    : stated_(std::move(stated)),
      known_{scales, Accuracy(tolerance), duration},
      friction_(friction),
      fastest_(start.v.size()),
      gaps_(*stated_),
      forces_(*stated_) {
  find_gaps(start);
  auto its = find_contacts(*stated_, known_.scales, start, gaps_);
  contacts_ = std::move(its.contacts);
  touching_at_start_ = std::move(its.touching);
  rebuild_system();
}

/// See ContactForces. One that was closed without a force is neither pressed nor left, to round-off.
double Contacts::no_pull(const ContactState& contact, const FlatSample& now) const {
  const double round_off_of_scene =
      contact.bears || friction_ ? 0.0 : round_off() * known_.own_acceleration(contact);
  return forces_.no_pull(*system_, contact, now, known_, 2.0 * contact.accepted + round_off_of_scene);
}

/// See `switching`. What has parted since is below its surface by round-off at most.
bool Contacts::counts_by_rate(const ContactState& c) const {
  const double gap = gaps_.gap(c), none = known_.no_gap(c, gaps_.rounding()),
               error = c.parted ? none : std::max(none, known_.error_of_gap(c));
  return gaps_.rate(c) > known_.no_rate(c) && gap <= error && gap >= c.gap_at_opening - error;
}

double Contacts::switching(std::size_t contact, const FlatSample& now) const {
  const ContactState& c = contacts_[contact];
  if (c.closed) return c.sign * now.lambda[c.row] + no_pull(c, now);
  if (now.time == c.opened_at) return c.rate_at_opening;
  if (!gaps_.found_at(now.time)) find_gaps({now.time, now.q, now.v});
  if (counts_by_rate(c)) return gaps_.rate(c);
  const double gap = gaps_.gap(c), since = c.opened_at ? now.time - *c.opened_at : 1.0;
  return std::abs(gap) <= known_.no_gap(c, gaps_.rounding()) ? 0.0 : gap / since;
}

double Contacts::rate(std::size_t contact, const FlatSample& now) const {
  const ContactState& c = contacts_[contact];
  if (c.closed || now.time == c.opened_at) return std::numeric_limits<double>::quiet_NaN();
  if (!gaps_.found_at(now.time)) find_gaps({now.time, now.q, now.v});
  const double gap = gaps_.gap(c), rate = gaps_.rate(c);
  if (gap <= known_.no_gap(c, gaps_.rounding()) || counts_by_rate(c))
    return std::numeric_limits<double>::quiet_NaN();
  if (!c.opened_at) return rate;
  const double since = now.time - *c.opened_at;
  return (rate - gap / since) / since;
}

double Contacts::unit(std::size_t contact, double from) const {
  const ContactState& c = contacts_[contact];
  if (c.closed) return 0.0;
  if (!c.parted) return known_.scales.speed() * c.gradient;
  if (!c.opened_at || *c.opened_at >= from) return 0.0;
  return known_.no_gap(c, gaps_.rounding()) / (from - *c.opened_at) / known_.accuracy.of_forces();
}

/// Contacts that have fallen, that have no gap, that have just reached 0, and those that will within the
/// resolution of times; and those closed in the islands of these.
std::vector<std::size_t> Contacts::touching(const Instant& at,
                                            const std::vector<std::size_t>& triggered) const {
  const double same_time = known_.accuracy.of_times() * known_.scales.time;
  auto touches = marks(triggered, contacts_.size());
  std::set<std::size_t> islands;
  find_gaps(at);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ContactState& c = contacts_[i];
    const double gap = gaps_.gap(c), rate = gaps_.rate(c);
    const double none = known_.no_gap(c, gaps_.rounding());
    const bool lies = gap <= none && rate <= known_.still(c);
    if (!c.closed && (lies || (rate < 0.0 && gap + rate * same_time <= none))) touches[i] = 1;
    if (touches[i] || everywhere_) islands.insert(c.island);
  }
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ContactState& c = contacts_[i];
    if (touches[i] || (c.closed && islands.contains(c.island))) touching.push_back(i);
  }
  join_within_error(at, touching);
  return touching;
}

/// Beside an impact adds what closes from within the error e of its gap, where that impact acts on it: when
/// it closes is known to e/|rate| only, however slow it is, and so is which of those that meet a surface
/// together is the first. One by one the feet of what falls flat would turn it: gaps that differ by round-off
/// do so on all hops, and the times at which they close move apart as hops become lower. What is struck so is
/// above its surface by no more than a step errs; what counts as still there would rest above it, and does
/// not join.
void Contacts::join_within_error(const Instant& at, std::vector<std::size_t>& touching) const {
  const std::size_t own = touching.size();
  const auto touches = marks(touching, contacts_.size());
  std::set<std::size_t> islands;
  for (const std::size_t i : touching) {
    const ContactState& c = contacts_[i];
    if (!c.closed && gaps_.rate(c) < -known_.no_rate(c)) islands.insert(c.island);
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ContactState& c = contacts_[i];
    const bool closes = gaps_.rate(c) < -known_.still(c) && gaps_.gap(c) <= known_.error_of_gap(c);
    if (!touches[i] && !c.closed && closes && islands.contains(c.island)) touching.push_back(i);
  }
  if (touching.size() == own) return;
  keep_reached(*coupling_of(*stated_, contacts_, touching, at), own, known_.scales, gaps_.rounding(),
               touching);
  std::ranges::sort(touching);
}

std::optional<std::size_t> Contacts::approaching() const {
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (!contacts_[i].closed && contacts_[i].rate_at_opening < 0.0) return i;
  return std::nullopt;
}

Change Contacts::resolve_start(const Instant& start) {
  std::vector<std::size_t> stay;
  find_gaps(start);
  for (const std::size_t i : touching_at_start_) {
    ContactState& c = contacts_[i];
    const double rate = gaps_.rate(c);
    if (rate <= known_.still(c)) {
      stay.push_back(i);
    } else {
      c.open(start.t, rate, gaps_.gap(c));
    }
  }
  return resolve(start, stay);
}

Change Contacts::resolve(const Instant& at, const std::vector<std::size_t>& triggered) {
  ContactResolution resolution(stated_, contacts_, known_, gaps_, at, triggered);
  const bool known_roughly = !started_ || approaching();
  started_ = true;
  auto touched = touching(at, triggered);
  if (!touched.empty()) {
    resolution.resolve(std::move(touched), known_roughly, friction_);
    everywhere_ = false;
    rebuild_system();
  }
  return resolution.change();
}

std::optional<std::size_t> Contacts::driven_apart(const Instant& at) const {
  std::vector<std::size_t> closed;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].closed) closed.push_back(i);
  if (closed.empty()) return std::nullopt;
  const auto coupling = coupling_of(*stated_, contacts_, closed, at);
  const Eigen::VectorXd free = coupling->accelerations_without(at);
  for (std::size_t k = 0; k < closed.size(); ++k) {
    const auto place = static_cast<Eigen::Index>(k);
    if (coupling->is_held(place) && free[place] > round_off() * known_.own_acceleration(contacts_[closed[k]]))
      return closed[k];
  }
  return std::nullopt;
}

bool Contacts::open_pulling(const FlatSample& now, std::vector<EventRecord>& events) {
  find_gaps({now.time, now.q, now.v});
  double largest = 0.0;
  for (const double lambda : now.lambda) largest = std::max(largest, std::abs(lambda));
  const auto pull = [&](const ContactState& c) { return c.sign * now.lambda[c.row]; };
  const auto may_open = [&](const ContactState& c) {
    return c.closed && (friction_ || !now.unique[c.row]) &&
           pull(c) < -std::max(round_off() * largest, no_pull(c, now));
  };
  const auto most = std::ranges::min_element(
      contacts_, {}, [&](const ContactState& c) { return may_open(c) ? pull(c) : 0.0; });
  if (most == contacts_.end() || !may_open(*most)) return false;
  bool found = false;
  for (ContactState& c : contacts_) {
    const bool opens = friction_ ? &c == &*most : c.closed && !c.bears && c.island == most->island;
    if (!opens) continue;
    c.open(now.time, 0.0, gaps_.gap(c));
    found = true;
    if (c.closed_at < now.time) events.push_back({c.number, now.time, EventKind::opened});
  }
  rebuild_system();
  return found;
}

void Contacts::note_speeds(std::span<const double> v) {
  for (std::size_t i = 0; i < v.size(); ++i) fastest_[i] = std::max(fastest_[i], std::abs(v[i]));
}

std::vector<double> Contacts::unknown_speeds(double known) const {
  const auto island = islands(*stated_).of_coordinate;
  const auto lengths = known_.scales.lengths();
  std::vector<double> of_islands(island.size()), all;
  for (std::size_t i = 0; i < island.size(); ++i) {
    double& speed = of_islands[island[i]];
    speed = std::max(speed, known * fastest_[i] * lengths[i]);
  }
  for (const std::size_t one : island) all.push_back(of_islands[one]);
  return all;
}

void Contacts::require_open(const FlatSample& now) {
  note_speeds(now.v);
  find_gaps({now.time, now.q, now.v});
  for (ContactState& c : contacts_) {
    const double gap = gaps_.gap(c);
    if (c.closed && c.sign * now.lambda[c.row] > no_pull(c, now)) c.accepted = 0.0;  // it is pressed now
    c.parted = c.parted || gap > known_.error_of_gap(c);
    const double error = known_.error_where_closed(c, gaps_.rounding(), now.time, gaps_.rate(c));
    if (c.closed || gap >= -error) continue;
    throw StepFailure{
        stated_->row_label(c.row) + " was penetrated: at none of the times examined was it closed", now.time};
  }
}

void Contacts::require_separation(const FlatSample& now) const {
  find_gaps({now.time, now.q, now.v});
  require_open_at_rest(*stated_, contacts_, known_, gaps_, now);
}

std::vector<std::size_t> Contacts::open_in(const System& stated, const Instant& at) const {
  Gaps gaps(stated);
  gaps.find(stated, known_.scales, at);
  std::vector<std::size_t> open;
  for (const ContactState& c : contacts_)
    if (!c.closed || std::abs(gaps.gap(c)) > left_closed(c, known_)) open.push_back(c.number);
  return open;
}

std::vector<std::size_t> Contacts::replace_system(std::shared_ptr<const System> stated, const Instant& at,
                                                  const std::optional<Joining>& joining) {
  if (stated != stated_) replace_equations(contacts_, *stated_, *stated, known_.scales, at);
  stated_ = std::move(stated);
  system_.reset();
  find_gaps(at);
  Gaps before = gaps_;
  std::vector<double> unknown(at.v.size());
  if (joining) {
    note_speeds(joining->v);
    before.find(*stated_, known_.scales, {at.t, at.q, joining->v});
    unknown = unknown_speeds(joining->known);
  }
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    ContactState& c = contacts_[i];
    const Contact& law = *stated_->conditions().of[c.number].contact;
    c.restitution = law.restitution;
    c.sign = law.sign();
    const double gap = gaps_.gap(c), allowed = left_closed(c, known_);
    if (gap < -allowed) refuse(*stated_, contacts_, {i}, at.t, "a change of the scene leaves it violated");
    const double unit = known_.scales.speed() * c.gradient, given = before.rate(c), rate = gaps_.rate(c);
    c.moved = c.closed && std::abs(given) > known_.accuracy.of_velocities() * unit;
    const bool jerked = joining && std::abs(rate - given) > known_.no_rate(c);
    c.unknown = unknown[stated_->w_columns()[stated_->row(c.row).front()]] * c.gradient;
    if (gap <= allowed) {
      // More than it approaches with and without the joint would be energy from nowhere.
      if (jerked) c.arrives = c.closed && !c.moved ? 0.0 : std::min(std::max(given, rate), 0.0);
      if (!c.closed) touching.push_back(i);
    } else if (c.closed) {
      c.closed = c.moved = false;
      c.opened_at.reset();
      c.impacts = {};
    }
  }
  rebuild_system();
  everywhere_ = true;
  return touching;
}

std::vector<std::size_t> Contacts::open() const {
  std::vector<std::size_t> open;
  for (const ContactState& c : contacts_)
    if (!c.closed) open.push_back(c.number);
  return open;
}

void Contacts::rebuild_system() {
  forget_instant();
  const auto as_stated = [this](const ContactState& c) { return system_->in_force(c.row) == c.closed; };
  if (!system_ || !std::ranges::all_of(contacts_, as_stated))
    system_ = std::make_shared<const System>(stated_->without(open()));
}

}  // namespace dalembert
