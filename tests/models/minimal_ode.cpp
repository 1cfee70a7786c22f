#include "dalembert/models/minimal_ode.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace dalembert::models::minimal_ode_test {
namespace {

TEST(MinimalOde, FollowsAnOscillatorToItsToleranceThroughAllTimesAskedFor) {
  const auto oscillator = [](const State& y, State& y_rate) {
    y_rate[0] = y[1];
    y_rate[1] = -y[0];
  };
  const std::array<double, 4> times{0.0, 0.25, 3.0, 50.0};
  std::vector<Real> seen;
  integrate(oscillator, State{1, 0}, times, [&](const State& y) { seen.push_back(y[0]); });
  ASSERT_EQ(seen.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    // At least 20 steps of 0.05 per unit of time (Fehlberg's error constant at 1e-17), each with one
    // tolerance.
    const Real bound = 20 * std::ceil(Real(times[i])) * reference_tolerance;
    EXPECT_LE(std::abs(seen[i] - std::cos(Real(times[i]))), bound) << times[i];
  }
}

TEST(MinimalOde, VisitsEveryTimeOnceAndInOnePass) {
  int evaluations = 0;
  const auto decay = [&](const State& y, State& y_rate) {
    ++evaluations;
    y_rate[0] = -y[0];
  };
  const auto nothing = [](const State&) {};
  integrate(decay, State{1}, std::array{10.0}, nothing);
  const int one_time = evaluations;
  evaluations = 0;
  std::vector<double> times;
  for (int i = 1; i <= 10; ++i) times.push_back(i);
  integrate(decay, State{1}, times, nothing);
  // Each time cuts at most one step short, of 13 evaluations, and costs one failed try of another; from 0 for
  // each it would be 5.5 times one_time.
  EXPECT_LT(evaluations, one_time + 10 * 2 * 13);
}

}  // namespace
}  // namespace dalembert::models::minimal_ode_test
