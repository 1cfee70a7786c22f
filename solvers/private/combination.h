#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace dalembert {

/// A linear combination of stages with the zero weights left out:
/// out = base + h sum_j weight_j k_j, in one pass over memory, unrolled over j.
template <int Stages>
class Combination {
 public:
  explicit Combination(const std::array<double, Stages>& weights) {
    for (int j = 0; j < Stages; ++j) {
      const double w = weights[static_cast<std::size_t>(j)];
      if (w == 0.0) continue;
      weight_[count_] = w;
      stage_[count_++] = static_cast<std::size_t>(j);
    }
  }

  /// The k_j start `offset` numbers into each stage; without a base it counts as zero.
  void apply(double h, const std::array<const double*, Stages>& k, std::size_t offset, const double* base,
             double* out, std::size_t n) const {
    std::array<double, Stages> c;
    std::array<const double*, Stages> x;
    for (std::size_t j = 0; j < count_; ++j) {
      c[j] = h * weight_[j];
      x[j] = k[stage_[j]] + offset;
    }
    [&]<std::size_t... N>(std::index_sequence<N...>) {
      ((count_ == N + 1 ? unrolled<N + 1>(c, x, base, out, n) : void()), ...);
    }
    (std::make_index_sequence<Stages>{});
  }

 private:
  template <std::size_t N>
  static void unrolled(const std::array<double, Stages>& c, const std::array<const double*, Stages>& x,
                       const double* base, double* __restrict out, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      [&]<std::size_t... J>(std::index_sequence<J...>) { ((sum += c[J] * x[J][i]), ...); }
      (std::make_index_sequence<N>{});
      out[i] = base == nullptr ? sum : base[i] + sum;
    }
  }

  std::size_t count_ = 0;
  std::array<double, Stages> weight_{};
  std::array<std::size_t, Stages> stage_{};
};

}  // namespace dalembert
