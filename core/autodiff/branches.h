#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dalembert {

/// The outcome of every comparison in the equations of a scene: what a user writes with abs, max or `if (x >
/// 0)` has a kink or a jump where one of its comparisons changes its outcome, and nowhere else. So a
/// discontinuity is found where it is stated, however small it is and wherever between two stages it falls.
///
/// Duals report their comparisons to the listener of this thread, if there is one. (A scalar type of its own
/// would need no such thing, but would compile every equation once more.)
class Branches {
 public:
  /// One number for all comparisons (less, equal, greater) of each batch.
  using Outcomes = std::vector<std::uint64_t>;

  /// Goes on from what `out` holds.
  explicit Branches(Outcomes& out) : out_(&out), outer_(std::exchange(listening, this)) {}
  Branches(const Branches&) = delete;
  Branches& operator=(const Branches&) = delete;
  ~Branches() { listening = outer_; }

  /// The number of comparisons that it has heard.
  [[nodiscard]] long count() const { return count_; }

  /// What is compared from here on belongs to this batch.
  static void begin_batch(std::size_t number) {
    if (listening != nullptr) listening->begin(number);
  }
  static void compare(double a, double b) {
    if (listening != nullptr) listening->add(a < b ? 1U : a == b ? 2U : 3U);
  }
  /// The piece of a piecewise function that was taken: like as many comparisons as it has jumps.
  static void choose(double piece) {
    if (listening != nullptr) listening->add(std::bit_cast<std::uint64_t>(piece));
  }

 private:
  void begin(std::size_t number) {
    batch_ = number;
    if (out_->size() <= number) out_->resize(number + 1);
  }
  void add(std::uint64_t outcome) {
    ++count_;
    if (out_->empty()) return;
    constexpr std::uint64_t fnv_prime = 1099511628211U;
    (*out_)[batch_] = ((*out_)[batch_] ^ outcome) * fnv_prime;
  }

  static inline thread_local constinit Branches* listening = nullptr;
  Outcomes* out_;
  Branches* outer_;
  std::size_t batch_ = 0;
  long count_ = 0;
};

}  // namespace dalembert
