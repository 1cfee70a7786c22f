#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Consecutive rows, [first, first + count).
struct Interval {
  std::uint64_t first = 0, count = 0;
  [[nodiscard]] std::uint64_t end() const { return first + count; }
};

/// How many numbers a row has.
struct Widths {
  std::size_t values = 0, series = 0;
};

/// The results of consecutive rows as bytes: what ranks send and the journal keeps.
///
/// Of each row: a byte, 1 if it is done and 2 if it failed; then the values, the number of samples (8 bytes)
/// and these, or the time of the failure, the length of the message (4 bytes) and this.
struct Block {
  Interval rows{};
  std::uint64_t failures = 0, samples = 0;
  double seconds = 0.0;  ///< that they took
  std::string bytes{};

  /// Appends the row `rows.end()`.
  void add(std::span<const double> values, std::span<const double> series, Widths widths);
  void add_failure(double time, std::string_view message);
};

/// A row read from a block.
struct BlockRow {
  bool failed = false;
  std::vector<double> values{}, series{};
  double time = 0.0;
  std::string message{};
};

/// Reads the rows of a block one after the other. Throws Error where the bytes end too early.
class BlockReader {
 public:
  BlockReader(std::string_view bytes, Widths widths) : rest_(bytes), widths_(widths) {}
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  void next(BlockRow& row);

 private:
  std::string_view take(std::size_t count);
  template <class Number>
  Number number();
  void numbers(std::vector<double>& out, std::size_t count);

  std::string_view rest_;
  Widths widths_;
};

}  // namespace dalembert
