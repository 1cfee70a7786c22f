#include "dalembert/sweep/block.h"

#include <dalembert/core/errors.h>

#include <cstring>

namespace dalembert {

namespace {

constexpr char done = 1, failed = 2;
/// A message is for a reader; a row stays a row.
constexpr std::size_t longest_message = 1000;

template <class Number>
void put(std::string& bytes, std::span<const Number> numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

template <class Number>
void put(std::string& bytes, Number number) {
  put(bytes, std::span<const Number>(&number, 1));
}

/// Cut between characters of UTF-8, whose later bytes are 10xxxxxx.
std::string_view cut(std::string_view message) {
  if (message.size() <= longest_message) return message;
  std::size_t end = longest_message;
  while (end > 0 && (static_cast<unsigned char>(message[end]) & 0xC0U) == 0x80U) --end;
  return message.substr(0, end);
}

}  // namespace

void Block::add(std::span<const double> values, std::span<const double> series, Widths widths) {
  bytes.push_back(done);
  put(bytes, values);
  if (widths.series > 0) {
    const std::uint64_t count = series.size() / widths.series;
    put(bytes, count);
    put(bytes, series);
    samples += count;
  }
  ++rows.count;
}

void Block::add_failure(double time, std::string_view message) {
  message = cut(message);
  bytes.push_back(failed);
  put(bytes, time);
  put(bytes, static_cast<std::uint32_t>(message.size()));
  bytes.append(message);
  ++failures;
  ++rows.count;
}

std::string_view BlockReader::take(std::size_t count) {
  if (count > rest_.size()) throw Error("journal of a sweep: a block of rows ends too early");
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

template <class Number>
Number BlockReader::number() {
  Number value;
  std::memcpy(&value, take(sizeof value).data(), sizeof value);
  return value;
}

void BlockReader::numbers(std::vector<double>& out, std::size_t count) {
  const std::string_view taken = take(count * sizeof(double));
  out.resize(count);
  if (count > 0) std::memcpy(out.data(), taken.data(), taken.size());
}

void BlockReader::next(BlockRow& row) {
  row.failed = take(1).front() == failed;
  row.values.clear();
  row.series.clear();
  row.message.clear();
  if (row.failed) {
    row.time = number<double>();
    row.message = take(number<std::uint32_t>());
  } else {
    numbers(row.values, widths_.values);
    if (widths_.series > 0) numbers(row.series, number<std::uint64_t>() * widths_.series);
  }
}

}  // namespace dalembert
