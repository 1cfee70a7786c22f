#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

/// A column of a sweep's dataset.
struct Quantity {
  std::string name;       ///< of a column
  std::string unit = "";  ///< as a reader is to see it; the user's own, nothing is converted
};

/// A row of parameters: what one scene is made from. A view, valid while `make` runs.
class Row {
 public:
  /// Made by Parameters.
  Row(std::size_t index, std::span<const Quantity> columns, std::span<const double> values)
      : index_(index), columns_(columns), values_(values) {}

  [[nodiscard]] std::size_t index() const { return index_; }  ///< from 0
  /// In the order of the columns.
  [[nodiscard]] std::span<const double> values() const { return values_; }
  /// By the number of a column, or its name. Throws InvalidArgument if there is none.
  [[nodiscard]] double operator[](std::size_t column) const;
  /// The value of a parameter by its name; throws InvalidArgument if there is none.
  template <std::convertible_to<std::string_view> Name>
  [[nodiscard]] double operator[](const Name& name) const {
    return named(name);
  }

 private:
  [[nodiscard]] double named(std::string_view name) const;

  std::size_t index_;
  std::span<const Quantity> columns_;
  std::span<const double> values_;
};

/// The table of a sweep's parameters. Its rows are computed when they are asked for, so that a table of any
/// length takes no memory; of a CSV file or an array all numbers are kept.
class Parameters {
 public:
  /// Writes the numbers of a row. The same row gives the same bits each time; called by many threads at once.
  using Fill = std::function<void(std::size_t row, std::span<double> values)>;

  /// Any rule. `description` is what tells this table from others: a sweep that is resumed must have the
  /// same. Throws InvalidArgument if there are no rows or columns, or two of one name.
  Parameters(std::vector<Quantity> columns, std::size_t rows, Fill fill, std::string description,
             std::uint64_t seed = 0);

  /// How many runs.
  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// Their names and units.
  [[nodiscard]] const std::vector<Quantity>& columns() const { return columns_; }
  /// Writes the values of a row.
  void fill(std::size_t row, std::span<double> values) const { fill_(row, values); }
  /// Their rule in words, part of the identity of a sweep.
  [[nodiscard]] const std::string& description() const { return description_; }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }  ///< 0 if nothing is random

 private:
  std::vector<Quantity> columns_;
  std::size_t rows_;
  Fill fill_;
  std::string description_;
  std::uint64_t seed_;
};

/// Equally spaced values of one parameter, both ends among them; of a single one it is `from`.
struct GridAxis {
  std::string name, unit;  ///< of the parameter
  double from, to;         ///< its first and last value
  std::size_t count;       ///< how many values, equally spaced
};

/// Where a random or quasi-random parameter lies, uniformly.
struct Range {
  std::string name, unit;  ///< of the parameter
  double from, to;         ///< its bounds
};

/// All combinations; the last axis varies fastest, as in an array of C or numpy.
///
///   grid({{"amplitude", "rad", 0.1, 3.0, 1000}, {"length", "m", 0.5, 2.0, 4}})
///
/// This and the following throw InvalidArgument for bounds that are not finite, and as Parameters.
[[nodiscard]] Parameters grid(const std::vector<GridAxis>& axes);

/// Independent points (Monte Carlo): quantiles have the binomial error of order statistics.
[[nodiscard]] Parameters monte_carlo(const std::vector<Range>& ranges, std::size_t rows, std::uint64_t seed);

/// A Latin hypercube (McKay, Beckman, Conover 1979): of every parameter one value in each of `rows` equal
/// parts of its range, in random order and at a random place within.
[[nodiscard]] Parameters latin_hypercube(const std::vector<Range>& ranges, std::size_t rows,
                                         std::uint64_t seed);

/// Sobol's sequence, directions of Joe and Kuo (by Boost). The first point, the lower ends, is not left out:
/// 2^k rows would lose their balance (Owen 2020). A seed other than 0 shifts all digits at random; sweeps
/// with several seeds tell the error.
[[nodiscard]] Parameters sobol(const std::vector<Range>& ranges, std::size_t rows, std::uint64_t seed = 0);

/// Numbers of one's own, row by row. Throws InvalidArgument unless all are finite and rows complete.
[[nodiscard]] Parameters table(const std::vector<Quantity>& columns, std::vector<double> values);

/// Comma-separated values: names in the first line, a unit behind each in brackets, "length [m]"; lines that
/// begin with '#' are skipped. Throws Error if the file cannot be read, and InvalidArgument that names line
/// and column of what is no finite number.
[[nodiscard]] Parameters read_csv(const std::string& path);

}  // namespace dalembert
