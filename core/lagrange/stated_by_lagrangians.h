#pragma once

#include <dalembert/core/equations/arguments.h>

#include <vector>

namespace dalembert {

/// Forces that follow from Lagrangians tell what must not jump where a comparison of these changes its
/// outcome: else an impulse acts there. With the time alone L may jump, as where a spring is exchanged, but
/// no momentum L_v; elsewhere neither may.
class StatedByLagrangians {
 public:
  /// A number, and by how much errors of the state change it.
  struct Value {
    double value;  ///< the number
    double error;  ///< the largest change
  };
  /// What must not jump.
  struct Values {
    std::vector<Value> L;        ///< of each Lagrangian
    std::vector<Value> momenta;  ///< of each of its coordinates, L_v
  };
  /// At an instant whose time, coordinates and velocities have these errors.
  [[nodiscard]] virtual Values lagrangians(const Instant& at, const Instant& errors) const = 0;

 protected:
  ~StatedByLagrangians() = default;
};

}  // namespace dalembert
