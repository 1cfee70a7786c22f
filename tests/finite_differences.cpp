#include "finite_differences.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <limits>

namespace dalembert {

Slope slope(const std::function<Eigen::VectorXd(double)>& f, double magnitude) {
  constexpr double h = 1e-5;
  constexpr double operations = 32.0;
  const auto difference = [&f](double step) { return Eigen::VectorXd((f(step) - f(-step)) / (2.0 * step)); };
  const Eigen::VectorXd fine = difference(h);
  const double round_off = operations * std::numeric_limits<double>::epsilon() * magnitude / h;
  return {fine, ((difference(2.0 * h) - fine).array().abs() + round_off).matrix()};
}

void expect_slope(const Slope& expected, const Eigen::VectorXd& actual, const std::string& what) {
  ASSERT_EQ(actual.size(), expected.value.size()) << what;
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    EXPECT_NEAR(actual[i], expected.value[i], expected.error[i]) << what << ", component " << i;
  }
}

}  // namespace dalembert
