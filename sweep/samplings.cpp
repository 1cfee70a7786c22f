#include <dalembert/core/errors.h>
#include <dalembert/sweep/parameters.h>
#include <dalembert/sweep/permutation.h>
#include <dalembert/sweep/text.h>

#include <boost/random/sobol.hpp>

#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// Points of the unit cube, `unit(row, k)` the k-th coordinate, spread over the ranges.
template <class Unit>
Parameters spread(const std::string& rule, const std::vector<Range>& ranges, std::size_t rows,
                  std::uint64_t seed, const Unit& unit) {
  std::vector<Quantity> columns;
  std::string description = rule + " of " + as_text(rows) + " points:";
  for (const Range& range : ranges) {
    if (!std::isfinite(range.from) || !std::isfinite(range.to))
      throw InvalidArgument("parameters: \"" + range.name + "\" goes from " + as_text(range.from) + " to " +
                            as_text(range.to) + "; both must be finite");
    columns.push_back({range.name, range.unit});
    description += " " + range.name + ' ' + as_text(range.from) + " to " + as_text(range.to) + ';';
  }
  const auto fill = [ranges, unit](std::size_t row, std::span<double> values) {
    unit(row, values);
    for (std::size_t k = 0; k < ranges.size(); ++k)
      values[k] = ranges[k].from + (ranges[k].to - ranges[k].from) * values[k];
  };
  return {std::move(columns), rows, fill, std::move(description), seed};
}

}  // namespace

Parameters monte_carlo(const std::vector<Range>& ranges, std::size_t rows, std::uint64_t seed) {
  return spread("Monte Carlo", ranges, rows, seed, [seed](std::size_t row, std::span<double> unit) {
    for (std::size_t k = 0; k < unit.size(); ++k) unit[k] = unit_interval(random_bits(seed, k, row));
  });
}

Parameters latin_hypercube(const std::vector<Range>& ranges, std::size_t rows, std::uint64_t seed) {
  return spread("Latin hypercube", ranges, rows, seed, [seed, rows](std::size_t row, std::span<double> unit) {
    for (std::size_t k = 0; k < unit.size(); ++k) {
      const std::uint64_t part = permuted(row, rows, random_bits(seed, k, 0));
      const double within = unit_interval(random_bits(seed, k, row + 1));
      unit[k] = (static_cast<double>(part) + within) / static_cast<double>(rows);
    }
  });
}

Parameters sobol(const std::vector<Range>& ranges, std::size_t rows, std::uint64_t seed) {
  using Engine = boost::random::sobol_engine<std::uint64_t, 64>;
  constexpr std::size_t most = boost::random::default_sobol_table::max_dimension;
  if (ranges.size() > most)
    throw InvalidArgument("parameters: " + as_text(ranges.size()) +
                          " columns; Sobol's sequence is known for " + as_text(most));
  if (ranges.empty()) throw InvalidArgument("parameters: no columns; a sweep needs at least one");
  const Engine first(ranges.size());
  return spread("Sobol", ranges, rows, seed, [first, seed](std::size_t row, std::span<double> unit) {
    Engine engine = first;  // its first point is the second of the sequence
    if (row > 0) engine.discard((row - 1) * unit.size());
    for (std::size_t k = 0; k < unit.size(); ++k) {
      const std::uint64_t digits = row > 0 ? engine() : 0;
      unit[k] = unit_interval(seed == 0 ? digits : digits ^ random_bits(seed, k, 0));
    }
  });
}

}  // namespace dalembert
