#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/hidden.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Which of what happened in two runs of one scene is the same.
///
/// The same must happen to each constraint, and each event that was asked for, in the same order. One
/// exception: of the infinitely many impacts before rest the more accurate run lists more. And what happens
/// to all of them must happen in the same order, but for what happens at one time.
class MatchingEvents {
 public:
  MatchingEvents(const Record& run, const Record& reference);

  /// For everything that happened in the run, its number in the other.
  [[nodiscard]] const std::vector<std::optional<std::size_t>>& counterparts() const { return counterparts_; }
  /// Whether the run lists fewer impacts before this rest than the other.
  [[nodiscard]] bool ends_earlier(std::size_t k) const { return ends_earlier_[k] != 0; }
  /// From when on the two do not match, infinite if they do; and what happened then.
  [[nodiscard]] double part_at() const { return part_at_; }
  [[nodiscard]] const std::string& difference() const { return difference_; }

 private:
  void match_one(const std::vector<std::size_t>& own, const std::vector<std::size_t>& others);
  void require_order();
  void part(double time, const std::string& difference);
  [[nodiscard]] std::string label(const EventRecord& one) const;

  const Record *run_, *reference_;
  std::vector<std::optional<std::size_t>> counterparts_;
  std::vector<char> ends_earlier_;
  double part_at_ = std::numeric_limits<double>::infinity();
  std::string difference_;
};

}  // namespace dalembert
