#pragma once

#include <Eigen/Core>

#include <functional>
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
Slope slope(const std::function<Eigen::VectorXd(double)>& f, double magnitude = 10.0);

void expect_slope(const Slope& expected, const Eigen::VectorXd& actual, const std::string& what);

}  // namespace dalembert
