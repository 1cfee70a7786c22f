#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/numbers.h>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// Calls f with `rounded` a rounding beside q in each coordinate, up and down by turns of one, two and three:
/// what f finds to differ is round-off of its terms.
template <class F>
void round_by_turns(std::span<const double> q, std::span<double> rounded, const F& f) {
  for (const std::size_t turns : {1U, 2U, 3U}) {
    for (std::size_t i = 0; i < q.size(); ++i)
      rounded[i] = q[i] * (i / turns % 2 == 0 ? 1.0 + epsilon : 1.0 - epsilon);
    f();
  }
}

}  // namespace dalembert
