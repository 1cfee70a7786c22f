#include <dalembert/sweep/sweep.h>
#include <dalembert/sweep/text.h>

#include <boost/crc.hpp>

#include <cmath>

namespace dalembert::detail {

RowResult row_result(RowResult result) { return result; }

RowResult row_result(double value) { return {{value}, {}}; }

std::string description(const std::string& scene, const Options& run) {
  std::string line = scene;
  line += "\nrun: t " + as_text(run.t_start) + " to " + as_text(run.t_end) + ", tolerance " +
          as_text(run.tolerance) + ", " + name(run.stepper);
  if (!run.times.empty()) {
    boost::crc_32_type sum;
    sum.process_bytes(run.times.data(), run.times.size() * sizeof(double));
    line += ", " + as_text(run.times.size()) + " samples, checksum " + as_text(sum.checksum());
  } else if (run.sample_interval > 0.0) {
    line += ", samples every " + as_text(run.sample_interval);
  } else {
    line += ", " + as_text(run.samples) + " samples";
  }
  line += ", max_step " + as_text(run.max_step) + ", max_steps " + as_text(run.max_steps) + ", length " +
          as_text(run.length);
  line += std::string(run.assemble ? ", assembled" : "") + (run.dense ? ", dense" : "") +
          (run.ledger ? ", ledger" : "");
  line += run.audit == Audited::error ? "" : run.audit == Audited::report ? ", audit reported" : ", no audit";
  return line + '\n';
}

Row first_row(const Parameters& parameters, std::vector<double>& values) {
  values.resize(parameters.columns().size());
  parameters.fill(0, values);
  return {0, parameters.columns(), values};
}

template <int D>
std::vector<Quantity> trajectory_columns(const Scene<D>& scene) {
  const System system = scene.system();
  const Layout& layout = *system.layout();
  std::vector<Quantity> columns{{"t"}};
  for (const char* of : {"", "v"}) {
    for (const auto& particle : layout.particles)
      for (int k = 0; k < D; ++k) columns.push_back({particle.name + '.' + of + "xyz"[k]});
    for (const auto& rotor : layout.rotors)
      columns.push_back({rotor.name + (*of == 'v' ? ".rate" : ".angle")});
  }
  for (const auto& constraint : layout.constraints)
    for (int k = 0; k < constraint.rows; ++k)
      columns.push_back({constraint.name + ".lambda" + (constraint.rows > 1 ? std::to_string(k + 1) : "")});
  return columns;
}

/// Particles and rotors in the order of their names above, whatever that of their coordinates.
template <int D>
RowResult flattened(const Trajectory<D>& run) {
  RowResult result;
  for (const Sample<D>& sample : run) {
    const FlatSample& flat = sample.flat();
    result.series.push_back(flat.time);
    for (const auto& part : {flat.q, flat.v}) {
      for (const auto& particle : sample.layout().particles)
        for (int k = 0; k < D; ++k)
          result.series.push_back(part[static_cast<std::size_t>(particle.coordinate + k)]);
      for (const auto& rotor : sample.layout().rotors)
        result.series.push_back(part[static_cast<std::size_t>(rotor.coordinate)]);
    }
    for (const double lambda : flat.lambda) result.series.push_back(lambda);
  }
  return result;
}

template std::vector<Quantity> trajectory_columns(const Scene<2>&);
template std::vector<Quantity> trajectory_columns(const Scene<3>&);
template RowResult flattened(const Trajectory<2>&);
template RowResult flattened(const Trajectory<3>&);

}  // namespace dalembert::detail
