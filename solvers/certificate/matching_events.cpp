#include "dalembert/solvers/certificate/matching_events.h"

#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

using Numbers = std::vector<std::size_t>;
/// An event that was asked for, or a constraint, and its number.
using Element = std::pair<bool, std::size_t>;

std::map<Element, std::pair<Numbers, Numbers>> by_element(const Record& run, const Record& reference) {
  std::map<Element, std::pair<Numbers, Numbers>> all;
  const auto of = [](const EventRecord& one) { return Element(one.kind == EventKind::event, one.source); };
  for (std::size_t k = 0; k < run.events.size(); ++k) all[of(run.events[k])].first.push_back(k);
  for (std::size_t k = 0; k < reference.events.size(); ++k) all[of(reference.events[k])].second.push_back(k);
  return all;
}

}  // namespace

MatchingEvents::MatchingEvents(const Record& run, const Record& reference)
    : run_(&run), reference_(&reference), counterparts_(run.events.size()), ends_earlier_(run.events.size()) {
  for (const auto& [element, numbers] : by_element(run, reference)) match_one(numbers.first, numbers.second);
  require_order();
}

std::string MatchingEvents::label(const EventRecord& one) const {
  std::ostringstream out;
  out.precision(8);
  const auto kind = one.kind == EventKind::event ? "Event" : run_->layout->constraints[one.source].kind;
  out << kind << " \"" << run_->name_of(one) << "\" " << name(one.kind) << " at t = " << one.time;
  return out.str();
}

void MatchingEvents::part(double time, const std::string& difference) {
  if (time >= part_at_) return;
  part_at_ = time;
  difference_ = difference;
}

void MatchingEvents::match_one(const Numbers& own, const Numbers& others) {
  auto i = own.begin();
  auto j = others.begin();
  bool skipped = false;
  while (i != own.end() && j != others.end()) {
    const EventRecord &a = run_->events[*i], &b = reference_->events[*j];
    if (a.kind == b.kind) {
      ends_earlier_[*i] = std::exchange(skipped, false) ? 1 : 0;
      counterparts_[*i++] = *j++;
      continue;
    }
    skipped = true;
    if (a.kind == EventKind::rested && b.kind == EventKind::struck) {
      ++j;
    } else if (a.kind == EventKind::struck && b.kind == EventKind::rested) {
      ++i;
    } else {
      break;
    }
  }
  if (i != own.end())
    part(run_->events[*i].time, label(run_->events[*i]) + ", but not in the more accurate run");
  if (j != others.end())
    part(reference_->events[*j].time, label(reference_->events[*j]) + " in the more accurate run only");
}

void MatchingEvents::require_order() {
  std::size_t last = 0;
  bool any = false;
  for (std::size_t k = 0; k < counterparts_.size(); ++k) {
    if (!counterparts_[k]) continue;
    const std::size_t other = *counterparts_[k];
    const EventRecord &a = run_->events[k], &before = reference_->events[last],
                      &b = reference_->events[other];
    const double same = 64.0 * epsilon * std::max(std::abs(b.time), run_->statistics.time);
    if (any && other < last && before.time - b.time > same)
      part(std::min(a.time, b.time), label(b) + " in the more accurate run, before " + label(before) +
                                         ": in another order than in this one");
    if (!any || other > last) last = other;
    any = true;
  }
}

}  // namespace dalembert
