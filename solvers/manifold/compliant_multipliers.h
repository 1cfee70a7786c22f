#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <array>
#include <cstddef>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The multipliers of compliant constraints, g + C lambda = 0, where they are part of a stepper's
/// state. One number per row of the system; those of rigid rows do not count. Empty if none is compliant.
struct CompliantMultipliers {
  explicit CompliantMultipliers(std::size_t rows = 0) : lambda(rows), rate(rows), second(rows) {}

  [[nodiscard]] std::array<std::vector<double>*, 3> parts() { return {&lambda, &rate, &second}; }

  std::vector<double> lambda, rate, second;  ///< lambda and its derivatives by time
  /// c: in the state a change of lambda brings c and c^2 times as much in its derivatives.
  double c = 0.0;
};

}  // namespace dalembert
