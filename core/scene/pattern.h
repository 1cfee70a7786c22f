#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace dalembert {

/// A place in a sparse matrix.
struct MatrixEntry {
  std::size_t row, column;  ///< from 0
};

namespace detail {
/// Appends a dense block, rows first, for each element of a batch that reads `width` coordinates.
void append_blocks(std::span<const int> coordinates, std::size_t width, std::vector<MatrixEntry>& pattern);
}  // namespace detail

}  // namespace dalembert
