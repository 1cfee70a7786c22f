#include "dalembert/view/json.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace dalembert {

namespace {

bool within(char c, unsigned least, unsigned most) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= least && byte <= most;
}

/// Of how many bytes the character is that the text begins with; 0 where it is not UTF-8 (RFC 3629, 4).
std::size_t bytes_of_character(std::string_view text) {
  struct Form {
    unsigned char first, last;  // of the first byte
    unsigned char least, most;  // of the second
    std::size_t bytes;
  };
  constexpr Form forms[] = {
      {0x00, 0x7f, 0x00, 0x00, 1}, {0xc2, 0xdf, 0x80, 0xbf, 2}, {0xe0, 0xe0, 0xa0, 0xbf, 3},
      {0xe1, 0xec, 0x80, 0xbf, 3}, {0xed, 0xed, 0x80, 0x9f, 3}, {0xee, 0xef, 0x80, 0xbf, 3},
      {0xf0, 0xf0, 0x90, 0xbf, 4}, {0xf1, 0xf3, 0x80, 0xbf, 4}, {0xf4, 0xf4, 0x80, 0x8f, 4}};
  for (const Form& form : forms) {
    if (!within(text[0], form.first, form.last) || text.size() < form.bytes) continue;
    bool fits = form.bytes == 1 || within(text[1], form.least, form.most);
    for (std::size_t k = 2; k < form.bytes; ++k) fits = fits && within(text[k], 0x80, 0xbf);
    if (fits) return form.bytes;
  }
  return 0;
}

}  // namespace

void Json::separate() {
  if (!first_) out_ << ',';
  first_ = false;
}

void Json::put(std::string_view text) {
  separate();
  out_ << text;
}

void Json::key(std::string_view name) {
  value(name);
  out_ << ':';
  first_ = true;
}

void Json::open(char bracket) {
  separate();
  out_ << bracket;
  first_ = true;
}

void Json::close(char bracket) {
  out_ << bracket;
  first_ = false;
}

/// JSON is UTF-8: a byte that is not becomes U+FFFD, as readers show it.
void Json::value(std::string_view text) {
  separate();
  out_ << '"';
  while (!text.empty()) {
    const char c = text[0];
    const std::size_t bytes = bytes_of_character(text);
    if (bytes == 0) {
      out_ << "\\ufffd";
    } else if (c == '"' || c == '\\') {
      out_ << '\\' << c;
    } else if (within(c, 0x00, 0x1f) || c == '<' || c == '>' || c == '&') {
      constexpr std::string_view digits = "0123456789abcdef";
      const auto code = static_cast<unsigned char>(c);
      out_ << "\\u00" << digits[code / 16] << digits[code % 16];
    } else {
      out_ << text.substr(0, bytes);
    }
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  out_ << '"';
}

void Json::value(double number) {
  if (!std::isfinite(number)) return put("null");
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  put({text.data(), static_cast<std::size_t>(end - text.data())});
}

}  // namespace dalembert
