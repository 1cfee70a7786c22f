#include "dalembert/core/results/statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dalembert::statistics_test {
namespace {

TEST(Statistics, ReportIsOneLineWithEveryNumber) {
  Statistics s;
  s.steps = 11;
  s.evaluations = 22;
  s.factorisations = 33;
  s.error_test_failures = 44;
  s.convergence_failures = 55;
  s.residual_position = 0.5;
  s.residual_velocity = 0.25;
  s.correction = 0.125;
  s.run_time = 1.5;
  EXPECT_EQ(s.report(),
            "0 degrees of freedom, 11 steps, accuracy 0, 22 evaluations, 33 factorisations, 44 error test "
            "failures, 55 "
            "convergence failures, length 0, time 0, residuals 0.5 (position) 0.25 (velocity), correction "
            "0.125, 1.5 s");
}

}  // namespace
}  // namespace dalembert::statistics_test
