#include "dalembert/sweep/parameters.h"

#include <dalembert/core/errors.h>
#include <dalembert/sweep/columns.h>
#include <dalembert/sweep/text.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace dalembert {

double Row::operator[](std::size_t column) const {
  if (column >= values_.size())
    throw InvalidArgument("row of parameters: column " + std::to_string(column) + " of " +
                          std::to_string(values_.size()) + " was asked for; they count from 0");
  return values_[column];
}

double Row::named(std::string_view name) const {
  const auto column = std::ranges::find(columns_, name, &Quantity::name);
  if (column == columns_.end())
    throw InvalidArgument("row of parameters: there is no column \"" + std::string(name) + "\" among " +
                          as_text(columns_));
  return values_[static_cast<std::size_t>(column - columns_.begin())];
}

void require_distinct(const std::string& what, const std::vector<Quantity>& columns,
                      const std::vector<Quantity>& taken) {
  std::vector<std::string> names;
  for (const Quantity& column : taken) names.push_back(column.name);
  for (const Quantity& column : columns) {
    if (column.name.empty()) throw InvalidArgument(what + ": a column has no name; give it one");
    if (std::ranges::find(names, column.name) != names.end())
      throw InvalidArgument(what + ": two columns are called \"" + column.name +
                            "\"; parameters and results need different names");
    names.push_back(column.name);
  }
}

Parameters::Parameters(std::vector<Quantity> columns, std::size_t rows, Fill fill, std::string description,
                       std::uint64_t seed)
    : columns_(std::move(columns)),
      rows_(rows),
      fill_(std::move(fill)),
      description_(std::move(description)),
      seed_(seed) {
  if (columns_.empty()) throw InvalidArgument("parameters: no columns; a sweep needs at least one");
  if (rows_ == 0) throw InvalidArgument("parameters: an empty table; a sweep needs at least one row");
  require_distinct("parameters", columns_);
}

namespace {

void require_finite(const auto& range) {
  if (!std::isfinite(range.from) || !std::isfinite(range.to))
    throw InvalidArgument("parameters: \"" + range.name + "\" goes from " + as_text(range.from) + " to " +
                          as_text(range.to) + "; both must be finite");
}

double on(const GridAxis& axis, std::size_t i) {
  if (i == 0) return axis.from;
  if (i + 1 == axis.count) return axis.to;
  const double share = static_cast<double>(i) / static_cast<double>(axis.count - 1);
  return axis.from + (axis.to - axis.from) * share;
}

}  // namespace

Parameters grid(const std::vector<GridAxis>& axes) {
  std::vector<Quantity> columns;
  std::size_t rows = axes.empty() ? 0 : 1;
  std::string description = "grid:";
  for (const GridAxis& axis : axes) {
    require_finite(axis);
    columns.push_back({axis.name, axis.unit});
    if (axis.count != 0 && rows > (std::size_t{1} << 62) / axis.count)
      throw InvalidArgument("parameters: a grid of more than 2^62 rows");
    rows *= axis.count;
    description += " " + axis.name + ' ' + as_text(axis.from) + " to " + as_text(axis.to) + " in " +
                   as_text(axis.count) + " values;";
  }
  const auto fill = [axes](std::size_t row, std::span<double> values) {
    for (std::size_t k = axes.size(); k-- > 0; row /= axes[k].count)
      values[k] = on(axes[k], row % axes[k].count);
  };
  return {std::move(columns), rows, fill, std::move(description)};
}

Parameters table(const std::vector<Quantity>& columns, std::vector<double> values) {
  const std::size_t width = columns.size();
  if (width != 0 && values.size() % width != 0)
    throw InvalidArgument("parameters: " + as_text(values.size()) + " numbers for rows of " + as_text(width) +
                          "; the last row is incomplete");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InvalidArgument("parameters: \"" + columns[i % width].name + "\" is " + as_text(values[i]) +
                            " in row " + as_text(i / width) + "; it must be finite");
  boost::crc_32_type sum;
  sum.process_bytes(values.data(), values.size() * sizeof(double));
  const std::size_t rows = width == 0 ? 0 : values.size() / width;
  const auto kept = std::make_shared<const std::vector<double>>(std::move(values));
  const auto fill = [kept, width](std::size_t row, std::span<double> out) {
    std::ranges::copy(std::span(*kept).subspan(row * width, width), out.begin());
  };
  return {columns, rows, fill, "table of " + as_text(rows) + " rows, checksum " + as_text(sum.checksum())};
}

}  // namespace dalembert
