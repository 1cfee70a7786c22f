#include "dalembert/solvers/contact/friction_modes.h"

#include <dalembert/core/analysis/disjoint_sets.h>
#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/onset.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/contact/second_motion.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Modes at an instant, tried one after another, of which no two are the same.
constexpr std::size_t most_tried = 1000;
constexpr const char* shares =
    ": its share of the friction is not determined, as others constrain the same slip; state one in place "
    "of all, or end the run before";

/// Whether others constrain the same slip.
bool shared(const RoughState& rough, std::span<const char> unique) {
  if (unique.empty()) return false;
  const auto rows = unique.subspan(rough.row, rough.rows);
  return std::ranges::find(rows, char{0}) != rows.end();
}

/// Notes that it starts to slide.
void let_go(RoughState& rough) { rough.loses_share |= rough.shared && rough.mu_static != rough.mu; }

}  // namespace

void FrictionModes::require_own_shares(const System& stated, std::span<const RoughState> all, double t) {
  const auto loses = std::ranges::find_if(
      all, [](const RoughState& r) { return r.loses_share && r.mode == RoughState::Mode::slides; });
  if (loses != all.end()) throw StepFailure{stated.row_label(loses->row) + shares, t};
}

void FrictionModes::mark_shared(const Motion& motion) {
  for (RoughState& r : all_) r.shared = r.mode == RoughState::Mode::sticks && shared(r, motion.unique);
}

/// By how much the friction of what sticks exceeds its bound, as a part of that; -1 if there is none. What
/// has reached it exceeds it an instant later, as in Onset.
double FrictionModes::excess(const RoughState& rough, const Motion& motion) const {
  const double sigma = rough.part(motion.lambda).norm();
  if (rough.mode != RoughState::Mode::sticks ||
      sigma <= equations_->round_off_of(all_, rough, motion.a, motion.lambda))
    return -1.0;
  const double known = rough.reached ? std::sqrt(round_off()) : -round_off();
  const double bound = rough.mu_static * std::abs(motion.lambda[rough.pressing_row]) + rough.noise;
  return sigma / bound - 1.0 + known;
}

/// Whether all that is at rest can stay there: what others prescribe may move it.
bool FrictionModes::sticks(const Motion& motion) const {
  return std::ranges::none_of(all_, [&](const RoughState& r) {
    if (!r.at_rest) return false;
    if (r.reached || excess(r, motion) > 0.0) return true;
    return shared(r, motion.unique) && equations_->slip_acceleration(r, at_, motion).norm() > 0.0;
  });
}

/// Places among these constraints, in parts that no constraint, force or friction couples to each other.
std::vector<FrictionModes::Part> FrictionModes::parts_of(const std::vector<std::size_t>& which) const {
  const System& stated = *equations_->stated();
  const Islands islands = dalembert::islands(stated);
  const auto island = [&](std::size_t row) { return islands.of_row(stated, row); };
  DisjointSets joined(islands.count);
  for (const RoughState& r : all_) joined.join(island(r.row), island(r.pressing_row));
  std::vector<Part> parts(islands.count);
  Index first = 0;
  for (std::size_t k = 0; k < which.size(); ++k) {
    const RoughState& r = all_[which[k]];
    Part& own = parts[joined.root(island(r.row))];
    own.places.push_back(static_cast<Index>(k));
    for (std::size_t row = 0; row < r.rows; ++row) own.rows.push_back(first++);
  }
  std::erase_if(parts, [](const Part& part) { return part.places.empty(); });
  return parts;
}

/// What of all that is at rest sticks, and what slides.
void FrictionModes::decide() {
  const bool group = std::ranges::any_of(all_, [](const RoughState& r) { return r.reached && r.shared; });
  for (RoughState& r : all_) {  // what holds together reaches its bounds together
    if (r.at_rest && r.shared && group) r.reached = true;
    if (r.reached) let_go(r);
  }
  const Motion held = solve();
  mark_shared(held);
  if (sticks(held)) return;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (all_[i].at_rest) which.push_back(i);
  const SlipCoupling coupling = equations_->released(all_, which, *open_, at_);
  for (const Part& part : parts_of(which)) {
    std::vector<RoughState*> at_rest;
    for (const Index k : part.places) at_rest.push_back(&all_[which[static_cast<std::size_t>(k)]]);
    start_sliding(at_rest, coupling.part(part.places, part.rows), held);
  }
}

/// What of a part at rest cannot stick.
void FrictionModes::start_sliding(const std::vector<RoughState*>& at_rest, const SlipCoupling& coupling,
                                  const Motion& held) {
  std::vector<AtRest> rest;
  for (const RoughState* const r : at_rest)
    rest.push_back({{r->row, r->rows, r->pressing_row}, r->mu, r->mu_static, r->reached});
  const auto onset = Onset::find(coupling, rest);
  if (!onset) return;
  Index first = 0;
  for (std::size_t k = 0; k < rest.size(); first += static_cast<Index>(rest[k++].rows.rows)) {
    if (!onset->parts[k].slides) continue;
    RoughState& r = *at_rest[k];
    const bool prescribed = coupling.S_0(first, first) == 0.0;
    if (!prescribed) let_go(r);
    if (!r.one_sided) r.sign = held.lambda[r.pressing_row] < 0.0 ? -1.0 : 1.0;
    r.start_sliding(onset->parts[k].direction);
    if (r.reached) r.let_go = at_.t;
  }
}

/// What lets go with one that does: of what shares with it all that is at its bound, as what carries nothing
/// is, too.
std::vector<RoughState*> FrictionModes::going_with(RoughState& most, const Motion& motion) const {
  if (!most.shared) return {&most};
  std::vector<std::size_t> every(all_.size());
  std::iota(every.begin(), every.end(), std::size_t{0});
  const auto its = &most - all_.data();
  const auto parts = parts_of(every);
  const auto own = std::ranges::find_if(
      parts, [&](const Part& part) { return std::ranges::find(part.places, its) != part.places.end(); });
  const auto normal = [&](const RoughState& r) { return std::abs(motion.lambda[r.pressing_row]); };
  double largest = 0.0;
  std::vector<RoughState*> sharing;
  for (const Index k : own->places) {
    RoughState& r = all_[static_cast<std::size_t>(k)];
    if (!r.shared) continue;
    sharing.push_back(&r);
    largest = std::max(largest, normal(r));
  }
  const double same = std::sqrt(round_off());
  std::erase_if(sharing, [&](const RoughState* r) {
    return r != &most && excess(*r, motion) <= -same && normal(*r) > same * largest;
  });
  return sharing;
}

/// Releases, of what sticks and would exceed its bound, what exceeds it most; whether there is any. Friction
/// that is 0 has no direction: it gets one, and `amend` turns it if it must.
bool FrictionModes::release_most_exceeded(const Motion& motion) {
  RoughState* most = nullptr;
  double by = 0.0;
  for (RoughState& r : all_) {
    const double own = excess(r, motion);
    if (!(own > by)) continue;
    most = &r;
    by = own;
  }
  if (most == nullptr) return false;
  mark_shared(motion);
  for (RoughState* const r : going_with(*most, motion)) {
    let_go(*r);
    if (!r->one_sided) r->sign = motion.lambda[r->pressing_row] < 0.0 ? -1.0 : 1.0;
    const VectorXd sigma = r->part(motion.lambda);
    r->start_sliding(sigma.isZero(0.0) ? VectorXd(VectorXd::Unit(sigma.size(), 0)) : -sigma.normalized());
    if (r->reached) r->let_go = at_.t;
  }
  return true;
}

/// Whether two slip velocities that start from rest take another direction than they were released in.
bool FrictionModes::turn(RoughState& rough, const Motion& motion) const {
  if (rough.rows != 2) return false;
  const VectorXd rate = equations_->slip_acceleration(rough, at_, motion);
  const double across = rough.direction[0] * rate[1] - rough.direction[1] * rate[0];
  if (std::abs(across) <= std::sqrt(round_off()) * rate.norm() || rough.direction.dot(rate) <= 0.0)
    return false;
  rough.direction = rate.normalized();
  return true;
}

/// Whether something violated the law and has been changed.
bool FrictionModes::amend(const Motion& motion) {
  for (RoughState& r : all_) {
    const double zero = equations_->round_off_of(all_, r, motion.a, motion.lambda);
    if (r.mode != RoughState::Mode::slides || r.one_sided || r.sign * motion.lambda[r.pressing_row] >= -zero)
      continue;
    r.sign = -r.sign;
    return true;
  }
  if (release_most_exceeded(motion)) return true;
  for (RoughState& r : all_) {
    if (r.mode != RoughState::Mode::slides || !r.at_rest) continue;
    if (turn(r, motion)) return true;
    if (r.direction.dot(equations_->slip_acceleration(r, at_, motion)) >= 0.0) continue;
    r.mode = RoughState::Mode::sticks;
    return true;
  }
  return false;
}

std::vector<double> FrictionModes::modes() const {
  std::vector<double> all;
  for (const RoughState& r : all_) {
    all.insert(all.end(), {static_cast<double>(r.mode), r.sign});
    if (r.mode == RoughState::Mode::slides) all.insert(all.end(), r.direction.begin(), r.direction.end());
  }
  return all;
}

void FrictionModes::refuse() const {
  std::string names;
  for (const RoughState& r : all_)
    if (r.mode != RoughState::Mode::absent) names += (names.empty() ? "" : ", ") + label(r);
  throw StepFailure{names +
                        ": no motion satisfies Coulomb's law here, neither sticking nor sliding (Painleve's "
                        "paradox); make mu smaller, or end the run before",
                    at_.t};
}

void FrictionModes::require_one_motion() const {
  if (std::ranges::none_of(all_, SecondMotion::tries)) return;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (all_[i].mode == RoughState::Mode::slides) which.push_back(i);
  const SlipCoupling coupling = equations_->released(all_, which, *open_, at_);
  for (const Part& part : parts_of(which)) {
    std::vector<const RoughState*> sliding;
    for (const Index k : part.places) sliding.push_back(&all_[which[static_cast<std::size_t>(k)]]);
    const auto second = SecondMotion::find(coupling.part(part.places, part.rows), sliding);
    if (!second) continue;
    std::ostringstream what;
    what << label(*second->rough)
         << ": more than one motion satisfies Coulomb's law here, with normal forces of " << second->N
         << " and " << second->other << " (Painleve's paradox); make mu smaller, or begin where there is one";
    throw StepFailure{what.str(), at_.t};
  }
}

void FrictionModes::find() try { search(); } catch (const StepFailure&) {
  require_own_shares(*equations_->stated(), all_, at_.t);
  throw;
} catch (const Error&) {
  require_own_shares(*equations_->stated(), all_, at_.t);
  throw;
}

void FrictionModes::search() {
  if (std::ranges::any_of(all_, &RoughState::at_rest)) decide();
  std::set<std::vector<double>> tried;
  Motion found = solve();
  while (amend(found)) {
    if (!tried.insert(modes()).second || tried.size() > most_tried) refuse();
    found = solve();
  }
  mark_shared(found);
}

}  // namespace dalembert
