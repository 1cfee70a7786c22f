#include "dalembert/solvers/contact/contacts.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/complementarity.h>
#include <dalembert/solvers/contact/coupling.h>
#include <dalembert/solvers/linear/dense.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/start.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Rates and forces below this part of the largest beside them are what solving (1) and (2) leaves of 0.
constexpr double round_off = 1e4 * std::numeric_limits<double>::epsilon();

/// x without what is round-off beside the largest, each in its own unit.
void clear_round_off(VectorXd& x, const VectorXd& unit, double largest) {
  for (Index i = 0; i < x.size(); ++i)
    if (std::abs(x[i]) * unit[i] <= round_off * largest) x[i] = 0.0;
}

bool among(const std::vector<std::size_t>& all, std::size_t i) {
  return std::ranges::find(all, i) != all.end();
}

/// The unit in which a rate of each contact is comparable with those of others.
VectorXd units(const Eigen::MatrixXd& S) {
  return S.diagonal().unaryExpr([](double s) { return s > 0.0 ? 1.0 / std::sqrt(s) : 0.0; });
}

}  // namespace

Contacts::Contacts(std::shared_ptr<const System> stated, const Scales& scales, double tolerance,
                   const Instant& start)
    : stated_(std::move(stated)),
      scales_(scales),
      tolerance_(tolerance),
      g_(stated_->rows()),
      psi_(stated_->rows()) {
  for (const std::size_t number : stated_->contacts()) {
    const Layout::Constraint& its = stated_->layout()->constraints[number];
    contacts_.push_back({.number = number,
                         .row = static_cast<std::size_t>(its.first_row),
                         .sign = its.contact->sign(),
                         .restitution = its.contact->restitution});
  }
  find_gaps(start);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    const double gap = c.sign * g_[c.row], gradient = gradient_of(c, start);
    const double allowed = rounding_of_the_user * scales_.length * gradient;
    if (std::abs(gap) <= allowed) touching_at_start_.push_back(i);
    c.gradient = gradient;
    c.zero = gradient * scales_.rounding(start.q);
    if (gap >= -allowed) continue;
    std::ostringstream what;
    what << stated_->row_label(c.row) << " is violated by the initial positions: distance " << -gap / gradient
         << " on the side that it does not allow, at t = " << start.t << "; correct the positions";
    throw InconsistentStart(what.str());
  }
  settle();
}

void Contacts::find_gaps(const Instant& at) const {
  stated_->gaps(at, g_, psi_);
  gaps_at_ = at.t;
}

/// The length of a contact's gradient; 0 where it has none, as a string of length 0.
double Contacts::gradient_of(const Contact& contact, const Instant& at) const {
  std::vector<std::size_t> others;
  for (const Contact& c : contacts_)
    if (c.number != contact.number) others.push_back(c.number);
  const System alone = stated_->without(others);
  auto e = alone.evaluation();
  try {
    alone.evaluate(at, e);
  } catch (const EquationFault&) {
    return 0.0;
  }
  return gradient_length(alone, e.w, scales_.lengths(), contact.row);
}

double Contacts::watched(std::size_t contact, const FlatSample& now) const {
  const Contact& c = contacts_[contact];
  if (c.closed) return c.sign * now.lambda[c.row];
  if (now.time == c.opened_at) return c.rate_at_opening;
  if (gaps_at_ != now.time) find_gaps({now.time, now.q, now.v});
  const double gap = c.sign * g_[c.row], rate = c.sign * psi_[c.row];
  if (rate > 0.0 && gap <= c.zero && gap >= c.gap_at_opening - c.zero) return rate;
  const double since = c.opened_at ? now.time - *c.opened_at : 1.0;
  return std::abs(gap) <= c.zero ? 0.0 : gap / since;
}

/// What is closed, what has fallen to its surface, and what reaches its own before times can tell the two
/// apart.
std::vector<std::size_t> Contacts::touching(const Instant& at, const std::vector<std::size_t>& fallen) const {
  const double same_time = tolerance_ * scales_.time;
  std::vector<std::size_t> touching;
  find_gaps(at);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    const double gap = c.sign * g_[c.row], rate = c.sign * psi_[c.row];
    if (c.closed || among(fallen, i) || (rate < 0.0 && gap + rate * same_time <= c.zero))
      touching.push_back(i);
  }
  return touching;
}

std::vector<std::size_t> Contacts::numbers(const std::vector<std::size_t>& chosen) const {
  std::vector<std::size_t> numbers;
  for (const std::size_t i : chosen) numbers.push_back(contacts_[i].number);
  return numbers;
}

std::shared_ptr<const System> Contacts::only(const std::vector<std::size_t>& in_force) const {
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (std::ranges::find(in_force, i) == in_force.end()) others.push_back(contacts_[i].number);
  return std::make_shared<const System>(stated_->without(others));
}

void Contacts::refuse(const std::vector<std::size_t>& contacts, double t, const char* what) const {
  std::string names;
  for (const std::size_t i : contacts)
    names += (names.empty() ? "" : ", ") + stated_->row_label(contacts_[i].row);
  throw StepFailure{names + ": " + what, t};
}

/// (1). U becomes that after the impact.
void Contacts::strike(const Coupling& coupling, const std::vector<std::size_t>& touching, double t,
                      VectorXd& U, Change& change) const {
  const VectorXd before = U;
  VectorXd q = U;
  for (Index i = 0; i < U.size(); ++i)
    q[i] *= 1.0 + contacts_[touching[static_cast<std::size_t>(i)]].restitution;
  const auto P = complementary_solution(coupling.S(), q);
  if (!P)
    refuse(touching, t, "no impulses end their approach; the constraints drive them against each other");
  U += coupling.S() * *P;
  const VectorXd unit = units(coupling.S());
  clear_round_off(U, unit, before.cwiseProduct(unit).cwiseAbs().maxCoeff());
  for (Index i = 0; i < U.size(); ++i)
    if ((*P)[i] > 0.0) U[i] = before[i] - q[i];  // -e U-
  coupling.strike(*P, change.v, change.impulses);
  for (Index i = 0; i < U.size(); ++i)
    if ((*P)[i] > 0.0) change.what.push_back({touching[static_cast<std::size_t>(i)], Happened::struck, t});
}

/// Notes what was struck; where impacts accumulate, when they end.
std::optional<double> Contacts::limit_of_impacts(const Change& change, const Instant& at) {
  const double t = at.t;
  find_gaps(at);
  std::optional<double> limit;
  for (const Happening& happening : change.what) {
    Contact& c = contacts_[happening.contact];
    Accumulation& impacts = c.impacts;
    impacts.add(t);
    if (std::abs(psi_[c.row]) * impacts.left() <= tolerance_ * scales_.length * c.gradient)
      limit = std::max(limit.value_or(t), impacts.limit());
  }
  return limit;
}

/// Takes all rates to 0.
void Contacts::rest(const Coupling& coupling, const std::vector<std::size_t>& resting, double limit,
                    Change& change) {
  const VectorXd P = dense::least_squares(coupling.S(), -coupling.rates(change.v), rank_threshold);
  coupling.strike(P, change.v, change.impulses);
  for (const std::size_t i : resting) change.what.push_back({i, Happened::rested, limit});
}

/// What counts as no rate, of the velocities at the start and of what impacts at one time leave of them.
double Contacts::still(const Contact& contact) const {
  return rounding_of_the_user * scales_.speed() * contact.gradient;
}

Contacts::Change Contacts::begin(const Instant& start) {
  std::vector<std::size_t> stay;
  find_gaps(start);
  for (const std::size_t i : touching_at_start_) {
    Contact& c = contacts_[i];
    const double rate = c.sign * psi_[c.row];
    if (rate <= still(c)) {
      stay.push_back(i);
    } else {
      c.opened_at = start.t;
      c.rate_at_opening = rate;
      c.gap_at_opening = std::min(c.sign * g_[c.row], 0.0);
    }
  }
  return pass(start, stay);
}

/// Rates of what is open at its surface since this very time, after what others have done to it.
void Contacts::find_driven(const Instant& at) {
  find_gaps(at);
  for (Contact& c : contacts_) {
    if (c.closed || c.opened_at != at.t) continue;
    const double rate = c.sign * psi_[c.row];
    c.rate_at_opening = std::abs(rate) <= still(c) ? 0.0 : rate;
  }
}

std::optional<std::size_t> Contacts::driven() const {
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (!contacts_[i].closed && contacts_[i].rate_at_opening < 0.0) return i;
  return std::nullopt;
}

Contacts::Change Contacts::pass(const Instant& at, const std::vector<std::size_t>& fallen) {
  const auto unchanged = [&] {
    const std::vector<double> v(at.v.begin(), at.v.end());
    return Change{v, v, std::vector<double>(stated_->rows())};
  };
  Change change = unchanged();
  const bool known_roughly = !begun_ || driven();
  begun_ = true;
  auto touched = touching(at, fallen);
  if (touched.empty()) return change;
  std::optional<Coupling> coupling(std::in_place, only(touched), numbers(touched), at);
  VectorXd U = coupling->rates(at.v);
  for (std::size_t k = 0; k < touched.size(); ++k) {
    const Contact& c = contacts_[touched[k]];
    double& rate = U[static_cast<Index>(k)];
    if (c.closed || (known_roughly && std::abs(rate) <= still(c))) rate = 0.0;
  }
  if (U.minCoeff() < 0.0) {
    strike(*coupling, touched, at.t, U, change);
    if (const auto limit = limit_of_impacts(change, at)) {
      const double shortest = contacts_[change.what.front().contact].impacts.interval();
      for (std::size_t i = 0; i < contacts_.size(); ++i)
        if (contacts_[i].impacts.last() >= at.t - shortest && !among(touched, i)) touched.push_back(i);
      change = unchanged();
      coupling.emplace(only(touched), numbers(touched), at);
      rest(*coupling, touched, *limit, change);
      U.setZero(static_cast<Index>(touched.size()));
    }
  }
  accelerate(*coupling, touched, fallen, U, at, change);
  find_driven({at.t, at.q, change.v});
  settle();
  return change;
}

/// (2), for the velocities that the change has come to; closes and opens.
void Contacts::accelerate(Coupling& coupling, const std::vector<std::size_t>& touched,
                          const std::vector<std::size_t>& fallen, const VectorXd& U, const Instant& at,
                          Change& change) {
  std::vector<Index> resting;
  for (Index k = 0; k < U.size(); ++k) {
    if (U[k] > 0.0) {
      open(touched[static_cast<std::size_t>(k)], at.t, U[k], change);
    } else {
      resting.push_back(k);
    }
  }
  const VectorXd free = coupling.accelerations_without({at.t, at.q, change.v})(resting);
  const Eigen::MatrixXd S = coupling.S()(resting, resting);
  const auto lambda = complementary_solution(S, free);
  if (!lambda)
    refuse(touched, at.t,
           "no accelerations agree with all of them: other constraints drive them into each other");
  const VectorXd unit = units(S);
  const double largest = free.size() > 0 ? free.cwiseProduct(unit).cwiseAbs().maxCoeff() : 0.0;
  VectorXd A = free + S * *lambda;
  clear_round_off(A, unit, largest);
  for (std::size_t k = 0; k < resting.size(); ++k) {
    const std::size_t i = touched[static_cast<std::size_t>(resting[k])];
    const auto row = static_cast<Index>(k);
    // A force that has fallen to 0 falls on: what it held opens, though at this instant nothing drives it.
    const double own = scales_.speed() / scales_.time * contacts_[i].gradient * unit[row];
    const bool falls = among(fallen, i) && contacts_[i].closed &&
                       (*lambda)[row] <= tolerance_ * std::max(largest, own) * unit[row];
    if ((A[row] > 0.0 && (*lambda)[row] == 0.0) || falls) {
      open(i, at.t, 0.0, change);
    } else {
      contacts_[i].closed = true;
      contacts_[i].bears = (*lambda)[row] > 0.0;
    }
  }
}

bool Contacts::open_pulling(const FlatSample& now) {
  double largest = 0.0;
  for (const double lambda : now.lambda) largest = std::max(largest, std::abs(lambda));
  const auto pulls = [&](const Contact& c) {
    return c.closed && !now.unique[c.row] && c.sign * now.lambda[c.row] < -round_off * largest;
  };
  if (std::ranges::none_of(contacts_, pulls)) return false;
  bool found = false;
  for (Contact& c : contacts_) {
    if (!c.closed || c.bears) continue;
    c.closed = false;
    c.opened_at = now.time;
    c.rate_at_opening = 0.0;
    found = true;
  }
  settle();
  return found;
}

void Contacts::require_open(const FlatSample& now) const {
  find_gaps({now.time, now.q, now.v});
  for (const Contact& c : contacts_) {
    if (c.closed || -c.sign * g_[c.row] <= tolerance_ * scales_.length * c.gradient) continue;
    throw StepFailure{
        stated_->row_label(c.row) + " was run through: at none of the times looked at was it closed",
        now.time};
  }
}

void Contacts::open(std::size_t number, double t, double rate, Change& change) {
  Contact& contact = contacts_[number];
  if (contact.closed) change.what.push_back({number, Happened::opened, t});
  contact.closed = false;
  contact.opened_at = t;
  contact.rate_at_opening = rate;
  contact.gap_at_opening = std::min(contact.sign * g_[contact.row], 0.0);
}

void Contacts::settle() {
  std::vector<std::size_t> closed;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].closed) closed.push_back(i);
  if (system_ && closed == in_force_) return;
  system_ = only(closed);
  in_force_ = std::move(closed);
}

}  // namespace dalembert
