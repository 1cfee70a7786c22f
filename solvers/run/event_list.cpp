#include "dalembert/solvers/run/event_list.h"

#include <algorithm>
#include <numeric>

namespace dalembert {

void EventList::add(std::span<const EventRecord> events, const Side& before, const Side& after,
                    std::span<const double> impulses) {
  before_.use_layout(before.layout);
  after_.use_layout(after.layout);
  for (const EventRecord& one : events) {
    before_.append(before.sample);
    after_.append(after.sample);
    impulses_.insert(impulses_.end(), impulses.begin(), impulses.end());
    events_.push_back(one);  // last: if memory ends before, the event is not listed
  }
}

void EventList::write(Record& record) const {
  record.event_names = names_;
  std::vector<std::size_t> order(events_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [this](std::size_t k) { return events_[k].time; });
  const auto of = [&](const Record& samples) {
    Record stated = samples;
    stated.layout = record.layout;
    if (std::ranges::is_sorted(order)) return std::make_shared<Record>(std::move(stated));
    auto kept = std::make_shared<Record>();
    kept->layout = record.layout;
    for (const std::size_t k : order) {
      kept->use_layout(stated.layout_of(k));
      kept->append(stated.sample(k));
    }
    return kept;
  };
  record.at_events = of(before_);
  record.after_events = of(after_);
  record.events.clear();
  record.impulses.clear();
  if (events_.empty()) return;
  record.coordinates = before_.coordinates;
  const std::size_t rows = record.rows = before_.rows;  // also of a run that kept no sample
  for (const std::size_t k : order) {
    const auto own = std::span(impulses_).subspan(k * rows, rows);
    record.events.push_back(events_[k]);
    record.impulses.insert(record.impulses.end(), own.begin(), own.end());
  }
}

}  // namespace dalembert
