#include <dalembert/core/errors.h>
#include <dalembert/sweep/parameters.h>
#include <dalembert/sweep/text.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

namespace dalembert {

namespace {

std::string_view trimmed(std::string_view cell) {
  const auto begin = cell.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return cell.substr(begin, cell.find_last_not_of(" \t\r") - begin + 1);
}

/// The cells of a line; quotes as RFC 4180 has them.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"')
        cells.back() += line[++i];
      else
        quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// "length [m]".
Quantity quantity(const std::string& heading) {
  const auto bracket = heading.rfind('[');
  if (bracket == std::string::npos || !heading.ends_with(']')) return {heading};
  return {std::string(trimmed(std::string_view(heading).substr(0, bracket))),
          heading.substr(bracket + 1, heading.size() - bracket - 2)};
}

double number(const std::string& cell, const std::string& where) {
  double value = 0.0;
  const char* const end = cell.data() + cell.size();
  const auto read = std::from_chars(cell.data(), end, value);
  if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(value))
    throw InvalidArgument(where + " is \"" + cell + "\"; it must be a finite number");
  return value;
}

}  // namespace

Parameters read_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error("cannot read " + path + ": does it exist?");
  std::vector<Quantity> columns;
  std::vector<double> values;
  std::string line;
  for (std::size_t count = 1; std::getline(file, line); ++count) {
    if (count == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // a byte order mark
    if (trimmed(line).empty() || line.starts_with('#')) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (columns.empty()) {
      for (const std::string& heading : cells) columns.push_back(quantity(heading));
      continue;
    }
    const std::string where = path + ", line " + as_text(count);
    if (cells.size() != columns.size())
      throw InvalidArgument(where + ": " + as_text(cells.size()) + " cells under " + as_text(columns.size()) +
                            " names");
    for (std::size_t k = 0; k < cells.size(); ++k)
      values.push_back(number(cells[k], where + ": \"" + columns[k].name + '"'));
  }
  if (file.bad()) throw Error("cannot read all of " + path);
  if (values.empty())
    throw InvalidArgument(path + ": an empty table; a sweep needs names and at least one row");
  return table(columns, std::move(values));
}

}  // namespace dalembert
