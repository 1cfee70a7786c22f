#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace dalembert {

/// The polynomial of degree 8 through the value and two derivatives of a function at three times,
/// by Newton's divided differences (Stoer, Bulirsch, 2.1.5).
///
/// Its error has the order 9. The term of degree 8 by itself is the error of the polynomial of
/// degree 7 through all but one of the data, and so an upper estimate.
class Hermite9 {
 public:
  struct Result {
    double value, derivative;
    double last_value, last_derivative;  ///< the parts of the term of degree 8
  };

  /// Times relative to `t`, which is where the polynomial is asked for; they must differ.
  Hermite9(std::array<double, 3> times, double t) {
    for (std::size_t i = 0; i < 9; ++i) {
      to_[i] = t - times[i / 3];
      for (std::size_t k = 1; k + i < 9; ++k) {
        const double gap = times[(i + k) / 3] - times[i / 3];
        inverse_[k][i] = gap == 0.0 ? 0.0 : 1.0 / gap;
      }
    }
  }

  [[nodiscard]] Result operator()(const std::array<double, 3>& f, const std::array<double, 3>& f1,
                                  const std::array<double, 3>& f2) const {
    std::array<double, 9> difference, coefficient;
    for (std::size_t i = 0; i < 9; ++i) difference[i] = f[i / 3];
    coefficient[0] = difference[0];
    for (std::size_t k = 1; k < 9; ++k) {
      for (std::size_t i = 0; i + k < 9; ++i) {
        if (inverse_[k][i] != 0.0) {
          difference[i] = (difference[i + 1] - difference[i]) * inverse_[k][i];
        } else {  // k + 1 equal times
          difference[i] = k == 1 ? f1[i / 3] : 0.5 * f2[i / 3];
        }
      }
      coefficient[k] = difference[0];
    }
    Result r{coefficient[0], 0.0, 0.0, 0.0};
    double product = 1.0, slope = 0.0;  // of the Newton polynomial
    for (std::size_t k = 1; k < 9; ++k) {
      slope = slope * to_[k - 1] + product;
      product *= to_[k - 1];
      r.last_value = coefficient[k] * product;
      r.last_derivative = coefficient[k] * slope;
      r.value += r.last_value;
      r.derivative += r.last_derivative;
    }
    return r;
  }

 private:
  std::array<double, 9> to_;
  std::array<std::array<double, 9>, 9> inverse_;
};

}  // namespace dalembert
