#include <dalembert/solvers/contact/contact_impacts.h>
#include <dalembert/solvers/contact/contacts.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>
#include <optional>

/// Contacts at an instant at which they change: impacts, and what is closed after them.
namespace dalembert {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Of what an impact has left so slowly that it has not parted from the surface again: by no more than this
/// hop is it not known when.
void come_to_rest(ContactState& contact, double t, Change& change) {
  const double hop = t - contact.impacts.last();
  contact.impacts.add(t);
  const double limit = contact.impacts.limit();
  change.events.push_back({contact.number, std::isfinite(limit) ? limit : t, EventKind::rested, hop});
}

}  // namespace

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

/// Updates the rates of contacts that opened at this very time, after the impacts of others.
void Contacts::update_rates(const Instant& at) {
  find_gaps(at);
  for (ContactState& c : contacts_) {
    if (c.closed || c.opened_at != at.t) continue;
    const double rate = gaps_.rate(c);
    c.rate_at_opening = rate >= -known_.still(c) && rate <= known_.no_rate(c) ? 0.0 : rate;
  }
}

std::optional<std::size_t> Contacts::approaching() const {
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (!contacts_[i].closed && contacts_[i].rate_at_opening < 0.0) return i;
  return std::nullopt;
}

/// Adds contacts left at their surface by impacts at one time, no faster than velocities are known: what
/// bounces to and fro in a slot without play would else be open on both sides. Whether there was any.
bool Contacts::add_slow(const Instant& at, std::vector<std::size_t>& touched) const {
  const std::size_t before = touched.size();
  find_gaps(at);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ContactState& c = contacts_[i];
    const bool slow = std::abs(gaps_.rate(c)) <= known_.still(c) && gaps_.gap(c) <= known_.no_gap(c, at.q);
    if (!c.closed && slow && !among(touched, i)) touched.push_back(i);
  }
  return touched.size() > before;
}

/// U of what touches, 0 of what rests.
VectorXd Contacts::rates_of(const std::vector<std::size_t>& touched,
                            const std::vector<std::size_t>& triggered, const Coupling& coupling,
                            const Instant& at, bool known_roughly, Change& change) {
  VectorXd U = coupling.rates(at.v);
  for (std::size_t k = 0; k < touched.size(); ++k) {
    ContactState& c = contacts_[touched[k]];
    double& rate = U[static_cast<Index>(k)];
    // What has not left the surface, within the error of a step, and no longer leaves it, rests.
    const bool returns =
        among(triggered, touched[k]) && !c.parted && c.opened_at != at.t &&
        std::abs(rate) <= known_.accuracy.of_velocities() * known_.scales.speed() * c.gradient;
    const bool slow = known_roughly && std::abs(rate) <= known_.still(c);
    if ((c.closed && !c.moved) || returns || slow || std::abs(rate) <= known_.no_rate(c)) rate = 0.0;
    if (returns && c.impacts.last() == c.opened_at) come_to_rest(c, at.t, change);
  }
  return U;
}

/// The impacts of what touches, and what comes to rest by them.
void Contacts::strike(std::vector<std::size_t>& touched, std::unique_ptr<Coupling>& coupling,
                      const Instant& at, VectorXd& U, Change& change) {
  ContactImpacts impacts(*stated_, contacts_, known_, at);
  impacts.solve(*coupling, touched, U, change);
  find_gaps(at);
  const auto limits = impacts.note(change, gaps_);
  if (limits.empty()) return;
  const std::size_t own = touched.size();
  for (const std::size_t i : impacts.struck(limits))
    if (!among(touched, i)) touched.push_back(i);
  const Instant struck{at.t, at.q, change.v};
  coupling = couple(touched, struck);
  if (touched.size() > own) {
    impacts.keep_reached(*coupling, own, touched);
    coupling = couple(touched, struck);
  }
  U.conservativeResize(static_cast<Index>(touched.size()));
  impacts.rest(*coupling, touched, limits, U, change);
}

Change Contacts::resolve(const Instant& at, const std::vector<std::size_t>& triggered) {
  const std::vector<double> v(at.v.begin(), at.v.end());
  Change change{.v_before = v, .v = v, .impulses = std::vector<double>(stated_->rows())};
  const bool known_roughly = !started_ || approaching();
  started_ = true;
  auto touched = touching(at, triggered);
  if (touched.empty()) return change;
  auto coupling = couple(touched, at);
  VectorXd U = rates_of(touched, triggered, *coupling, at, known_roughly, change);
  if (U.minCoeff() < 0.0) strike(touched, coupling, at, U, change);
  for (ContactState& c : contacts_) c.moved = false;
  everywhere_ = false;
  const Instant after{at.t, at.q, change.v};
  if (known_roughly && add_slow(after, touched)) {
    coupling = couple(touched, after);
    U = coupling->rates(after.v);
    for (std::size_t k = 0; k < touched.size(); ++k) {
      double& rate = U[static_cast<Index>(k)];
      if (std::abs(rate) <= known_.still(contacts_[touched[k]])) rate = 0.0;
    }
  }
  const auto resting = open_separating(touched, U, at.t, change);
  const VectorXd without = accelerations_without(contacts_, known_, *coupling, touched, after);
  if (friction_) {
    close_resting(touched, triggered, resting, at.t, change);
  } else {
    const auto pairs = pairs_of(*stated_, contacts_, known_, *coupling, touched, resting, without, after);
    for (const Index k : resting) {
      const auto place = static_cast<std::size_t>(k);
      open_or_close(touched[place], triggered, pairs[place], at.t, change);
    }
  }
  update_rates(after);
  rebuild_system();
  return change;
}

/// What touches and does not separate is closed, what has fallen open.
void Contacts::close_resting(const std::vector<std::size_t>& touched,
                             const std::vector<std::size_t>& triggered, const std::vector<Index>& resting,
                             double t, Change& change) {
  for (const Index k : resting) {
    const std::size_t i = touched[static_cast<std::size_t>(k)];
    if (among(triggered, i) && contacts_[i].closed) {
      open(i, t, 0.0, change);
    } else {
      contacts_[i].close(t);
    }
  }
}

/// Opens those that separate; returns the others.
std::vector<Index> Contacts::open_separating(const std::vector<std::size_t>& touched, const VectorXd& U,
                                             double t, Change& change) {
  std::vector<Index> resting;
  for (Index k = 0; k < U.size(); ++k) {
    if (U[k] > 0.0) {
      open(touched[static_cast<std::size_t>(k)], t, U[k], change);
    } else {
      resting.push_back(k);
    }
  }
  return resting;
}

std::optional<std::size_t> Contacts::driven_apart(const Instant& at) const {
  std::vector<std::size_t> closed;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].closed) closed.push_back(i);
  if (closed.empty()) return std::nullopt;
  auto coupling = couple(closed, at);
  const VectorXd free = coupling->accelerations_without(at);
  for (std::size_t k = 0; k < closed.size(); ++k) {
    const auto place = static_cast<Index>(k);
    if (coupling->is_held(place) && free[place] > round_off() * known_.own_acceleration(contacts_[closed[k]]))
      return closed[k];
  }
  return std::nullopt;
}

/// By the acceleration and the force of (2).
void Contacts::open_or_close(std::size_t i, const std::vector<std::size_t>& triggered,
                             const PairOfContact& pair, double t, Change& change) {
  // A force that has fallen to 0 goes on falling: the contact opens, though nothing separates it yet. So does
  // one that has fallen at this very time, before another: it stays open.
  const ContactState& c = contacts_[i];
  const double own = known_.own_acceleration(c) * pair.unit;
  const bool fallen = c.closed ? among(triggered, i) : c.opened_at == t && c.rate_at_opening == 0.0;
  const bool falls =
      fallen && pair.force <= known_.accuracy.of_positions() * std::max(pair.largest, own) * pair.unit;
  if ((pair.acceleration > 0.0 && pair.force == 0.0) || falls) {
    open(i, t, 0.0, change);
  } else {
    contacts_[i].close(t);
    contacts_[i].bears = pair.force > 0.0;
  }
}

}  // namespace dalembert
