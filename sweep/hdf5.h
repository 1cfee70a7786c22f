#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <hdf5.h>

#include <string>
#include <utility>

namespace DALEMBERT_HIDDEN dalembert {
namespace hdf5 {

/// An object of HDF5, closed once.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  /// Throws Error that says `what` could not be done if there is none.
  Handle(hid_t id, Close close, const std::string& what);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: as HDF5's functions take it
  /// Now, and throws Error if that goes wrong.
  void close(const std::string& what);

 private:
  hid_t id_;
  Close close_;
};

void check(herr_t status, const std::string& what);

/// HDF5 prints nothing while it lives.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

[[nodiscard]] Handle open_file(const std::string& path);
[[nodiscard]] Handle text_type(std::size_t size);
[[nodiscard]] Handle compound(std::size_t size);

}  // namespace hdf5
}  // namespace dalembert
