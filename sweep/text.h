#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/sweep/parameters.h>

#include <charconv>
#include <span>
#include <string>
#include <type_traits>

namespace DALEMBERT_HIDDEN dalembert {

/// A number with as few digits as give it back.
template <class Number>
  requires std::is_arithmetic_v<Number>
[[nodiscard]] std::string as_text(Number value) {
  char digits[40];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// "length [m], mass".
[[nodiscard]] inline std::string as_text(std::span<const Quantity> columns) {
  std::string list;
  for (const Quantity& column : columns)
    list += (list.empty() ? "" : ", ") + column.name + (column.unit.empty() ? "" : " [" + column.unit + ']');
  return list;
}

}  // namespace dalembert
