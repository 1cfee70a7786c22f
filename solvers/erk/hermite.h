#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <array>
#include <cstddef>

namespace DALEMBERT_HIDDEN dalembert {

/// The polynomial of degree 3 Nodes - 1 through the value and two derivatives of a function at each
/// of several times, by Newton's divided differences (Stoer, Bulirsch, Numerical Analysis, 2.1.5); or of
/// degree 2 Nodes - 1, through the value and one derivative.
///
/// Its error is f^(3 Nodes)/(3 Nodes)! times the product of all (t - t_i)^3, and so on.
template <std::size_t Nodes, std::size_t Known = 3>
class Hermite {
  static constexpr std::size_t data = Known * Nodes;

 public:
  using Values = std::array<double, Nodes>;
  struct Result {
    double value, derivative;
  };

  /// The polynomial is asked for at `t`; the times must differ.
  Hermite(const Values& times, double t) {
    for (std::size_t i = 0; i < data; ++i) {
      to_[i] = t - times[i / Known];
      for (std::size_t k = 1; k + i < data; ++k) {
        const double gap = times[(i + k) / Known] - times[i / Known];
        inverse_gap_[k][i] = gap == 0.0 ? 0.0 : 1.0 / gap;
      }
    }
  }

  [[nodiscard]] Result operator()(const Values& f, const Values& f1, const Values& f2 = {}) const {
    std::array<double, data> difference, coefficient;  // of order k so far; of the Newton polynomials
    for (std::size_t i = 0; i < data; ++i) difference[i] = f[i / Known];
    coefficient[0] = difference[0];
    for (std::size_t k = 1; k < data; ++k) {
      for (std::size_t i = 0; i + k < data; ++i) {
        difference[i] = (difference[i + 1] - difference[i]) * inverse_gap_[k][i];
        // Over k + 1 equal times a difference is the k-th derivative over k!.
        if (k == 1 && i % Known + 1 < Known) difference[i] = f1[i / Known];
        if (k == 2 && Known == 3 && i % 3 == 0) difference[i] = 0.5 * f2[i / 3];
      }
      coefficient[k] = difference[0];
    }
    Result r{coefficient[0], 0.0};
    double product = 1.0, slope = 0.0;  // of the Newton polynomial of degree k
    for (std::size_t k = 1; k < data; ++k) {
      slope = slope * to_[k - 1] + product;
      product *= to_[k - 1];
      r.value += coefficient[k] * product;
      r.derivative += coefficient[k] * slope;
    }
    return r;
  }

 private:
  std::array<double, data> to_;
  std::array<std::array<double, data>, data> inverse_gap_;
};

}  // namespace dalembert
