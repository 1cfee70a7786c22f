#include "dalembert/solvers/contact/contacts.h"

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/start.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

/// The length of each contact's gradient; 0 where it has none, as for a string of length 0.
std::vector<double> gradients(const System& stated, const std::vector<std::size_t>& contacts,
                              const Instant& at, std::span<const double> lengths) {
  const auto of = [&](const System& system, std::size_t number, const System::Evaluation& e) {
    return gradient_length(system, e.w, lengths, stated.layout()->constraints[number].own_rows().front());
  };
  const System together = stated.without(stated.frictional_constraints());
  auto e = together.evaluation();
  std::vector<double> all;
  try {
    together.evaluate(at, e);
    for (const std::size_t number : contacts) all.push_back(of(together, number, e));
    return all;
  } catch (const EquationFault&) {  // of one of them
  }
  for (const std::size_t number : contacts) {
    std::vector<std::size_t> others = stated.conditional_constraints();
    std::erase(others, number);
    const System alone = stated.without(others);
    try {
      alone.evaluate(at, e);
      all.push_back(of(alone, number, e));
    } catch (const EquationFault&) {
      all.push_back(0.0);
    }
  }
  return all;
}

}  // namespace

double nearest_contact(const System& stated, const Instant& at) {
  std::vector<double> g(stated.rows()), rates(stated.rows());
  stated.gaps(at, g, rates);
  const std::vector<double> ones(stated.coordinates(), 1.0);
  double farthest = 0.0;
  for (const double x : at.q) farthest = std::max(farthest, std::abs(x));
  double nearest = std::numeric_limits<double>::infinity();
  const auto contacts = stated.contacts();
  const auto lengths_of_gradients = gradients(stated, contacts, at, ones);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double gradient = lengths_of_gradients[i];
    const double gap = std::abs(g[stated.layout()->constraints[contacts[i]].own_rows().front()]);
    if (gap > round_off() * farthest * gradient) nearest = std::min(nearest, gap / gradient);
  }
  return nearest;
}

Contacts::Contacts(std::shared_ptr<const System> stated, const Scales& scales, double tolerance,
                   const Instant& start, double duration, bool friction)
    : stated_(std::move(stated)),
      scales_(scales),
      accuracy_(tolerance),
      duration_(duration),
      friction_(friction),
      g_(stated_->rows()),
      psi_(stated_->rows()),
      e_(stated_->evaluation()) {
  const Islands all = islands(*stated_);
  for (const std::size_t number : stated_->contacts()) {
    const Layout::Constraint& its = stated_->layout()->constraints[number];
    contacts_.push_back({.number = number,
                         .row = its.own_rows().front(),
                         .sign = its.condition.contact->sign(),
                         .restitution = its.condition.contact->restitution,
                         .island = all.of_row(*stated_, its.own_rows().front())});
  }
  find_gaps(start);
  const auto lengths_of_gradients = gradients(*stated_, stated_->contacts(), start, scales_.lengths());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    const double gap = c.sign * g_[c.row], gradient = lengths_of_gradients[i];
    // Positions are known to their rounding and to that of the time: a sample of an impact is a start.
    const double rounding =
        gradient * scales_.rounding(start.q) + round_off() * std::abs(start.t * psi_[c.row]);
    const double allowed = std::max(start_tolerance * scales_.length * gradient, rounding);
    if (std::abs(gap) <= allowed) touching_at_start_.push_back(i);
    c.gradient = gradient;
    if (gap >= -allowed) continue;
    std::ostringstream what;
    what << stated_->row_label(c.row) << " is violated by the initial positions: by a distance of "
         << -gap / gradient << " on the forbidden side at t = " << start.t << "; correct the positions";
    throw InconsistentStart(what.str());
  }
  rebuild_system();
}

Contacts::Contact& Contacts::contact_of(const EventRecord& event) {
  return *std::ranges::lower_bound(contacts_, event.source, {}, &Contact::number);
}

bool Contacts::among(const std::vector<std::size_t>& all, std::size_t contact) {
  return std::ranges::find(all, contact) != all.end();
}

void Contacts::find_gaps(const Instant& at) const {
  stated_->gaps(at, g_, psi_);
  gaps_at_ = at.t;
}

/// What constraints exert on each coordinate together, but for rods inside bodies; what compliant ones make
/// there of the rounding of positions; and the gradients.
void Contacts::find_forces(const FlatSample& now) const {
  if (forces_at_ == now.time) return;
  forces_at_ = now.time;
  system_->evaluate({now.time, now.q, now.v}, e_);
  forces_.assign(now.a.size(), 0.0);
  noise_.assign(now.a.size(), 0.0);
  const double rounding = scales_.rounding(now.q);
  for (std::size_t r = 0; r < system_->rows(); ++r) {
    if (!system_->law(r).compliant() || !system_->in_force(r)) continue;
    const double stretch = gradient_length(*system_, e_.w, scales_.lengths(), r) * rounding;
    for (const std::size_t k : system_->row(r))
      noise_[system_->w_columns()[k]] += std::abs(e_.w[k]) * stretch / system_->law(r).compliance;
  }
  for (const Layout::Constraint& c : stated_->layout()->constraints) {
    if (c.internal) continue;
    std::size_t k = stated_->row(c.own_rows().front()).front();
    for (const std::size_t slot : c.slots()) {
      const double force = std::abs(now.forces[slot]);
      if (!std::isnan(force)) forces_[stated_->w_columns()[k]] += force;
      ++k;
    }
  }
}

/// What is no pull yet: a part, as positions are known, of the forces on what a contact touches, as they act
/// on its gap; what springs make of the rounding of positions; and what would change the gap by no more than
/// its round-off in all of the run. What acts elsewhere tells nothing about how exactly it is known.
double Contacts::no_pull(const Contact& contact, const FlatSample& now) const {
  find_forces(now);
  double net = 0.0, others = 0.0, inverse_mass = 0.0;
  // One that was closed without a force is neither pressed nor left, to round-off.
  double noise = no_acceleration(contact, now.q) + 2.0 * contact.accepted +
                 (contact.bears || friction_ ? 0.0 : round_off() * own_acceleration(contact));
  for (const std::size_t k : stated_->row(contact.row)) {
    const std::size_t i = stated_->w_columns()[k];
    const double w = e_.w[k], mass = stated_->masses()[i];
    if (!std::isnan(now.a[i])) net += w * now.a[i];
    others += std::abs(w) * (std::abs(e_.force[i]) + forces_[i]) / mass;
    noise += std::abs(w) * noise_[i] / mass;
    inverse_mass += w * w / mass;
  }
  if (!(inverse_mass > 0.0)) return 0.0;
  return (accuracy_.of_positions() * (std::abs(net) + others) + noise) / inverse_mass;
}

double Contacts::switching(std::size_t contact, const FlatSample& now) const {
  const Contact& c = contacts_[contact];
  if (c.closed) return c.sign * now.lambda[c.row] + no_pull(c, now);
  if (now.time == c.opened_at) return c.rate_at_opening;
  if (gaps_at_ != now.time) find_gaps({now.time, now.q, now.v});
  const double gap = c.sign * g_[c.row], rate = c.sign * psi_[c.row];
  const double none = no_gap(c, now.q), below = c.parted ? none : std::max(none, error_of_gap(c));
  const bool leaves = rate > no_rate(c);
  if (leaves && gap <= none && gap >= c.gap_at_opening - below) return rate;
  const double since = c.opened_at ? now.time - *c.opened_at : 1.0;
  return std::abs(gap) <= none ? 0.0 : gap / since;
}

double Contacts::rate(std::size_t contact, const FlatSample& now) const {
  const Contact& c = contacts_[contact];
  if (c.closed || now.time == c.opened_at) return never;
  if (gaps_at_ != now.time) find_gaps({now.time, now.q, now.v});
  const double gap = c.sign * g_[c.row], rate = c.sign * psi_[c.row];
  if (gap <= no_gap(c, now.q)) return never;
  if (!c.opened_at) return rate;
  const double since = now.time - *c.opened_at;
  return (rate - gap / since) / since;
}

double Contacts::unit(std::size_t contact) const {
  const Contact& c = contacts_[contact];
  return c.closed || c.parted ? 0.0 : scales_.speed() * c.gradient;
}

/// Contacts that have fallen, that have no gap, that have just reached 0, and those that will within the
/// resolution of times; and those closed in the islands of these.
std::vector<std::size_t> Contacts::touching(const Instant& at,
                                            const std::vector<std::size_t>& triggered) const {
  const double same_time = accuracy_.of_times() * scales_.time;
  std::vector<char> touches(contacts_.size(), 0);
  std::set<std::size_t> islands;
  find_gaps(at);
  for (const std::size_t i : triggered) touches[i] = 1;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    const double gap = c.sign * g_[c.row], rate = c.sign * psi_[c.row];
    const double none = no_gap(c, at.q);
    const bool lies = gap <= none && rate <= still(c);
    if (!c.closed && (lies || (rate < 0.0 && gap + rate * same_time <= none))) touches[i] = 1;
    if (touches[i] || everywhere_) islands.insert(c.island);
  }
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    if (touches[i] || (c.closed && islands.contains(c.island))) touching.push_back(i);
  }
  return touching;
}

std::vector<std::size_t> Contacts::numbers(const std::vector<std::size_t>& chosen) const {
  std::vector<std::size_t> numbers;
  for (const std::size_t i : chosen) numbers.push_back(contacts_[i].number);
  return numbers;
}

std::shared_ptr<const System> Contacts::only(const std::vector<std::size_t>& in_force) const {
  std::vector<char> out(contacts_.size(), 1);
  for (const std::size_t i : in_force) out[i] = 0;
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (out[i]) others.push_back(contacts_[i].number);
  return std::make_shared<const System>(stated_->without(others));
}

void Contacts::refuse(const std::vector<std::size_t>& contacts, double t, const char* what) const {
  std::string names;
  for (const std::size_t i : contacts)
    names += (names.empty() ? "" : ", ") + stated_->row_label(contacts_[i].row);
  throw StepFailure{names + ": " + what, t};
}

bool Contacts::open_pulling(const FlatSample& now, std::vector<EventRecord>& events) {
  find_gaps({now.time, now.q, now.v});
  double largest = 0.0;
  for (const double lambda : now.lambda) largest = std::max(largest, std::abs(lambda));
  const auto pull = [&](const Contact& c) { return c.sign * now.lambda[c.row]; };
  const auto may_open = [&](const Contact& c) {
    return c.closed && (friction_ || !now.unique[c.row]) &&
           pull(c) < -std::max(round_off() * largest, no_pull(c, now));
  };
  const auto most =
      std::ranges::min_element(contacts_, {}, [&](const Contact& c) { return may_open(c) ? pull(c) : 0.0; });
  if (most == contacts_.end() || !may_open(*most)) return false;
  bool found = false;
  for (Contact& c : contacts_) {
    const bool opens = friction_ ? &c == &*most : c.closed && !c.bears && c.island == most->island;
    if (!opens) continue;
    open(c, now.time, 0.0);
    found = true;
    if (c.closed_at < now.time) events.push_back({c.number, now.time, EventKind::opened});
  }
  rebuild_system();
  return found;
}

/// Gaps that count as 0: round-off of the positions.
double Contacts::no_gap(const Contact& contact, std::span<const double> q) const {
  return contact.gradient * scales_.rounding(q);
}

/// Rates that count as 0: round-off of the scene's own speed, however slow it is just then. What slides back
/// may be found to rest a round-off beyond, see DryFriction::switching.
double Contacts::no_rate(const Contact& contact) const {
  return 2.0 * round_off() * scales_.speed() * contact.gradient;
}

/// Accelerations that count as 0, of what rests without a force: they change a gap by its round-off in the
/// run.
double Contacts::no_acceleration(const Contact& contact, std::span<const double> q) const {
  return no_gap(contact, q) / (duration_ * duration_);
}

/// The error of a step in a gap.
double Contacts::error_of_gap(const Contact& contact) const {
  return accuracy_.of_positions() * scales_.length * contact.gradient;
}

void Contacts::require_open(const FlatSample& now) {
  find_gaps({now.time, now.q, now.v});
  for (Contact& c : contacts_) {
    const double gap = c.sign * g_[c.row];
    if (c.closed && c.sign * now.lambda[c.row] > no_pull(c, now)) c.accepted = 0.0;  // it is pressed now
    c.parted = c.parted || gap > error_of_gap(c);
    const double of_time = 8.0 * epsilon * std::abs(now.time * psi_[c.row]);
    if (c.closed || gap >= -error_of_gap(c) - of_time) continue;
    throw StepFailure{
        stated_->row_label(c.row) + " was penetrated: at none of the times examined was it closed", now.time};
  }
}

void Contacts::require_separation(const FlatSample& now) const {
  const Instant at{now.time, now.q, now.v};
  find_gaps(at);
  auto e = stated_->evaluation();
  std::vector<double> gamma;
  for (const Contact& c : contacts_) {
    const double rate = c.sign * psi_[c.row];
    const bool rests =
        !c.closed && c.sign * g_[c.row] <= no_gap(c, now.q) && rate >= -still(c) && rate <= no_rate(c);
    if (!rests) continue;
    if (gamma.empty()) {
      gamma.resize(stated_->rows());
      stated_->evaluate_with_bias(at, e, gamma);
    }
    double acceleration = gamma[c.row], terms = std::abs(acceleration);
    for (const std::size_t k : stated_->row(c.row)) {
      const std::size_t i = stated_->w_columns()[k];
      acceleration += e.w[k] * now.a[i];
      terms += std::abs(e.w[k] * now.a[i]) + std::abs(e.w[k] * e.force[i] / stated_->masses()[i]);
    }
    // Beside springs whose force is lost in round-off it is not known; nor, where all terms are 0, what
    // positions make of it that are known to the tolerance.
    const double none = accuracy_.of_positions() * scales_.speed() / scales_.time * c.gradient;
    if (!(c.sign * acceleration < -accuracy_.of_accelerations() * terms - none)) continue;
    throw StepFailure{
        stated_->row_label(c.row) +
            " touches and would be penetrated: no forces of contact and friction were found that "
            "hold what rests there, or let it part; state fewer contacts, or make them compliant",
        now.time};
  }
}

/// Uses the current g_.
void Contacts::open(Contact& contact, double t, double rate) const {
  contact.closed = contact.parted = false;
  contact.opened_at = t;
  contact.rate_at_opening = rate;
  contact.gap_at_opening = std::min(contact.sign * g_[contact.row], 0.0);
}

void Contacts::close(Contact& contact, double t) {
  if (!contact.closed) contact.closed_at = t;
  contact.closed = true;
}

void Contacts::open(std::size_t contact, double t, double rate, Change& change) {
  Contact& c = contacts_[contact];
  if (c.closed) change.events.push_back({c.number, t, EventKind::opened});
  open(c, t, rate);
}

std::vector<std::size_t> Contacts::replace_system(std::shared_ptr<const System> stated, const Instant& at) {
  stated_ = std::move(stated);
  system_.reset();
  find_gaps(at);
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    const dalembert::Contact& law = *stated_->layout()->constraints[c.number].condition.contact;
    c.restitution = law.restitution;
    c.sign = law.sign();
    const double gap = c.sign * g_[c.row], allowed = start_tolerance * scales_.length * c.gradient;
    if (gap < -allowed) refuse({i}, at.t, "a change of the scene leaves it violated");
    c.moved = c.closed && std::abs(psi_[c.row]) > accuracy_.of_velocities() * scales_.speed() * c.gradient;
    if (gap <= allowed) {
      if (!c.closed) touching.push_back(i);
    } else if (c.closed) {
      c.closed = c.moved = false;
      c.opened_at.reset();
    }
  }
  rebuild_system();
  everywhere_ = true;
  return touching;
}

std::vector<std::size_t> Contacts::open() const {
  std::vector<std::size_t> open;
  for (const Contact& c : contacts_)
    if (!c.closed) open.push_back(c.number);
  return open;
}

void Contacts::rebuild_system() {
  forget_instant();
  const auto as_stated = [this](const Contact& c) { return system_->in_force(c.row) == c.closed; };
  if (!system_ || !std::ranges::all_of(contacts_, as_stated))
    system_ = std::make_shared<const System>(stated_->without(open()));
}

}  // namespace dalembert
