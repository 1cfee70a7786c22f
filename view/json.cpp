#include "dalembert/view/json.h"

#include <array>

namespace dalembert {

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

void Json::value(std::string_view text) {
  separate();
  out_ << '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out_ << '\\' << c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == '<' || c == '>' || c == '&') {
      constexpr std::string_view digits = "0123456789abcdef";
      const auto code = static_cast<unsigned char>(c);
      out_ << "\\u00" << digits[code / 16] << digits[code % 16];
    } else {
      out_ << c;
    }
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
