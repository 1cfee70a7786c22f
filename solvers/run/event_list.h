#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/hidden.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The events of a run, each with the samples before and after it and with its impulses.
class EventList {
 public:
  /// Of a run in which events with these names were asked for.
  explicit EventList(std::vector<std::string> names) : names_(std::move(names)) {}

  /// A sample, and the names and places of its numbers.
  struct Side {
    FlatSample sample;
    std::shared_ptr<const Layout> layout;
  };
  /// Adds events of one instant; `impulses`, one per row, lead from the one side to the other.
  void add(std::span<const EventRecord> events, const Side& before, const Side& after,
           std::span<const double> impulses);

  /// In the order in which they were found.
  [[nodiscard]] const std::vector<EventRecord>& events() const { return events_; }
  /// Puts them among the results of a run, in the order of time: where one contact comes to rest, at the
  /// limit of its impacts, others may have impacts before that.
  void write(Record& record) const;

 private:
  std::vector<std::string> names_;
  std::vector<EventRecord> events_;
  Record before_, after_;
  std::vector<double> impulses_;
};

}  // namespace dalembert
