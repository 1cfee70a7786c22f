#include "dalembert/sweep/write_hdf5.h"

#include <dalembert/core/errors.h>
#include <dalembert/core/results/columns.h>
#include <dalembert/sweep/hdf5.h>
#include <dalembert/sweep/hdf5_table.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

namespace dalembert {

namespace {

constexpr std::int64_t layout_of_runs = 1;  ///< as docs/exports.md has it
constexpr double nothing_known = std::numeric_limits<double>::infinity();

/// A column as it is written: at all samples.
struct WrittenColumn {
  std::string name, dimension;
  std::vector<double> values;
};

template <class F>
WrittenColumn at_samples(std::string name, std::string dimension, std::size_t samples, const F& read) {
  WrittenColumn column{std::move(name), std::move(dimension), std::vector<double>(samples)};
  for (std::size_t i = 0; i < samples; ++i) column.values[i] = read(i);
  return column;
}

std::vector<WrittenColumn> columns_of_run(const Record& record) {
  std::vector<WrittenColumn> all;
  for (const Column& column : columns(record))
    all.push_back(at_samples(column.name, column.dimension, record.times.size(),
                             [&](std::size_t i) { return column.read(record.sample(i)); }));
  return all;
}

/// Of the multipliers of a constraint as a vector, see Certificate::multiplier_error.
template <int D>
double multiplier_error(const Certificate<D>& certificate, const Layout::Constraint& c, std::size_t i) {
  const auto read = [&c](const Sample<D>& now) -> Eigen::VectorXd {
    const auto own = c.own_rows().in(now.flat().lambda);
    return Eigen::Map<const Eigen::VectorXd>(own.data(), static_cast<Eigen::Index>(own.size()));
  };
  const TwoRuns& runs = certificate.runs();
  const double error =
      std::max(certificate.error(read, i), runs.error(0.0, runs.largest_force(), runs.sample(i)));
  return std::isnan(error) ? nothing_known : error;  // not determined in one of the runs
}

template <int D>
std::vector<WrittenColumn> columns_of_errors(const Certificate<D>& certificate) {
  const Layout& layout = *certificate.run().record()->layout;
  std::vector<WrittenColumn> all;
  const auto add = [&](const std::string& name, const char* dimension, const auto& error) {
    all.push_back(at_samples(name + ".error", dimension, certificate.run().size(), error));
  };
  int index = 0;
  for (const auto& p : layout.particles) {
    const Particle<D> particle{index++, p.coordinate, p.scene};
    add(p.name + ".position", "length",
        [&](std::size_t i) { return certificate.position_error(particle, i); });
    add(p.name + ".velocity", "length/time",
        [&](std::size_t i) { return certificate.velocity_error(particle, i); });
  }
  index = 0;
  for (const auto& r : layout.rotors) {
    const Rotor rotor{index++, r.coordinate, r.scene};
    add(r.name + ".angle", "angle", [&](std::size_t i) { return certificate.angle_error(rotor, i); });
    add(r.name + ".rate", "angle/time",
        [&](std::size_t i) { return certificate.angular_velocity_error(rotor, i); });
  }
  for (const auto& c : layout.constraints)
    add(c.name + ".lambda", "multiplier", [&](std::size_t i) { return multiplier_error(certificate, c, i); });
  return all;
}

void put_attribute(hid_t object, const std::string& name, const hdf5::Handle& type, const void* value) {
  const std::string what = "attribute " + name + " cannot be written";
  const hdf5::Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const hdf5::Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, what);
  hdf5::check(H5Awrite(attribute, type, value), what);
}
void put_attribute(hid_t object, const std::string& name, const std::string& text) {
  put_attribute(object, name, hdf5::text_type(text.size()), text.empty() ? "" : text.data());
}
void put_attribute(hid_t object, const std::string& name, hid_t native, const void* value) {
  put_attribute(object, name, {H5Tcopy(native), H5Tclose, "a type of HDF5 cannot be made"}, value);
}

/// A group whose members are listed in the order in which they were made.
hdf5::Handle ordered_group(hid_t file, const char* name) {
  const std::string what = std::string("group ") + name + " cannot be made";
  const hdf5::Handle how(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, what);
  hdf5::check(H5Pset_link_creation_order(how, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), what);
  return {H5Gcreate2(file, name, H5P_DEFAULT, how, H5P_DEFAULT), H5Gclose, what};
}

void put(hid_t group, const WrittenColumn& column) {
  if (column.name.find('/') != std::string::npos)
    throw Error("column \"" + column.name +
                "\" cannot be written: a name in HDF5 has no '/'; rename it in the scene, or use write_csv");
  const std::string what = "column \"" + column.name + "\" cannot be written";
  const hsize_t count = column.values.size();
  const hdf5::Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, what);
  const hdf5::Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  hdf5::check(H5Pset_obj_track_times(how, false), what);  // the same bytes at any time
  const hdf5::Handle data(
      H5Dcreate2(group, column.name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT),
      H5Dclose, what);
  hdf5::check(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()), what);
  put_attribute(data, "dimension", column.dimension);
}

/// What happened, when, and to which constraint; `time_error` of the k-th is its estimated error.
void put_events(hid_t file, const Record& record, const std::function<double(std::size_t)>& time_error) {
  const std::size_t word = std::string_view(name(EventKind::rested)).size();  // the longest
  std::size_t widest = 1;
  for (const EventRecord& one : record.events) widest = std::max(widest, record.name_of(one).size());
  const hdf5::Handle what = hdf5::text_type(word), element = hdf5::text_type(widest);
  hdf5::RecordType type{{{"time", H5T_NATIVE_DOUBLE}, {"what", what}, {"of", element}}};
  if (time_error) type.fields.push_back({"time_error", H5T_NATIVE_DOUBLE});
  hdf5::Table table(file, "events", type, record.events.size());
  for (std::size_t k = 0; k < record.events.size(); ++k) {
    table.put(record.events[k].time);
    table.put(std::string(name(record.events[k].kind)), word);
    table.put(record.name_of(record.events[k]), widest);
    if (time_error) table.put(time_error(k));
  }
  table.close();
}

void write(const std::string& path, const Record& record, const std::vector<WrittenColumn>& all,
           const std::function<double(std::size_t)>& time_error = {}) try {
  const hdf5::Silence silence;
  hdf5::Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                    "it cannot be made");
  put_attribute(file, "dalembert_run", H5T_NATIVE_INT64, &layout_of_runs);
  put_attribute(file, "library", "dalembert " DALEMBERT_VERSION);
  put_attribute(file, "scene", record.layout->scene);
  put_attribute(file, "stepper", record.stepper);
  put_attribute(file, "tolerance", H5T_NATIVE_DOUBLE, &record.tolerance);
  put_attribute(file, "statistics", record.statistics.report());
  {
    const hdf5::Handle group = ordered_group(file, "samples");
    for (const WrittenColumn& column : all) put(group, column);
  }
  put_events(file, record, time_error);
  file.close("it cannot be written");
} catch (const Error& error) {
  throw Error("Cannot write the run to \"" + path + "\": " + error.what());
}

}  // namespace

template <int D>
void write_hdf5(const Trajectory<D>& run, const std::string& path) {
  write(path, *run.record(), columns_of_run(*run.record()));
}

template <int D>
void write_hdf5(const Certificate<D>& certificate, const std::string& path) {
  const auto record = certificate.run().record();
  std::vector<WrittenColumn> all = columns_of_run(*record);
  std::ranges::move(columns_of_errors(certificate), std::back_inserter(all));
  write(path, *record, all, [&](std::size_t k) { return certificate.event_time_error(k); });
}

template void write_hdf5(const Trajectory<2>&, const std::string&);
template void write_hdf5(const Trajectory<3>&, const std::string&);
template void write_hdf5(const Certificate<2>&, const std::string&);
template void write_hdf5(const Certificate<3>&, const std::string&);

}  // namespace dalembert
