#include "dalembert/sweep/dataset.h"

#include <dalembert/core/errors.h>
#include <dalembert/sweep/hdf5.h>
#include <dalembert/sweep/hdf5_table.h>
#include <dalembert/sweep/text.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

namespace dalembert {

namespace {

constexpr int format = 1;  ///< of the dataset, as docs/sweeps.md has it
constexpr std::uint8_t not_done = 0, row_done = 1, row_failed = 2;

void put_attribute(hid_t file, const char* name, std::int64_t value) {
  const std::string what = std::string("attribute ") + name + " cannot be written";
  const hdf5::Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const hdf5::Handle attribute(H5Acreate2(file, name, H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, what);
  hdf5::check(H5Awrite(attribute, H5T_NATIVE_INT64, &value), what);
}

std::int64_t attribute(hid_t file, const char* name) {
  const hdf5::Handle found(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, std::string("there is no ") + name);
  std::int64_t value = 0;
  hdf5::check(H5Aread(found, H5T_NATIVE_INT64, &value), std::string(name) + " cannot be read");
  return value;
}

/// The header as texts, in its order.
void put_about(hid_t file, const Header& header) {
  const std::string what = "group \"about\" cannot be written";
  const hdf5::Handle group(H5Gcreate2(file, "about", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, what);
  const hdf5::Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const hdf5::Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  hdf5::check(H5Pset_obj_track_times(how, false), what);
  for (const auto& [name, content] : header) {
    const hdf5::Handle type = hdf5::text_type(content.size());
    const hdf5::Handle text(H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT),
                            H5Dclose, what);
    hdf5::check(H5Dwrite(text, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.empty() ? "" : content.c_str()),
                what);
  }
}

Header about(hid_t file) {
  Header header;
  for (const std::string& name : header_names()) {
    const hdf5::Handle text(H5Dopen2(file, ("about/" + name).c_str(), H5P_DEFAULT), H5Dclose,
                            "no about/" + name);
    const hdf5::Handle type(H5Dget_type(text), H5Tclose, "no type");
    std::string content(H5Tget_size(type), '\0');
    hdf5::check(H5Dread(text, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.data()), "about/" + name);
    header.emplace_back(name, content.c_str());
  }
  return header;
}

/// Names, units and roles of all columns.
void put_columns(hid_t file, const Parameters& parameters, const RowFunction& row) {
  struct Line {
    std::string name, unit, role;
  };
  std::vector<Line> lines;
  const auto add = [&lines](const std::vector<Quantity>& columns, const char* role) {
    for (const Quantity& column : columns) lines.push_back({column.name, column.unit, role});
  };
  add(parameters.columns(), "parameter");
  add(row.quantities, "result");
  add(row.series, "series");
  const auto widest = [&lines](std::string Line::*part) {
    std::size_t size = 1;
    for (const Line& line : lines) size = std::max(size, (line.*part).size());
    return size;
  };
  const std::size_t name = widest(&Line::name), unit = widest(&Line::unit), role = widest(&Line::role);
  const hdf5::Handle names = hdf5::text_type(name), units = hdf5::text_type(unit),
                     roles = hdf5::text_type(role);
  hdf5::Table table(file, "columns", {{{"name", names}, {"unit", units}, {"role", roles}}}, lines.size());
  for (const Line& line : lines) {
    table.put(line.name, name);
    table.put(line.unit, unit);
    table.put(line.role, role);
  }
  table.close();
}

/// All sums that the tables' sizes follow from.
struct Totals {
  std::uint64_t done = 0, failed = 0, samples = 0;
  std::size_t message = 1;  ///< the longest
};

Totals totals_of(const Dataset& dataset, Widths widths) {
  Totals totals;
  BlockRow row;
  for (const auto& entry : dataset.entries) {
    totals.done += entry.rows.count;
    totals.failed += entry.failures;
    totals.samples += entry.samples;
    if (entry.failures == 0) continue;
    const std::string bytes = dataset.journal.read(entry);
    for (BlockReader reader(bytes, widths); !reader.at_end();) {
      reader.next(row);
      totals.message = std::max(totals.message, row.message.size());
    }
  }
  return totals;
}

/// Writes runs, failures and series side by side, in the order of rows.
class Writer {
 public:
  Writer(hid_t file, const Dataset& dataset, Widths widths, const Totals& totals)
      : dataset_(dataset),
        widths_(widths),
        message_(totals.message),
        message_type_(hdf5::text_type(totals.message)),
        runs_(file, "runs", runs_record(dataset), dataset.parameters.rows()),
        failures_(file, "failures",
                  {{{"row", H5T_NATIVE_INT64}, {"time", H5T_NATIVE_DOUBLE}, {"error", message_type_}}},
                  totals.failed),
        parameters_(dataset.parameters.columns().size()),
        nothing_(dataset.row.quantities.size(), std::numeric_limits<double>::quiet_NaN()) {
    if (widths.series > 0) series_.emplace_back(file, "series", series_record(dataset), totals.samples);
  }

  void write() {
    for (const auto& entry : dataset_.entries) {
      while (row_ < entry.rows.first) put_run(not_done, nothing_, 0);
      const std::string bytes = dataset_.journal.read(entry);
      BlockRow row;
      for (BlockReader reader(bytes, widths_); !reader.at_end();) {
        reader.next(row);
        put(row);
      }
    }
    while (row_ < dataset_.parameters.rows()) put_run(not_done, nothing_, 0);
    runs_.close();
    failures_.close();
    for (hdf5::Table& series : series_) series.close();
  }

 private:
  static hdf5::RecordType runs_record(const Dataset& dataset) {
    hdf5::RecordType record;
    record.add(dataset.parameters.columns());
    record.add(dataset.row.quantities);
    if (!dataset.row.series.empty()) {
      record.fields.push_back({"first_sample", H5T_NATIVE_INT64});
      record.fields.push_back({"samples", H5T_NATIVE_INT64});
    }
    record.fields.push_back({"state", H5T_NATIVE_UINT8});
    return record;
  }
  static hdf5::RecordType series_record(const Dataset& dataset) {
    hdf5::RecordType record;
    record.add(dataset.row.series);
    return record;
  }

  void put(const BlockRow& row) {
    if (row.failed) {
      failures_.put(static_cast<std::int64_t>(row_));
      failures_.put(row.time);
      failures_.put(row.message, message_);
      return put_run(row_failed, nothing_, 0);
    }
    for (hdf5::Table& series : series_) series.put(row.series);
    put_run(row_done, row.values, widths_.series > 0 ? row.series.size() / widths_.series : 0);
  }
  void put_run(std::uint8_t state, const std::vector<double>& values, std::uint64_t samples) {
    dataset_.parameters.fill(row_, parameters_);
    runs_.put(parameters_);
    runs_.put(values);
    if (!series_.empty()) {
      runs_.put(static_cast<std::int64_t>(samples_));
      runs_.put(static_cast<std::int64_t>(samples));
    }
    runs_.put(state);
    samples_ += samples;
    ++row_;
  }

  const Dataset& dataset_;
  Widths widths_;
  std::size_t message_;
  hdf5::Handle message_type_;
  hdf5::Table runs_, failures_;
  std::vector<hdf5::Table> series_{};  ///< one, or none
  std::vector<double> parameters_, nothing_;
  std::uint64_t row_ = 0, samples_ = 0;
};

/// The space on the disk, before HDF5 begins: it cannot be relied on to take a full one well.
void reserve(const std::string& path, std::uint64_t bytes) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const int opened = file < 0 ? errno : 0;
  int error = opened;
  if (file >= 0) {
    if (fallocate(file, 0, 0, static_cast<off_t>(bytes)) != 0 && errno != EOPNOTSUPP) error = errno;
    close(file);
  }
  if (error != 0) throw Error(path + " cannot be written: " + std::generic_category().message(error));
}

void sync(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool good = file >= 0 && fsync(file) == 0;
  const int error = errno;
  if (file >= 0) close(file);
  if (!good && error != EINVAL)
    throw Error(path + " cannot be written: " + std::generic_category().message(error));
}

void write_file(const std::string& path, const Dataset& dataset, Widths widths, const Totals& totals) {
  const hdf5::Silence silence;
  hdf5::Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                    path + " cannot be made");
  put_attribute(file, "dalembert_sweep", format);
  put_attribute(file, "rows", static_cast<std::int64_t>(dataset.parameters.rows()));
  put_attribute(file, "done", static_cast<std::int64_t>(totals.done));
  put_attribute(file, "failed", static_cast<std::int64_t>(totals.failed));
  put_attribute(file, "complete", totals.done == dataset.parameters.rows() ? 1 : 0);
  put_about(file, dataset.header);
  put_columns(file, dataset.parameters, dataset.row);
  Writer(file, dataset, widths, totals).write();
  file.close(path + " cannot be written");
}

}  // namespace

void publish(const std::string& path, Dataset dataset) {
  std::ranges::sort(dataset.entries, {}, [](const auto& entry) { return entry.rows.first; });
  const Widths widths{dataset.row.quantities.size(), dataset.row.series.size()};
  const Totals totals = totals_of(dataset, widths);
  const std::string beside = path + ".new";
  const std::size_t columns = dataset.parameters.columns().size() + widths.values + 3;
  const std::size_t about = packed(dataset.header).size() + (std::size_t{1} << 16) + 200 * columns;
  try {
    reserve(beside,
            about + sizeof(double) * (columns * dataset.parameters.rows() + widths.series * totals.samples) +
                (totals.message + 16) * totals.failed);
    write_file(beside, dataset, widths, totals);
    sync(beside);
    std::filesystem::rename(beside, path);
    sync(std::filesystem::absolute(path).parent_path());
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw Error(std::string(error.what()) + "; all rows that are done are safe in the journal of " + path +
                ", the same command goes on from there");
  }
}

Published published(const std::string& path) {
  const hdf5::Silence silence;
  try {
    const hdf5::Handle file = hdf5::open_file(path);
    if (attribute(file, "dalembert_sweep") != format) throw Error("its format is that of another version");
    Published found;
    found.done = static_cast<std::uint64_t>(attribute(file, "done"));
    found.failed = static_cast<std::uint64_t>(attribute(file, "failed"));
    found.complete = attribute(file, "complete") != 0;
    found.header = about(file);
    return found;
  } catch (const Error& error) {
    throw Error(path + " is no dataset of a sweep, and stays as it is (" + error.what() +
                "); give the sweep another file");
  }
}

std::vector<double> published_values(const std::string& path, const std::vector<Quantity>& quantities,
                                     std::uint64_t row) {
  std::vector<double> values(quantities.size());
  if (values.empty()) return values;
  const hdf5::Silence silence;
  const std::string what = path + ": its table of runs cannot be read";
  const hdf5::Handle file = hdf5::open_file(path), runs(H5Dopen2(file, "runs", H5P_DEFAULT), H5Dclose, what),
                     all(H5Dget_space(runs), H5Sclose, what);
  const hsize_t first = row, count = 1;
  hdf5::check(H5Sselect_hyperslab(all, H5S_SELECT_SET, &first, nullptr, &count, nullptr), what);
  const hdf5::Handle one(H5Screate_simple(1, &count, nullptr), H5Sclose, what);
  hdf5::RecordType record;  // HDF5 looks fields up by their names
  record.add(quantities);
  hdf5::check(H5Dread(runs, record.type(), one, all, H5P_DEFAULT, values.data()), what);
  return values;
}

}  // namespace dalembert
