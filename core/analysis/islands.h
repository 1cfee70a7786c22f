#pragma once

#include <dalembert/core/scene/system.h>

#include <vector>

namespace dalembert {

/// The parts of a scene that no constraint and no force couples to each other. (Constant forces, such
/// as gravity, couple nothing.)
struct Islands {
  int count = 0;
  std::vector<int> of_coordinate;  ///< numbered in the order of their first coordinates

  /// The island that a row of W belongs to.
  [[nodiscard]] int of_row(const System& system, int row) const {
    const auto first = static_cast<std::size_t>(system.row_start()[static_cast<std::size_t>(row)]);
    return of_coordinate[static_cast<std::size_t>(system.w_columns()[first])];
  }
};

[[nodiscard]] Islands islands(const System& system);

}  // namespace dalembert
