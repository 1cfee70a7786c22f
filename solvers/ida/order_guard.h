#pragma once

#include <dalembert/solvers/base/hidden.h>

namespace DALEMBERT_HIDDEN dalembert {

/// Chooses the highest order that BDF may use where vibrations limit the step.
///
/// BDF of orders 3 to 5 is unstable close to the imaginary axis: a vibration of frequency rho that the
/// tolerance would let pass unseen is amplified as long as h rho is between some tenths and 1.9 (order
/// 3, at most by 1.05 a step), 4.7 (order 4), 9.4 (order 5, up to 1.4), and the step sticks at half of
/// 1/rho. Order 2 damps it. Which order advances fastest is found by trial: a while at order 2 to
/// damp what has built up, then order 3, whose natural step often lies beyond its own unstable range.
/// The best is kept as long as it advances better than order 5 did, or until the vibration is slow enough to
/// be followed or so fast that every order is stable. Where the vibration is part of the motion order 5 wins,
/// and the next trial comes later each time. (CVODE's stability limit detection has the same purpose; it
/// needs the history inside BDF.)
class OrderGuard {
 public:
  static constexpr int highest = 5;

  /// After each step: its length, and the fastest vibration to be passed over [1 / time], 0 if there is
  /// none. True if `order` has changed.
  [[nodiscard]] bool watch(double h, double rho);
  /// The highest order to be used from here on.
  [[nodiscard]] int order() const { return order_; }

 private:
  enum class Phase { free, damping, at_third, kept };

  void end_window(double advance, double turned);
  void enter(Phase phase, int order, int windows);

  static constexpr int window = 50;  // steps: enough for a change of order to show
  int order_ = highest;
  Phase phase_ = Phase::free;
  int windows_left_ = 1;   // until this phase is judged
  int steps_ = 0;          // of this window,
  double advance_ = 0.0;   // their sum
  double turned_ = 0.0;    // and that of h rho
  double by_fifth_ = 0.0;  // advance of the last window at each order
  double by_third_ = 0.0;
  double by_second_ = 0.0;
  int patience_ = 1;  // windows until the next trial
};

}  // namespace dalembert
