#pragma once

#include <dalembert/core/autodiff/derivatives.h>
#include <dalembert/solvers/base/hidden.h>

#include <cstddef>
#include <cstring>

namespace DALEMBERT_HIDDEN dalembert {

/// One number, or a Pair of neighbours, from memory of any alignment.
template <class T>
[[nodiscard]] DALEMBERT_INLINE T load(const double* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// out[i] = f(i, 0) for numbers that are loaded at i; `out` may be one of those arrays. Two at a time,
/// written out: a compiler would check at run time that `out` overlaps none of them, which takes longer where
/// they are short.
template <class F>
DALEMBERT_INLINE void write_by_pairs(double* out, std::size_t size, const F& f) {
  const auto write = [&](std::size_t i, auto zero) DALEMBERT_INLINE_LAMBDA {
    const auto value = f(i, zero);
    std::memcpy(out + i, &value, sizeof value);
  };
  std::size_t i = 0;
  for (; i + 1 < size; i += 2) write(i, detail::Pair{0.0, 0.0});
  if (i < size) write(i, 0.0);
}

}  // namespace dalembert
