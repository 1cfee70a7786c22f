#pragma once

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace dalembert {

/// A derivative by central differences, and a bound of its error.
struct Slope {
  Eigen::VectorXd value, error;
};

/// df/ds at s = 0 of a function with values in R^k.
///
///   D(h) = (f(h) - f(-h)) / 2h = f' + h^2 f'''/6 + O(h^4)
///
/// so that |D(2h) - D(h)| is three times the truncation error of D(h). Round-off adds the error of f
/// over h; f is taken for `operations` roundings of numbers of size `magnitude`. With h = 1e-5, the
/// cube root of the unit round-off, both are about 1e-10 for functions of size 1.
template <class F>
Slope slope(const F& f, double magnitude = 10.0) {
  constexpr double h = 1e-5;
  constexpr double operations = 32.0;
  const auto difference = [&f](double step) { return Eigen::VectorXd((f(step) - f(-step)) / (2.0 * step)); };
  const Eigen::VectorXd fine = difference(h);
  const double round_off = operations * std::numeric_limits<double>::epsilon() * magnitude / h;
  return {fine, ((difference(2.0 * h) - fine).array().abs() + round_off).matrix()};
}

inline void expect_slope(const Slope& expected, const Eigen::VectorXd& actual, const std::string& what) {
  ASSERT_EQ(actual.size(), expected.value.size()) << what;
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    EXPECT_NEAR(actual[i], expected.value[i], expected.error[i]) << what << ", component " << i;
  }
}

}  // namespace dalembert
