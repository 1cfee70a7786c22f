#pragma once

#include <dalembert/core/errors.h>

#include <optional>

namespace dalembert {

template <class F>
[[nodiscard]] std::optional<IntegrationFailure> failure_of(const F& f) {
  try {
    f();
  } catch (const IntegrationFailure& failure) {
    return failure;
  }
  return std::nullopt;
}

}  // namespace dalembert
