#pragma once

#include <cstdint>
#include <memory>
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

/// A batch of elements that is copied with the scene which holds it.
template <class Batch>
class Owned {
 public:
  explicit Owned(std::unique_ptr<Batch> batch) : batch_(std::move(batch)) {}
  Owned(const Owned& other) : batch_(other.batch_->clone()) {}
  Owned(Owned&&) noexcept = default;
  Owned& operator=(const Owned& other) { return *this = Owned(other); }
  Owned& operator=(Owned&&) noexcept = default;
  ~Owned() = default;

  [[nodiscard]] Batch& operator*() { return *batch_; }
  [[nodiscard]] const Batch& operator*() const { return *batch_; }
  [[nodiscard]] const Batch* operator->() const { return batch_.get(); }

 private:
  std::unique_ptr<Batch> batch_;
};

}  // namespace dalembert::detail
