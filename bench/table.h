#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace dalembert::bench {

/// Rows of text under named columns, for a reader or for another program.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// Columns aligned with spaces, words to the left and numbers to the right.
  void print(std::ostream& out) const;
  /// Comma-separated values, the names of the columns first.
  void write_csv(std::ostream& out) const;
};

/// A number in scientific notation with this many significant digits; "nan" if there is none.
[[nodiscard]] std::string scientific(double value, int digits = 4);
/// A number as short as it can be without loss, by itself (10, 0.5) or as a power of ten (1e-03).
[[nodiscard]] std::string shortest(double value);
[[nodiscard]] std::string shortest_power(double value);

}  // namespace dalembert::bench
