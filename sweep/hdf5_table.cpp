#include "dalembert/sweep/hdf5_table.h"

#include <dalembert/core/errors.h>

namespace dalembert::hdf5 {

namespace {
constexpr std::size_t buffer_bytes = std::size_t{1} << 20;
}

void RecordType::add(const std::vector<Quantity>& columns) {
  for (const Quantity& column : columns) fields.push_back({column.name, H5T_NATIVE_DOUBLE});
}

std::size_t RecordType::size() const {
  std::size_t sum = 0;
  for (const Field& field : fields) sum += H5Tget_size(field.type);
  return sum;
}

Handle RecordType::type() const {
  Handle record = compound(size());
  std::size_t at = 0;
  for (const Field& field : fields) {
    check(H5Tinsert(record, field.name.c_str(), at, field.type), "column \"" + field.name + '"');
    at += H5Tget_size(field.type);
  }
  return record;
}

Table::Table(hid_t file, const std::string& name, const RecordType& record, std::uint64_t count)
    : name_("table \"" + name + '"'),
      count_(count),
      size_(record.size()),
      type_(record.type()),
      data_(make(file, name)) {}

Handle Table::make(hid_t file, const std::string& name) const {
  const std::string what = name_ + " cannot be made";
  const Handle space(H5Screate_simple(1, &count_, nullptr), H5Sclose, what);
  const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  check(H5Pset_obj_track_times(how, false), what);  // the same bytes at any time
  check(H5Pset_fill_time(how, H5D_FILL_TIME_NEVER), what);
  return {H5Dcreate2(file, name.c_str(), type_, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, what};
}

void Table::put(const std::string& text, std::size_t size) {
  put(text.data(), text.size());
  buffer_.append(size - text.size(), '\0');
}

void Table::put(const char* bytes, std::size_t count) {
  buffer_.append(bytes, count);
  if (buffer_.size() >= buffer_bytes && buffer_.size() % size_ == 0) flush();
}

void Table::flush() {
  const std::string what = name_ + " cannot be written";
  const hsize_t count = buffer_.size() / size_;
  if (count == 0) return;
  const Handle there(H5Dget_space(data_), H5Sclose, what);
  const Handle here(H5Screate_simple(1, &count, nullptr), H5Sclose, what);
  check(H5Sselect_hyperslab(there, H5S_SELECT_SET, &written_, nullptr, &count, nullptr), what);
  check(H5Dwrite(data_, type_, here, there, H5P_DEFAULT, buffer_.data()), what);
  written_ += count;
  buffer_.clear();
}

void Table::close() {
  flush();
  if (written_ != count_) throw Error(name_ + ": the journal has another number of records than it says");
  data_.close(name_ + " cannot be written");
}

}  // namespace dalembert::hdf5
