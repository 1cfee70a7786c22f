#include "dalembert/core/scene/pattern.h"

namespace dalembert::detail {

void append_blocks(std::span<const int> coordinates, std::size_t width, std::vector<MatrixEntry>& pattern) {
  for (std::size_t first = 0; first < coordinates.size(); first += width) {
    for (const int row : coordinates.subspan(first, width)) {
      for (const int column : coordinates.subspan(first, width))
        pattern.push_back({static_cast<std::size_t>(row), static_cast<std::size_t>(column)});
    }
  }
}

}  // namespace dalembert::detail
