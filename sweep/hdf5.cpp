#include "dalembert/sweep/hdf5.h"

#include <dalembert/core/errors.h>

#include <algorithm>

namespace dalembert::hdf5 {

namespace {

/// The innermost message of HDF5, which says most.
std::string last_message() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
        if (error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
        return 1;  // the first is enough
      },
      &text);
  return text.empty() ? "" : ": " + text;
}

}  // namespace

Handle::Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
  if (id < 0) throw Error(what + last_message());
}

void Handle::close(const std::string& what) { check(close_(std::exchange(id_, H5I_INVALID_HID)), what); }

void check(herr_t status, const std::string& what) {
  if (status < 0) throw Error(what + last_message());
}

Handle open_file(const std::string& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path + " cannot be read as HDF5"};
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a type of HDF5 cannot be made");
  check(H5Tset_size(type, std::max<std::size_t>(size, 1)), "a type of HDF5 cannot be made");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "a type of HDF5 cannot be made");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "a type of HDF5 cannot be made");
  return type;
}

Handle compound(std::size_t size) {
  return {H5Tcreate(H5T_COMPOUND, size), H5Tclose, "a type of HDF5 cannot be made"};
}

}  // namespace dalembert::hdf5
