#include "dalembert/solvers/contact/contact_impacts.h"

#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/contact/contact_law.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/complementarity.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace dalembert {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Where contacts share an impact of which some have no part, adds to the impulses what the rates of all of
/// them still miss, in units of S, if that is round-off. The rates of those without a part are right to the
/// rounding of pivots only: a turn that is left of what falls flat adds up over its hops.
void refine(const Eigen::MatrixXd& S, const Coupling::Places& struck, const VectorXd& missed, double largest,
            VectorXd& P) {
  if (struck.empty() || P(struck).minCoeff() > 0.0) return;
  const VectorXd unit = units(S)(struck);
  const Eigen::MatrixXd scaled = unit.asDiagonal() * S(struck, struck) * unit.asDiagonal();
  const VectorXd more = dense::least_squares(scaled, -unit.cwiseProduct(missed(struck)), rank_threshold);
  if (more.cwiseAbs().maxCoeff() <= round_off() * largest) P(struck) += unit.cwiseProduct(more);
}

}  // namespace

void ContactImpacts::solve(const Coupling& coupling, const std::vector<std::size_t>& touching, VectorXd& U,
                           Change& change) const {
  VectorXd P = VectorXd::Zero(U.size());
  for (const auto& island : coupling.islands()) {
    const VectorXd before = U(island);
    const auto its = those_at(island, touching);
    const auto contact = [&](Index i) -> const ContactState& {
      return (*contacts_)[its[static_cast<std::size_t>(i)]];
    };
    VectorXd rebound(before.size());
    for (Index i = 0; i < rebound.size(); ++i)
      rebound[i] = -contact(i).restitution * contact(i).arrives.value_or(before[i]);
    const VectorXd q = before - rebound;
    if (q.minCoeff() >= 0.0) continue;
    const Eigen::MatrixXd S = coupled(coupling, island, known_->scales, rounding_);
    auto p = complementary_solution(S, q);
    if (!p)
      refuse(*stated_, *contacts_, its, at_.t,
             "no impulses end their approach; the constraints drive them against each other");
    VectorXd after = before + S * *p;
    const VectorXd unit = units(S), missed = q + S * *p;
    const double largest = before.cwiseAbs().cwiseMax(rebound.cwiseAbs()).cwiseProduct(unit).maxCoeff();
    clear_round_off(after, unit, largest);
    Coupling::Places struck;
    for (Index i = 0; i < after.size(); ++i) {
      // Of contacts that share an impact each is struck that leaves with -e U-, whatever its share is.
      const bool shares = q[i] < 0.0 && std::abs(after[i] - rebound[i]) * unit[i] <= round_off() * largest;
      if (!((*p)[i] > 0.0) && !shares) continue;
      after[i] = rebound[i];
      struck.push_back(i);
      change.events.push_back({contact(i).number, at_.t, EventKind::struck});
    }
    refine(S, struck, missed, largest, *p);
    U(island) = after;
    P(island) = *p;
  }
  std::ranges::sort(change.events, {}, &EventRecord::source);
  coupling.apply_impulses(P, change.v, change.impulses);
}

/// Whether what bounces has no way left. What loses nothing always has: between walls that close in, its
/// impacts come faster, and end in no rest.
bool ContactImpacts::hops_end(const ContactState& contact, double speed) const {
  return contact.restitution < 1.0 &&
         (speed <= known_->still(contact) || speed * contact.impacts.left() <= known_->error_of_gap(contact));
}

ContactState& ContactImpacts::contact_of(const EventRecord& event) const {
  return *std::ranges::lower_bound(*contacts_, event.source, {}, &ContactState::number);
}

/// Of the time of this impact: what the fastest of all that share it tells.
double ContactImpacts::error_of_time(const Change& change, std::size_t island, const Gaps& gaps) const {
  double error = std::numeric_limits<double>::infinity();
  for (const EventRecord& impact : change.events) {
    const ContactState& c = contact_of(impact);
    const double rate = gaps.rate(c);
    if (c.island != island || rate == 0.0) continue;
    error = std::min(error, known_->error_where_closed(c, gaps.rounding(), at_.t, rate) / std::abs(rate));
  }
  return error;
}

std::vector<ContactImpacts::Limit> ContactImpacts::note(const Change& change, const Gaps& gaps) {
  const double t = at_.t;
  std::vector<Limit> limits;
  std::set<std::size_t> bouncing;
  for (const EventRecord& impact : change.events) {
    ContactState& c = contact_of(impact);
    Accumulation& impacts = c.impacts;
    if (c.closed && (c.moved || c.arrives)) impacts = {};  // its rest has ended
    impacts.add(t, error_of_time(change, c.island, gaps));
    const double speed = std::abs(gaps.rate(c));
    const bool ends = (c.closed && !c.moved) || hops_end(c, speed);
    if (!ends) bouncing.insert(c.island);
    if (!std::isfinite(impacts.limit()) || !ends) continue;
    auto limit = std::ranges::find(limits, c.island, &Limit::island);
    if (limit == limits.end()) limit = limits.insert(limit, {c.island, t, t - impacts.interval(), 0.0});
    limit->time = std::max(limit->time, impacts.limit());
    limit->uncertain = std::max(limit->uncertain, impacts.uncertainty());
  }
  std::erase_if(limits, [&](const Limit& one) { return bouncing.contains(one.island); });
  return limits;
}

std::vector<std::size_t> ContactImpacts::struck(const std::vector<Limit>& limits) const {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < contacts_->size(); ++i) {
    const ContactState& c = (*contacts_)[i];
    const auto limit = std::ranges::find(limits, c.island, &Limit::island);
    if (limit != limits.end() && c.impacts.last() >= limit->since) all.push_back(i);
  }
  return all;
}

void ContactImpacts::rest(const Coupling& coupling, const std::vector<std::size_t>& touching,
                          const std::vector<Limit>& limits, VectorXd& U, Change& change) const {
  const auto limit_of = [&](const ContactState& contact) {
    return std::ranges::find(limits, contact.island, &Limit::island);
  };
  std::erase_if(change.events,
                [&](const EventRecord& one) { return limit_of(contact_of(one)) != limits.end(); });
  const VectorXd rates = coupling.rates(change.v);
  VectorXd P = VectorXd::Zero(U.size());
  for (const auto& island : coupling.islands()) {
    const auto its = those_at(island, touching);
    const auto limit = limit_of((*contacts_)[its.front()]);
    if (limit == limits.end()) continue;
    P(island) = dense::least_squares(coupling.S(island), -rates(island), rank_threshold);
    U(island).setZero();
    for (const std::size_t i : its)
      if ((*contacts_)[i].impacts.last() >= limit->since)
        change.events.push_back({(*contacts_)[i].number, limit->time, EventKind::rested, limit->uncertain});
  }
  std::ranges::sort(change.events, {}, &EventRecord::source);
  coupling.apply_impulses(P, change.v, change.impulses);
}

}  // namespace dalembert
