#pragma once

#include <cstdint>
#include <utility>

namespace dalembert::detail {

/// A number that no other scene of this process has, nor a copy of the scene. It identifies and computes
/// nothing.
class Identity {
 public:
  Identity() = default;
  Identity(const Identity& /*other*/) : Identity() {}
  Identity(Identity&& other) noexcept : number_(std::exchange(other.number_, next())) {}
  Identity& operator=(const Identity& other) { return *this = Identity(other); }
  Identity& operator=(Identity&& other) noexcept {
    number_ = std::exchange(other.number_, next());
    return *this;
  }
  ~Identity() = default;

  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  [[nodiscard]] static std::uint64_t next() noexcept;

  std::uint64_t number_ = next();
};

}  // namespace dalembert::detail
