#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/pairs.h>

#include <array>
#include <cstddef>
#include <utility>

namespace DALEMBERT_HIDDEN dalembert {

/// A linear combination of stages, h sum_j weight_j k_j, with the zero weights left out; in one pass over
/// memory, unrolled over j.
template <int Stages>
class Combination {
 public:
  using Derivatives = std::array<const double*, Stages>;

  explicit Combination(const std::array<double, Stages>& weights) {
    for (int j = 0; j < Stages; ++j) {
      const double w = weights[static_cast<std::size_t>(j)];
      if (w == 0.0) continue;
      weight_[count_] = w;
      stage_[count_++] = static_cast<std::size_t>(j);
    }
  }

  /// out = from + h sum_j weight_j k_j, `size` numbers.
  void move(double h, const Derivatives& k, const double* from, double* out, std::size_t size) const {
    [&]<std::size_t... N>(std::index_sequence<N...>) {
      (void)((count_ == N + 1 && (move_by<N + 1>(h, k, from, out, size), true)) || ...);
    }
    (std::make_index_sequence<Stages>{});
  }

 private:
  template <std::size_t N>
  void move_by(double h, const Derivatives& k, const double* from, double* out, std::size_t size) const {
    std::array<double, N> c;
    std::array<const double*, N> x;
    for (std::size_t j = 0; j < N; ++j) {
      c[j] = h * weight_[j];
      x[j] = k[stage_[j]];
    }
    write_by_pairs(out, size, [&]<class T>(std::size_t i, T sum) DALEMBERT_INLINE_LAMBDA {
      [&]<std::size_t... J>(std::index_sequence<J...>) { ((sum += c[J] * load<T>(x[J] + i)), ...); }
      (std::make_index_sequence<N>{});
      return T(load<T>(from + i) + sum);
    });
  }

  std::size_t count_ = 0;
  std::array<double, Stages> weight_{};
  std::array<std::size_t, Stages> stage_{};
};

}  // namespace dalembert
