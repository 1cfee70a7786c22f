#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <array>
#include <cstddef>
#include <utility>

namespace DALEMBERT_HIDDEN dalembert {

/// A linear combination of stages, h sum_j weight_j k_j, with the zero weights left out; in one pass over
/// memory, unrolled over j.
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

  /// Of the first `size` numbers of each stage.
  void apply(double h, const std::array<const double*, Stages>& k, double* out, std::size_t size) const {
    unroll([&]<std::size_t N>(Terms<N> terms) { terms.add(nullptr, out, size); }, h, k);
  }
  /// Positions and velocities moved by stages of n velocities and n accelerations.
  void move(double h, const std::array<const double*, Stages>& k, const double* q, double* q_moved,
            const double* v, double* v_moved, std::size_t n) const {
    unroll(
        [&]<std::size_t N>(Terms<N> terms) {
          terms.add(q, q_moved, n);
          for (const double*& x : terms.x) x += n;
          terms.add(v, v_moved, n);
        },
        h, k);
  }

 private:
  template <std::size_t N>
  struct Terms {
    std::array<double, N> c;
    std::array<const double*, N> x;

    /// out = base + sum_j c_j x_j; without a base it counts as zero.
    void add(const double* base, double* __restrict out, std::size_t size) const {
      for (std::size_t i = 0; i < size; ++i) {
        double sum = 0.0;
        [&]<std::size_t... J>(std::index_sequence<J...>) { ((sum += c[J] * x[J][i]), ...); }
        (std::make_index_sequence<N>{});
        out[i] = base == nullptr ? sum : base[i] + sum;
      }
    }
  };

  template <class F>
  void unroll(const F& f, double h, const std::array<const double*, Stages>& k) const {
    const auto with = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
      Terms<N> terms;
      for (std::size_t j = 0; j < N; ++j) {
        terms.c[j] = h * weight_[j];
        terms.x[j] = k[stage_[j]];
      }
      f(terms);
      return true;
    };
    [&]<std::size_t... N>(std::index_sequence<N...>) {
      (void)((count_ == N + 1 && with(std::integral_constant<std::size_t, N + 1>{})) || ...);
    }
    (std::make_index_sequence<Stages>{});
  }

  std::size_t count_ = 0;
  std::array<double, Stages> weight_{};
  std::array<std::size_t, Stages> stage_{};
};

}  // namespace dalembert
