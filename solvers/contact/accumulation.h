#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <limits>

namespace DALEMBERT_HIDDEN dalembert {

/// The impact times of a contact, and their limit if they accumulate: intervals D_k whose ratios r_k =
/// D_k/D_(k-1) tend to a limit rho < 1 as the time left tends to 0,
///
///   r_(k+1) - rho = rho (r_k - rho),
///
/// as they do where forces and restitution vary smoothly. Early intervals give the limit as well as that
/// holds, late ones as well as times are known: the best estimate is the one that changed least. It is of one
/// series: one that later impacts contradict, by more than both are known, ends where forces, or restitution,
/// have changed, and so does one whose limit an impact has passed by more than its time is known.
class Accumulation {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

 public:
  /// One whose time is known to this error; of an unknown one it is taken for the same series.
  void add(double t, double error = infinity);
  /// Time between the last two impacts, and the last one.
  [[nodiscard]] double interval() const { return interval_; }
  [[nodiscard]] double last() const { return last_; }
  /// The time left after the last impact; infinite if they do not accumulate.
  [[nodiscard]] double left() const { return left_; }
  [[nodiscard]] double limit() const { return limit_; }
  /// By how much the last interval has changed it: of what converges that is more than what is left.
  [[nodiscard]] double uncertainty() const { return change_; }

 private:
  [[nodiscard]] bool contradicts(double error_of_estimate) const;

  double last_ = -infinity, interval_ = infinity;
  double ratio_ = infinity;  // of the last two intervals
  double left_ = infinity;
  double rho_ = 0.0;                                                   // of the best estimate
  double estimate_ = infinity, limit_ = infinity, change_ = infinity;  // the last, the best, and its change
};

}  // namespace dalembert
