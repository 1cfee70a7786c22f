#pragma once

#include <dalembert/sweep/hdf5.h>
#include <dalembert/sweep/parameters.h>

#include <cstdint>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {
namespace hdf5 {

/// A compound type as it is put together, without gaps.
struct RecordType {
  struct Field {
    std::string name;
    hid_t type;
  };
  std::vector<Field> fields{};

  void add(const std::vector<Quantity>& columns);
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] Handle type() const;
};

/// A table of HDF5 that is written from its first record to its last, through a buffer.
class Table {
 public:
  Table(hid_t file, const std::string& name, const RecordType& record, std::uint64_t count);

  /// The next field of the record, or all of it.
  template <class Number>
  void put(const Number& number) {
    put(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void put(const std::vector<double>& numbers) {
    put(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
  }
  /// Zeros behind it, to this size.
  void put(const std::string& text, std::size_t size);
  /// Throws Error if it cannot be written, or has not as many records as were announced.
  void close();

 private:
  [[nodiscard]] Handle make(hid_t file, const std::string& name) const;
  void put(const char* bytes, std::size_t count);
  void flush();

  std::string name_;
  hsize_t count_, written_ = 0;
  std::size_t size_;
  Handle type_, data_;
  std::string buffer_{};
};

}  // namespace hdf5
}  // namespace dalembert
