#pragma once

#include <cassert>
#include <cstddef>
#include <span>

namespace dalembert {

/// Consecutive places in an array: `for (const std::size_t k : places)`.
class Places {
 public:
  Places(std::size_t first, std::size_t last) : first_(first), last_(last) {}
  /// So many from the first on.
  static Places from(std::size_t first, std::size_t count) { return {first, first + count}; }

  struct Iterator {
    std::size_t k;
    std::size_t operator*() const { return k; }
    Iterator& operator++() {
      ++k;
      return *this;
    }
    bool operator==(const Iterator&) const = default;
  };
  [[nodiscard]] Iterator begin() const { return {first_}; }
  [[nodiscard]] Iterator end() const { return {last_}; }
  [[nodiscard]] std::size_t front() const { return first_; }
  [[nodiscard]] std::size_t size() const { return last_ - first_; }
  /// Those of an array.
  template <class T>
  [[nodiscard]] std::span<T> in(std::span<T> array) const {
    assert(last_ <= array.size());
    return {array.data() + first_, size()};  // subspan would ask for dynamic_extent
  }

 private:
  std::size_t first_, last_;
};

}  // namespace dalembert
