#include "dalembert/bench/table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <ostream>

namespace dalembert::bench {

namespace {

using Row = std::vector<std::string>;

bool is_number(const std::string& cell) {
  char* end = nullptr;
  std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0';
}

/// As RFC 4180 has it; what is refused may say why with commas.
void write_cell(std::ostream& out, const std::string& cell) {
  cell.find(',') == std::string::npos ? out << cell : out << std::quoted(cell, '"', '"');
}

void write_row(std::ostream& out, const Row& row) {
  for (std::size_t i = 0; i < row.size(); ++i) write_cell(out << (i == 0 ? "" : ","), row[i]);
  out << '\n';
}

}  // namespace

void Table::print(std::ostream& out) const {
  std::vector<std::size_t> width;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    width.push_back(columns[i].size());
    for (const Row& row : rows) width.back() = std::max(width.back(), row[i].size());
  }
  const auto print_row = [&](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool right = !rows.empty() && is_number(rows.front()[i]);
      const bool last = i + 1 == row.size();
      out << (right ? std::right : std::left);
      out << std::setw(right || !last ? static_cast<int>(width[i]) : 0) << row[i] << (last ? "\n" : "  ");
    }
  };
  print_row(columns);
  for (const Row& row : rows) print_row(row);
  out.flush();
}

void Table::write_csv(std::ostream& out) const {
  write_row(out, columns);
  for (const Row& row : rows) write_row(out, row);
}

std::string scientific(double value, int digits) {
  if (std::isnan(value)) return "nan";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*e", digits - 1, value);
  return text.data();
}

std::string shortest(double value) {
  std::array<char, 40> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string shortest_power(double value) {
  std::array<char, 40> text{};
  const auto format = std::chars_format::scientific;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format).ptr};
}

}  // namespace dalembert::bench
