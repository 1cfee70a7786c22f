#pragma once

#include <dalembert/core/vec.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace dalembert::fuzz {

/// Random numbers that a seed decides for every compiler and library: the standard lays down the bits
/// of mt19937_64 but not what its distributions make of them. Nor the order in which operands are
/// evaluated: no expression draws twice unless braces or commas order it.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  [[nodiscard]] double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * uniform(); }
  /// 10^x with x between the two.
  [[nodiscard]] double decades(double low, double high) { return std::pow(10.0, between(low, high)); }
  /// One of 0 ... n - 1.
  [[nodiscard]] int below(int n) { return static_cast<int>(uniform() * n); }
  [[nodiscard]] bool chance(double p) { return uniform() < p; }
  [[nodiscard]] double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// Components between -1 and 1.
  template <int D>
  [[nodiscard]] Vec<D> vector() {
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = between(-1.0, 1.0);
    return r;
  }
  /// Of unit length.
  template <int D>
  [[nodiscard]] Vec<D> direction() {
    Vec<D> r = vector<D>();
    while (r.norm() < 0.1) r = vector<D>();
    return r.normalized();
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace dalembert::fuzz
