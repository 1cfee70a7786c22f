#pragma once

#include <memory>

namespace dalembert::detail {

/// A batch of elements that is copied with what holds it.
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
  [[nodiscard]] const Batch* operator->() const { return batch_.get(); }

 private:
  std::unique_ptr<Batch> batch_;
};

}  // namespace dalembert::detail
