#include "dalembert/view/columns.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>

namespace dalembert {

namespace {

/// Base64 (RFC 4648) of bytes as they come.
class Base64 {
 public:
  explicit Base64(std::ostream& out) : out_(out) {}

  void put(std::uint8_t byte) {
    bits_ = (bits_ << 8U) | byte;
    if (++pending_ == 3) flush();
  }
  void end() {
    if (pending_ == 0) return;
    const std::size_t missing = 3 - pending_;
    for (std::size_t k = 0; k < missing; ++k) bits_ <<= 8U;
    const std::array<char, 4> text = letters();
    out_.write(text.data(), static_cast<std::streamsize>(4 - missing));
    for (std::size_t k = 0; k < missing; ++k) out_ << '=';
  }

 private:
  [[nodiscard]] std::array<char, 4> letters() const {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    return {alphabet[(bits_ >> 18U) & 63U], alphabet[(bits_ >> 12U) & 63U], alphabet[(bits_ >> 6U) & 63U],
            alphabet[bits_ & 63U]};
  }
  void flush() {
    const std::array<char, 4> text = letters();
    out_.write(text.data(), text.size());
    bits_ = 0;
    pending_ = 0;
  }

  std::ostream& out_;
  std::uint32_t bits_ = 0;
  std::size_t pending_ = 0;
};

/// Little-endian on any machine.
template <class Bits>
void put_number(Base64& out, Bits bits) {
  for (std::size_t k = 0; k < sizeof(Bits); ++k) out.put(static_cast<std::uint8_t>(bits >> (8U * k)));
}

void write_column(std::ostream& out, std::span<const double> column, Digits digits) {
  Base64 text(out);
  for (const double x : column) {
    if (digits == Digits::sixteen) {
      put_number(text, std::bit_cast<std::uint64_t>(x));
    } else {
      put_number(text, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    }
  }
  text.end();
}

}  // namespace

std::size_t Columns::keep(std::vector<double> column) {
  // To the bit: NaN, too, and -0 is another number.
  const auto same = [&](double x) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(column.front());
  };
  if (!column.empty() && std::ranges::all_of(column, same)) column.erase(column.begin() + 1, column.end());
  all_.push_back(std::move(column));
  return all_.size() - 1;
}

std::size_t Columns::bytes(Digits digits) const {
  std::size_t numbers = 0;
  for (const auto& column : all_) numbers += column.size();
  return numbers * static_cast<std::size_t>(digits) * 4 / 3;
}

void Columns::write(Json& json, Digits digits) const {
  json.member("rows", rows_);
  json.member("bytes", static_cast<std::size_t>(digits));
  json.list("columns", all_, [&](const std::vector<double>& column) {
    json.object([&] { json.quoted("data", [&](std::ostream& out) { write_column(out, column, digits); }); });
  });
}

}  // namespace dalembert
