#include "dalembert/sweep/runs.h"

#include <dalembert/core/errors.h>
#include <dalembert/sweep/hdf5.h>

#include <string_view>

namespace dalembert {

namespace {

/// A dataset of a file, and how many records it has.
struct Open {
  hdf5::Handle file, data;
  std::size_t count = 0;

  Open(const std::string& path, const std::string& name)
      : file(hdf5::open_file(path)),
        data(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, path + ": no " + name) {
    const hdf5::Handle space(H5Dget_space(data), H5Sclose, path);
    count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  }

  /// One field of all records, without gaps.
  void read(const std::string& field, hid_t type, void* out) const {
    const hdf5::Handle record = hdf5::compound(H5Tget_size(type));
    hdf5::check(H5Tinsert(record, field.c_str(), 0, type), field);
    hdf5::check(H5Dread(data, record, H5S_ALL, H5S_ALL, H5P_DEFAULT, out),
                "column \"" + field + "\" cannot be read");
  }
  /// The type of a field; throws if there is none.
  [[nodiscard]] hdf5::Handle type_of(const std::string& field) const {
    const hdf5::Handle record(H5Dget_type(data), H5Tclose, field);
    const int member = H5Tget_member_index(record, field.c_str());
    if (member < 0) throw Error("there is no column \"" + field + '"');
    return {H5Tget_member_type(record, static_cast<unsigned>(member)), H5Tclose, field};
  }
};

}  // namespace

std::vector<double> read_column(const std::string& file, const std::string& name) {
  const hdf5::Silence silence;
  const Open runs(file, "runs");
  [[maybe_unused]] const hdf5::Handle there = runs.type_of(name);
  std::vector<double> values(runs.count);
  runs.read(name, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<FailedRow> read_failures(const std::string& file) {
  const hdf5::Silence silence;
  const Open failures(file, "failures");
  const hdf5::Handle text = failures.type_of("error");
  const std::size_t width = H5Tget_size(text);
  std::vector<std::int64_t> rows(failures.count);
  std::vector<double> times(failures.count);
  std::string errors(failures.count * width, '\0');
  if (failures.count > 0) {
    failures.read("row", H5T_NATIVE_INT64, rows.data());
    failures.read("time", H5T_NATIVE_DOUBLE, times.data());
    failures.read("error", text, errors.data());
  }
  std::vector<FailedRow> list;
  for (std::size_t i = 0; i < failures.count; ++i) {
    const std::string_view padded = std::string_view(errors).substr(i * width, width);
    list.push_back({rows[i], times[i], std::string(padded.substr(0, padded.find('\0')))});
  }
  return list;
}

std::string read_about(const std::string& file, const std::string& what) {
  const hdf5::Silence silence;
  const Open text(file, "about/" + what);
  const hdf5::Handle type(H5Dget_type(text.data), H5Tclose, what);
  std::string content(H5Tget_size(type), '\0');
  hdf5::check(H5Dread(text.data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.data()), "about/" + what);
  return content.c_str();
}

}  // namespace dalembert
