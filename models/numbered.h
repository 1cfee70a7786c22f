#pragma once

#include <concepts>
#include <string>

namespace dalembert::models {

/// A name with a number behind it: "rod3".
[[nodiscard]] std::string numbered(std::string name, std::integral auto number) {
  return name += std::to_string(number);
}

}  // namespace dalembert::models
