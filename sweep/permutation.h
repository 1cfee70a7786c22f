#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <bit>
#include <cstdint>

namespace DALEMBERT_HIDDEN dalembert {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): 64 bits, each a random function of all of `x`.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// Random bits of a place in a table, the same each time.
[[nodiscard]] constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t column,
                                                  std::uint64_t row) {
  return mixed(mixed(mixed(seed) ^ column) ^ row);
}

/// In [0, 1), of the upper 53 bits.
[[nodiscard]] constexpr double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Where a random permutation of `count` numbers, at most 2^62, sends `i`: without a table of it.
///
/// A Feistel network over the next even number of bits is a permutation of these (Luby, Rackoff 1988); what
/// falls outside is sent on until it is inside (cycle walking: Black, Rogaway 2002). Of small sets all
/// permutations are about equally likely from some twenty rounds on (Mitchell et al. 2021: 24).
[[nodiscard]] constexpr std::uint64_t permuted(std::uint64_t i, std::uint64_t count, std::uint64_t key) {
  if (count < 2) return i;
  const auto half = static_cast<int>(std::bit_width(count - 1) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = i >> half, right = i & mask;
    for (std::uint64_t round = 0; round < 24; ++round) {
      const std::uint64_t next = left ^ (random_bits(key, round, right) & mask);
      left = right;
      right = next;
    }
    i = left << half | right;
  } while (i >= count);
  return i;
}

}  // namespace dalembert
