#pragma once

#include <dalembert/core/scene/system.h>

#include <vector>

namespace dalembert {

/// The parts of a scene that no constraint and no force couples to each other. (Constant forces, such
/// as gravity, couple nothing.)
struct Islands {
  std::size_t count = 0;
  std::vector<std::size_t> of_coordinate;  ///< numbered in the order of their first coordinates

  /// The island that a row of W belongs to.
  [[nodiscard]] std::size_t of_row(const System& system, std::size_t row) const {
    return of_coordinate[system.w_columns()[system.row(row).front()]];
  }
};

[[nodiscard]] Islands islands(const System& system);

}  // namespace dalembert
