#include "dalembert/solvers/contact/contact_resolution.h"

#include <dalembert/solvers/contact/contact_impacts.h>
#include <dalembert/solvers/contact/contact_law.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

ContactResolution::ContactResolution(std::shared_ptr<const System> stated,
                                     std::vector<ContactState>& contacts, const ContactAccuracy& known,
                                     Gaps& gaps, const Instant& at, const std::vector<std::size_t>& triggered)
    : stated_(std::move(stated)),
      contacts_(&contacts),
      known_(&known),
      gaps_(&gaps),
      at_(at),
      triggered_(marks(triggered, contacts.size())),
      change_{.v_before = {at.v.begin(), at.v.end()},
              .v = {at.v.begin(), at.v.end()},
              .impulses = std::vector<double>(stated_->rows())} {}

ContactState& ContactResolution::contact(Index place) const {
  return (*contacts_)[touching_[static_cast<std::size_t>(place)]];
}

void ContactResolution::couple(const Instant& at) {
  coupling_ = coupling_of(*stated_, *contacts_, touching_, at);
}

void ContactResolution::resolve(std::vector<std::size_t> touching, bool known_roughly, bool friction) {
  touching_ = std::move(touching);
  couple(at_);
  find_rates(known_roughly);
  const Coupling::Places jerked = jerked_slowly();
  if (U_.minCoeff() < 0.0) strike();
  hold(jerked);
  for (ContactState& c : *contacts_) {
    c.moved = false;
    c.arrives.reset();
    c.unknown = 0.0;
  }
  if (known_roughly) join_slow();
  const Coupling::Places resting = open_separating();
  ContactAccelerations accelerations(*stated_, *contacts_, *known_, after());
  const VectorXd free = accelerations.without_forces(*coupling_, touching_);
  if (friction) {
    close_resting(resting);
  } else {
    const auto pairs = accelerations.pairs(*coupling_, touching_, resting, free);
    for (const Index k : resting) open_or_close(k, pairs[static_cast<std::size_t>(k)]);
  }
  update_rates();
}

void ContactResolution::find_rates(bool known_roughly) {
  U_ = coupling_->rates(at_.v);
  for (Index k = 0; k < U_.size(); ++k) {
    ContactState& c = contact(k);
    double& rate = U_[k];
    // What has not left the surface, within the error of a step, and no longer leaves it, rests.
    const bool returns =
        triggered(k) && !c.parted && c.opened_at != at_.t &&
        std::abs(rate) <= known_->accuracy.of_velocities() * known_->scales.speed() * c.gradient;
    const bool slow = known_roughly && std::abs(rate) <= known_->still(c);
    const bool rests = c.closed && !c.moved && !c.arrives;
    if (rests || returns || slow || std::abs(rate) <= known_->no_rate(c)) rate = 0.0;
    if (returns && c.impacts.last() == c.opened_at) come_to_rest(c, at_.t, change_);
  }
}

bool ContactResolution::is_slow(Index place) const { return std::abs(U_[place]) <= contact(place).unknown; }

/// What rested, and what joints have set moving by no more than is known.
Coupling::Places ContactResolution::jerked_slowly() const {
  Coupling::Places places;
  for (Index k = 0; k < U_.size(); ++k) {
    const ContactState& c = contact(k);
    if (c.closed && !c.moved && c.arrives && is_slow(k)) places.push_back(k);
  }
  return places;
}

/// Keeps these closed where they leave so slowly, and lists no impacts of them: whether they would leave is
/// not known. What presses has taken its part of the impulse.
void ContactResolution::hold(const Coupling::Places& jerked) {
  for (const Index k : jerked) {
    std::erase_if(change_.events, [&](const EventRecord& one) { return one.source == contact(k).number; });
    if (is_slow(k)) U_[k] = 0.0;
  }
}

/// The impacts of what touches, and what comes to rest by them.
void ContactResolution::strike() {
  ContactImpacts impacts(*stated_, *contacts_, *known_, at_);
  impacts.solve(*coupling_, touching_, U_, change_);
  gaps_->find(*stated_, known_->scales, at_);
  const auto limits = impacts.note(change_, *gaps_);
  if (limits.empty()) return;
  const std::size_t own = touching_.size();
  const auto touches = marks(touching_, contacts_->size());
  for (const std::size_t i : impacts.struck(limits))
    if (!touches[i]) touching_.push_back(i);
  couple(after());
  if (touching_.size() > own) {
    keep_reached(*coupling_, own, known_->scales, known_->scales.rounding(at_.q), touching_);
    couple(after());
  }
  U_.conservativeResize(static_cast<Index>(touching_.size()));
  impacts.rest(*coupling_, touching_, limits, U_, change_);
}

/// Adds contacts left at their surface by impacts at one time, no faster than velocities are known: what
/// bounces to and fro in a slot without play would else be open on both sides. All rates are then found
/// again.
void ContactResolution::join_slow() {
  const std::size_t before = touching_.size();
  const auto touches = marks(touching_, contacts_->size());
  gaps_->find(*stated_, known_->scales, after());
  for (std::size_t i = 0; i < contacts_->size(); ++i) {
    const ContactState& c = (*contacts_)[i];
    const bool slow =
        std::abs(gaps_->rate(c)) <= known_->still(c) && gaps_->gap(c) <= known_->no_gap(c, gaps_->rounding());
    if (!c.closed && slow && !touches[i]) touching_.push_back(i);
  }
  if (touching_.size() == before) return;
  couple(after());
  U_ = coupling_->rates(change_.v);
  for (Index k = 0; k < U_.size(); ++k)
    if (std::abs(U_[k]) <= known_->still(contact(k))) U_[k] = 0.0;
}

/// Opens those that separate; returns the others.
Coupling::Places ContactResolution::open_separating() {
  Coupling::Places resting;
  for (Index k = 0; k < U_.size(); ++k) {
    if (U_[k] > 0.0) {
      open(k, U_[k]);
    } else {
      resting.push_back(k);
    }
  }
  return resting;
}

/// What touches and does not separate is closed, what has fallen open.
void ContactResolution::close_resting(const Coupling::Places& resting) {
  for (const Index k : resting) {
    if (triggered(k) && contact(k).closed) {
      open(k, 0.0);
    } else {
      contact(k).close(at_.t);
    }
  }
}

/// What rests, by its acceleration and its force, (2) of Contacts.
void ContactResolution::open_or_close(Index k, const PairOfContact& pair) {
  // A force that has fallen to 0 goes on falling: the contact opens, though nothing separates it yet. So does
  // one that has fallen at this very time, before another: it stays open.
  ContactState& c = contact(k);
  const double own = known_->own_acceleration(c) * pair.unit;
  const bool fallen = c.closed ? triggered(k) : c.opened_at == at_.t && c.rate_at_opening == 0.0;
  const bool falls =
      fallen && pair.force <= known_->accuracy.of_positions() * std::max(pair.largest, own) * pair.unit;
  if ((pair.acceleration > 0.0 && pair.force == 0.0) || falls) {
    open(k, 0.0);
  } else {
    c.close(at_.t);
    c.bears = pair.force > 0.0;
  }
}

void ContactResolution::open(Index place, double rate) {
  ContactState& c = contact(place);
  if (c.closed) change_.events.push_back({c.number, at_.t, EventKind::opened});
  c.open(at_.t, rate, gaps_->gap(c));
}

/// Of contacts that opened at this very time, after the impacts of others.
void ContactResolution::update_rates() {
  gaps_->find(*stated_, known_->scales, after());
  for (ContactState& c : *contacts_) {
    if (c.closed || c.opened_at != at_.t) continue;
    const double rate = gaps_->rate(c);
    c.rate_at_opening = rate >= -known_->still(c) && rate <= known_->no_rate(c) ? 0.0 : rate;
  }
}

}  // namespace dalembert
