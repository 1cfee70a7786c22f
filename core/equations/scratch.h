#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace dalembert::detail {

/// Room for numbers of which nothing is set: on the stack for a few, else in memory that its thread keeps
/// from use to use, so that no evaluation allocates after the first. (An equation may evaluate others: who
/// uses that memory takes it away and gives it back. What has a Scratch among its members needs a
/// constructor: compilers set an aggregate to 0 first, with all its room.)
class Scratch {
 public:
  /// Of so many bytes in all, if those taken have sizes that are multiples of 16.
  explicit Scratch(std::size_t size) {
    if (size > sizeof(few_)) next_ = take_kept(size);
  }
  ~Scratch() {
    if (!many_.empty()) give_back();
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  template <class T>
  [[nodiscard]] static constexpr std::size_t size_of(std::size_t count) {
    return (count * sizeof(T) + 15) / 16 * 16;
  }
  template <class T>
  [[nodiscard]] T* take(std::size_t count) {
    static_assert(alignof(T) <= 16);
    return reinterpret_cast<T*>(std::exchange(next_, next_ + size_of<T>(count)));
  }

 private:
  // Not inlined: it would be compiled into every evaluation, few of which need it.
  [[gnu::noinline]] std::byte* take_kept(std::size_t size) {
    if (!kept().empty()) {
      many_ = std::move(kept().back());
      kept().pop_back();
    }
    if (many_.size() < size) many_.resize(size);
    return many_.data();
  }
  [[gnu::noinline]] void give_back() {
    if (kept().size() < kept().capacity()) kept().push_back(std::move(many_));
  }
  [[nodiscard]] static std::vector<std::vector<std::byte>>& kept() {
    constexpr std::size_t most = 8;  // what equations within equations use beyond these is not kept
    thread_local std::vector<std::vector<std::byte>> memory = [] {
      std::vector<std::vector<std::byte>> none;
      none.reserve(most);
      return none;
    }();
    return memory;
  }

  alignas(16) std::byte few_[8192];
  std::vector<std::byte> many_;
  std::byte* next_ = few_;
};

}  // namespace dalembert::detail
