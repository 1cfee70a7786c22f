#include "dalembert/solvers/ida/order_guard.h"

#include <dalembert/solvers/base/constants.h>

#include <algorithm>

namespace dalembert {

namespace {

/// Windows of each phase, how much longer to wait after each trial that did not pay, and at most. At h rho =
/// 0.6 order 2 damps by 0.97 a step.
constexpr int damping = 2, trying = 1, more_patience = 8, longest_patience = 1000;

}  // namespace

bool OrderGuard::watch(double h, double rho) {
  advance_ += h;
  turned_ += h * rho;
  if (++steps_ < window) return false;
  const int before = order_;
  // What the last trial ended with may last only until the vibration has grown again.
  const bool collapsed = phase_ == Phase::free && 2.0 * advance_ < by_third_;
  if (--windows_left_ <= 0 || collapsed) end_window(advance_, turned_ / window);
  steps_ = 0;
  advance_ = turned_ = 0.0;
  return order_ != before;
}

void OrderGuard::enter(Phase phase, int order, int windows) {
  phase_ = phase;
  order_ = order;
  windows_left_ = windows;
}

void OrderGuard::end_window(double advance, double turned) {
  switch (phase_) {
    case Phase::free:
      by_fifth_ = advance;
      if (turned > constants.resolved && turned < constants.passed_over) enter(Phase::damping, 2, damping);
      return;
    case Phase::damping:
      by_second_ = advance;
      return enter(Phase::at_third, 3, trying);
    case Phase::at_third:
      by_third_ = advance;
      if (by_third_ > std::max(by_fifth_, by_second_)) return enter(Phase::kept, 3, 1);
      if (by_second_ > by_fifth_) return enter(Phase::kept, 2, 1);
      patience_ = std::min(more_patience * patience_, longest_patience);
      return enter(Phase::free, highest, patience_);
    case Phase::kept:
      if (advance >= by_fifth_ && turned > constants.resolved && turned < constants.passed_over)
        return enter(Phase::kept, order_, 1);
      patience_ = advance >= by_fifth_ ? 1 : std::min(more_patience * patience_, longest_patience);
      return enter(Phase::free, highest, patience_);
  }
}

}  // namespace dalembert
