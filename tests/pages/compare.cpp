#include "pages/compare.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace pages {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(' ') != std::string::npos) lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// Whether a word begins with a number; `rest` is what follows it.
bool is_number(const std::string& word, double& value, std::string& rest) {
  char* end = nullptr;
  value = std::strtod(word.c_str(), &end);
  rest = end;
  return end != word.c_str();
}

/// One unit of the last digit shown: of 1.25e-3 it is 1e-5.
double last_digit(const std::string& word) {
  const std::size_t exponent = word.find_first_of("eE");
  const std::string digits = word.substr(0, exponent);
  const std::size_t point = digits.find('.');
  const double decimals =
      point == std::string::npos ? 0.0 : static_cast<double>(digits.find_last_of("0123456789") - point);
  const double power =
      exponent == std::string::npos ? 0.0 : std::strtod(word.c_str() + exponent + 1, nullptr);
  return std::pow(10.0, power - decimals);
}

bool same_word(const std::string& shown, const std::string& printed, bool is_error) {
  if (shown == printed) return true;
  if (shown.front() == '(' && printed.front() == '(')
    return same_word(shown.substr(1), printed.substr(1), is_error);
  double a = 0.0, b = 0.0;
  std::string after_a, after_b;
  if (!is_number(shown, a, after_a) || !is_number(printed, b, after_b) || after_a != after_b) return false;
  if (is_error) return a < 3.0 * b && b < 3.0 * a;
  return std::abs(a - b) <= 2.01 * last_digit(shown);
}

bool same_line(const std::string& shown, const std::string& printed) {
  const std::vector<std::string> a = words_of(shown), b = words_of(printed);
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same_word(a[i], b[i], i > 0 && a[i - 1] == "+-")) return false;
  }
  return true;
}

}  // namespace

std::string difference(std::string_view shown, std::string_view printed) {
  const std::vector<std::string> a = lines_of(shown), b = lines_of(printed);
  std::size_t at = 0;
  bool anywhere = false;  // behind a line "..."
  for (const std::string& line : a) {
    if (line == "...") {
      anywhere = true;
      continue;
    }
    const std::size_t first = at;
    while (anywhere && at < b.size() && !same_line(line, b[at])) ++at;
    if (at == b.size() || !same_line(line, b[at]))
      return "the page shows \"" + line + "\", the program prints \"" +
             (first < b.size() ? b[first] : "nothing more") + '"';
    ++at;
    anywhere = false;
  }
  if (at < b.size() && !anywhere) return "the page does not show the line \"" + b[at] + '"';
  return {};
}

}  // namespace pages
