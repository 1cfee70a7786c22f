#include <dalembert/solvers/ida/order_guard.h>

#include <gtest/gtest.h>

namespace dalembert::order_guard_test {
namespace {

/// Steps of the length that `step` gives for each order, until time `end`; the number taken.
template <class Step>
int steps_until(double end, double rho, OrderGuard& guard, const Step& step) {
  int steps = 0;
  for (double t = 0.0; t < end; ++steps) {
    const double h = step(guard.order());
    t += h;
    (void)guard.watch(h, rho);
  }
  return steps;
}

TEST(OrderGuard, LeavesScenesWithoutVibrationsAlone) {
  OrderGuard guard;
  for (int i = 0; i < 10'000; ++i) EXPECT_FALSE(guard.watch(0.01, 0.0));
  EXPECT_EQ(guard.order(), 5);
}

TEST(OrderGuard, LeavesVibrationsAloneThatOrderFiveResolves) {
  OrderGuard guard;
  for (int i = 0; i < 10'000; ++i) EXPECT_FALSE(guard.watch(0.01, 30.0));
}

// Order 5 stuck at h rho = 0.5, order 3 beyond its unstable range: after the trial, order 3 is kept.
TEST(OrderGuard, FindsTheOrderThatIsNotHeldDown) {
  OrderGuard guard;
  const int steps = steps_until(100.0, 100.0, guard, [](int order) {
    return order == 5 ? 0.005 : order == 3 ? 0.03 : 0.008;
  });
  EXPECT_LT(steps, 0.5 * 100.0 / 0.005);
}

// Order 3 pays until the vibration has grown: from t = 20 on it is worse than order 5 was.
TEST(OrderGuard, GivesUpAnOrderThatNoLongerPays) {
  OrderGuard guard;
  double t = 0.0;
  int at_third_late = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double h = guard.order() == 5 ? 0.005 : guard.order() == 3 && t < 20.0 ? 0.03 : 0.002;
    t += h;
    (void)guard.watch(h, 100.0);
    if (t > 25.0 && guard.order() != 5) ++at_third_late;
  }
  EXPECT_LT(at_third_late, 4 * 3 * 50);  // trials only, of two windows at order 2 and one at order 3
}

// The trials' number grows as the logarithm of the run's length: after 1, 8, 64, ... windows, 3 windows each.
TEST(OrderGuard, GivesUpWhereTheVibrationIsPartOfTheMotion) {
  OrderGuard guard;
  const int steps = steps_until(1000.0, 100.0, guard, [](int order) { return order == 5 ? 0.006 : 0.003; });
  EXPECT_LT(steps, 1.05 * 1000.0 / 0.006);
}

}  // namespace
}  // namespace dalembert::order_guard_test
