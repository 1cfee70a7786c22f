#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/contact/contacts.h>
#include <dalembert/solvers/contact/coupling.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/complementarity.h>
#include <dalembert/solvers/manifold/start.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

/// Contacts at an instant at which they change: impacts, and what is closed after them.
namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Sets to 0 what is round-off of the largest, each in its own unit.
void clear_round_off(VectorXd& x, const VectorXd& unit, double largest) {
  for (Index i = 0; i < x.size(); ++i)
    if (unit[i] > 0.0 && std::abs(x[i]) * unit[i] <= round_off() * largest) x[i] = 0.0;
}

/// The units that make rates of different contacts comparable.
VectorXd units(const Eigen::MatrixXd& S) {
  return S.diagonal().unaryExpr([](double s) { return s > 0.0 ? 1.0 / std::sqrt(s) : 0.0; });
}

/// Of the contacts that touch, those at these places.
std::vector<std::size_t> those_at(const Coupling::Places& places, const std::vector<std::size_t>& touching) {
  std::vector<std::size_t> its;
  for (const Index k : places) its.push_back(touching[static_cast<std::size_t>(k)]);
  return its;
}

}  // namespace

/// S of contacts of one island. Gradients are known to the rounding of positions over the scene's length:
/// what couples two contacts by no more is none.
Eigen::MatrixXd Contacts::coupled(const Coupling& coupling, const std::vector<Eigen::Index>& places,
                                  std::span<const double> q) const {
  Eigen::MatrixXd S = coupling.S(places);
  const double directions = std::max(1.0, scales_.rounding(q) / (epsilon * scales_.length));
  const VectorXd unit = units(S);
  for (Index i = 0; i < S.rows(); ++i)
    for (Index j = 0; j < S.cols(); ++j)
      if (i != j && std::abs(S(i, j)) * unit[i] * unit[j] <= round_off() * directions) S(i, j) = 0.0;
  return S;
}

/// Solves (1), of each island. U becomes U+.
void Contacts::solve_impact(const Coupling& coupling, const std::vector<std::size_t>& touching,
                            const Instant& at, VectorXd& U, Change& change) const {
  VectorXd P = VectorXd::Zero(U.size());
  for (const auto& island : coupling.islands()) {
    const VectorXd before = U(island);
    if (before.minCoeff() >= 0.0) continue;
    const auto its = those_at(island, touching);
    VectorXd q = before;
    for (Index i = 0; i < q.size(); ++i)
      q[i] *= 1.0 + contacts_[its[static_cast<std::size_t>(i)]].restitution;
    const Eigen::MatrixXd S = coupled(coupling, island, at.q);
    const auto p = complementary_solution(S, q);
    if (!p)
      refuse(its, at.t, "no impulses end their approach; the constraints drive them against each other");
    VectorXd after = before + S * *p;
    const VectorXd unit = units(S);
    const double largest = before.cwiseProduct(unit).cwiseAbs().maxCoeff();
    clear_round_off(after, unit, largest);
    for (Index i = 0; i < after.size(); ++i) {
      // Of contacts that share an impact each is struck that leaves with -e U-, whatever its share is.
      const double rebound = before[i] - q[i];
      const bool shares = before[i] < 0.0 && std::abs(after[i] - rebound) * unit[i] <= round_off() * largest;
      if (!((*p)[i] > 0.0) && !shares) continue;
      after[i] = rebound;
      change.events.push_back({contacts_[its[static_cast<std::size_t>(i)]].number, at.t, EventKind::struck});
    }
    U(island) = after;
    P(island) = *p;
  }
  std::ranges::sort(change.events, {}, &EventRecord::source);
  coupling.apply_impulses(P, change.v, change.impulses);
}

/// Whether what bounces has no way left. What loses nothing always has: between walls that close in, its
/// impacts come faster, and end in no rest.
bool Contacts::hops_end(const Contact& contact) const {
  return contact.restitution < 1.0 &&
         std::abs(psi_[contact.row]) * contact.impacts.left() <= error_of_gap(contact);
}

/// Of contacts keeps the first `own` ones and those that an impulse at these reaches, through others or not:
/// beside a floor on which hops end, a wall across it goes on being struck.
void Contacts::drop_uncoupled(const Coupling& coupling, std::size_t own, std::vector<std::size_t>& touched,
                              std::span<const double> q) const {
  Coupling::Places all;
  for (std::size_t k = 0; k < touched.size(); ++k) all.push_back(static_cast<Index>(k));
  const Eigen::MatrixXd S = coupled(coupling, all, q);
  std::vector<char> reached(touched.size(), 0);
  std::fill_n(reached.begin(), own, char{1});
  for (bool more = true; std::exchange(more, false);)
    for (const Index k : all)
      for (const Index j : all)
        if (reached[static_cast<std::size_t>(j)] && !reached[static_cast<std::size_t>(k)] && S(k, j) != 0.0)
          reached[static_cast<std::size_t>(k)] = more = true;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < touched.size(); ++k)
    if (reached[k]) kept.push_back(touched[k]);
  touched = std::move(kept);
}

/// Notes the impacts; the islands where they accumulate, and when they end there: where all that was struck
/// has no way left. What has no restitution has none at once, beside others that still bounce.
std::vector<Contacts::Limit> Contacts::limits_of_impacts(const Change& change, const Instant& at) {
  const double t = at.t;
  find_gaps(at);
  std::vector<Limit> limits;
  std::set<std::size_t> bouncing;
  for (const EventRecord& impact : change.events) {
    Contact& c = contact_of(impact);
    Accumulation& impacts = c.impacts;
    impacts.add(t);
    const double rate = std::abs(psi_[c.row]);
    const bool ends = (c.closed && !c.moved) || rate <= still(c) || hops_end(c);
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

/// Brings all rates in these islands to 0, after the impacts there.
void Contacts::rest(const Coupling& coupling, const std::vector<std::size_t>& touching,
                    const std::vector<Limit>& limits, VectorXd& U, Change& change) {
  const auto limit_of = [&](const Contact& contact) {
    return std::ranges::find(limits, contact.island, &Limit::island);
  };
  std::erase_if(change.events,
                [&](const EventRecord& one) { return limit_of(contact_of(one)) != limits.end(); });
  const VectorXd rates = coupling.rates(change.v);
  VectorXd P = VectorXd::Zero(U.size());
  for (const auto& island : coupling.islands()) {
    const auto its = those_at(island, touching);
    const auto limit = limit_of(contacts_[its.front()]);
    if (limit == limits.end()) continue;
    P(island) = dense::least_squares(coupling.S(island), -rates(island), rank_threshold);
    U(island).setZero();
    for (const std::size_t i : its)
      if (contacts_[i].impacts.last() >= limit->since)
        change.events.push_back({contacts_[i].number, limit->time, EventKind::rested, limit->uncertain});
  }
  std::ranges::sort(change.events, {}, &EventRecord::source);
  coupling.apply_impulses(P, change.v, change.impulses);
}

/// Of its gap, where the scene's speeds change in the scene's time.
double Contacts::own_acceleration(const Contact& contact) const {
  return scales_.speed() / scales_.time * contact.gradient;
}

/// Of what an impact has left so slowly that it has not parted from the surface again: by no more than this
/// hop is it not known when.
void Contacts::come_to_rest(Contact& contact, double t, Change& change) {
  const double hop = t - contact.impacts.last();
  contact.impacts.add(t);
  const double limit = contact.impacts.limit();
  change.events.push_back({contact.number, std::isfinite(limit) ? limit : t, EventKind::rested, hop});
}

/// Rates that count as 0, of velocities at the start and after impacts at one time.
double Contacts::still(const Contact& contact) const {
  return start_tolerance * scales_.speed() * contact.gradient;
}

Change Contacts::resolve_start(const Instant& start) {
  std::vector<std::size_t> stay;
  find_gaps(start);
  for (const std::size_t i : touching_at_start_) {
    Contact& c = contacts_[i];
    const double rate = c.sign * psi_[c.row];
    if (rate <= still(c)) {
      stay.push_back(i);
    } else {
      open(c, start.t, rate);
    }
  }
  return resolve(start, stay);
}

/// Updates the rates of contacts that opened at this very time, after the impacts of others.
void Contacts::update_rates(const Instant& at) {
  find_gaps(at);
  for (Contact& c : contacts_) {
    if (c.closed || c.opened_at != at.t) continue;
    const double rate = c.sign * psi_[c.row];
    c.rate_at_opening = rate >= -still(c) && rate <= no_rate(c) ? 0.0 : rate;
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
    const Contact& c = contacts_[i];
    const bool slow = std::abs(psi_[c.row]) <= still(c) && c.sign * g_[c.row] <= no_gap(c, at.q);
    if (!c.closed && slow && !among(touched, i)) touched.push_back(i);
  }
  return touched.size() > before;
}

Change Contacts::resolve(const Instant& at, const std::vector<std::size_t>& triggered) {
  const std::vector<double> v(at.v.begin(), at.v.end());
  Change change{.v_before = v, .v = v, .impulses = std::vector<double>(stated_->rows())};
  const bool known_roughly = !started_ || approaching();
  started_ = true;
  auto touched = touching(at, triggered);
  if (touched.empty()) return change;
  std::optional<Coupling> coupling(std::in_place, only(touched), numbers(touched), at);
  VectorXd U = coupling->rates(at.v);
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const Contact& c = contacts_[touched[k]];
    double& rate = U[static_cast<Index>(k)];
    // What has not left the surface, within the error of a step, and no longer leaves it, rests.
    const bool returns = among(triggered, touched[k]) && !c.parted && c.opened_at != at.t &&
                         std::abs(rate) <= accuracy_.of_velocities() * scales_.speed() * c.gradient;
    const bool slow = known_roughly && std::abs(rate) <= still(c);
    if ((c.closed && !c.moved) || returns || slow || std::abs(rate) <= no_rate(c)) rate = 0.0;
    if (returns && c.impacts.last() == c.opened_at) come_to_rest(contacts_[touched[k]], at.t, change);
  }
  if (U.minCoeff() < 0.0) {
    solve_impact(*coupling, touched, at, U, change);
    if (const auto limits = limits_of_impacts(change, at); !limits.empty()) {
      const std::size_t own = touched.size();
      for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const auto limit = std::ranges::find(limits, contacts_[i].island, &Limit::island);
        if (limit != limits.end() && contacts_[i].impacts.last() >= limit->since && !among(touched, i))
          touched.push_back(i);
      }
      const Instant struck{at.t, at.q, change.v};
      coupling.emplace(only(touched), numbers(touched), struck);
      if (touched.size() > own) {
        drop_uncoupled(*coupling, own, touched, at.q);
        coupling.emplace(only(touched), numbers(touched), struck);
      }
      U.conservativeResize(static_cast<Index>(touched.size()));
      rest(*coupling, touched, limits, U, change);
    }
  }
  for (Contact& c : contacts_) c.moved = false;
  everywhere_ = false;
  const Instant after{at.t, at.q, change.v};
  if (known_roughly && add_slow(after, touched)) {
    coupling.emplace(only(touched), numbers(touched), after);
    U = coupling->rates(after.v);
    for (std::size_t k = 0; k < touched.size(); ++k) {
      double& rate = U[static_cast<Index>(k)];
      if (std::abs(rate) <= still(contacts_[touched[k]])) rate = 0.0;
    }
  }
  const auto resting = open_separating(touched, U, at.t, change);
  if (friction_) {
    (void)accelerations_without(*coupling, touched, after);  // what pulls may do so by an error of positions
    close(touched, triggered, resting, at.t, change);
  } else {
    accelerate(*coupling, touched, triggered, resting, at, change);
  }
  update_rates(after);
  rebuild_system();
  return change;
}

/// What touches and does not separate is closed, what has fallen open.
void Contacts::close(const std::vector<std::size_t>& touched, const std::vector<std::size_t>& triggered,
                     const std::vector<Index>& resting, double t, Change& change) {
  for (const Index k : resting) {
    const std::size_t i = touched[static_cast<std::size_t>(k)];
    if (among(triggered, i) && contacts_[i].closed) {
      open(i, t, 0.0, change);
    } else {
      close(contacts_[i], t);
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
  Coupling coupling(only(closed), numbers(closed), at);
  const VectorXd free = coupling.accelerations_without(at);
  for (std::size_t k = 0; k < closed.size(); ++k) {
    const auto place = static_cast<Index>(k);
    if (coupling.is_held(place) && free[place] > round_off() * own_acceleration(contacts_[closed[k]]))
      return closed[k];
  }
  return std::nullopt;
}

/// Those that close nothing. What neither leaves nor is pressed, to round-off, has none; nor has what leaves
/// no faster than accelerations are known, or for no longer than times are, and is pressed soon: an error of
/// its positions is what parts it.
VectorXd Contacts::accelerations_without(Coupling& coupling, const std::vector<std::size_t>& touched,
                                         const Instant& at) {
  for (const std::size_t i : touched) contacts_[i].accepted = 0.0;
  VectorXd free = coupling.accelerations_without(at);
  std::vector<Index> leaving;
  for (Index k = 0; k < free.size(); ++k) {
    Contact& c = contacts_[touched[static_cast<std::size_t>(k)]];
    const double none = round_off() * own_acceleration(c);
    if (std::abs(free[k]) <= none) {
      free[k] = 0.0;
      c.accepted = none;
    }
    if (free[k] > 0.0) leaving.push_back(k);
  }
  if (leaving.empty()) return free;
  const double soon = accuracy_.short_time() * scales_.time;
  const double known_to = constants.most_correction * accuracy_.of_times() * scales_.time;
  std::vector<double> q(at.q.begin(), at.q.end());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += soon * at.v[i];
  const VectorXd then = coupling.accelerations_without({at.t + soon, q, at.v});
  (void)coupling.accelerations_without(at);  // it goes on from there
  for (const Index k : leaving) {
    Contact& c = contacts_[touched[static_cast<std::size_t>(k)]];
    if (!(then[k] < 0.0)) continue;
    const double until = soon * free[k] / (free[k] - then[k]);
    if (until <= known_to || free[k] <= accuracy_.of_positions() * own_acceleration(c))
      c.accepted = std::exchange(free[k], 0.0);
  }
  return free;
}

/// Solves (2) for the velocities after the change, of each island; closes and opens.
void Contacts::accelerate(Coupling& coupling, const std::vector<std::size_t>& touched,
                          const std::vector<std::size_t>& triggered, const std::vector<Index>& resting,
                          const Instant& at, Change& change) {
  const VectorXd all = accelerations_without(coupling, touched, {at.t, at.q, change.v});
  std::vector<Pair> pairs(touched.size());
  for (const auto& island : coupling.islands()) {
    Coupling::Places own;
    std::ranges::set_intersection(island, resting, std::back_inserter(own));
    const VectorXd free = all(own);
    const Eigen::MatrixXd S = coupled(coupling, own, at.q);
    const auto lambda = complementary_solution(S, free);
    if (!lambda)
      refuse(those_at(island, touched), at.t,
             "no accelerations satisfy all of them: other constraints drive them into each other");
    const VectorXd unit = units(S);
    const double largest = free.size() > 0 ? free.cwiseProduct(unit).cwiseAbs().maxCoeff() : 0.0;
    VectorXd A = free + S * *lambda;
    clear_round_off(A, unit, largest);
    for (Index k = 0; k < A.size(); ++k)
      pairs[static_cast<std::size_t>(own[static_cast<std::size_t>(k)])] = {A[k], (*lambda)[k], unit[k],
                                                                           largest};
  }
  for (const Index k : resting) {
    const auto place = static_cast<std::size_t>(k);
    open_or_close(touched[place], triggered, pairs[place], at.t, change);
  }
}

/// By the acceleration and the force of (2).
void Contacts::open_or_close(std::size_t i, const std::vector<std::size_t>& triggered, const Pair& pair,
                             double t, Change& change) {
  // A force that has fallen to 0 goes on falling: the contact opens, though nothing separates it yet. So does
  // one that has fallen at this very time, before another: it stays open.
  const Contact& c = contacts_[i];
  const double own = own_acceleration(c) * pair.unit;
  const bool fallen = c.closed ? among(triggered, i) : c.opened_at == t && c.rate_at_opening == 0.0;
  const bool falls =
      fallen && pair.force <= accuracy_.of_positions() * std::max(pair.largest, own) * pair.unit;
  if ((pair.acceleration > 0.0 && pair.force == 0.0) || falls) {
    open(i, t, 0.0, change);
  } else {
    close(contacts_[i], t);
    contacts_[i].bears = pair.force > 0.0;
  }
}

}  // namespace dalembert
