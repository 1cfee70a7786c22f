#include "dalembert/core/trajectory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <ostream>

namespace dalembert {

namespace {

constexpr const char* axis = "xyz";

/// Particles that a constraint acts on, in the scene's order.
template <int D>
std::vector<Particle<D>> acted_on(const Layout& layout, const Layout::Constraint& constraint) {
  std::vector<Particle<D>> result;
  for (std::size_t p = 0; p < layout.particles.size(); ++p) {
    const int first = layout.particles[p].coordinate;
    const auto slots = std::span(layout.slot_coordinate)
                           .subspan(static_cast<std::size_t>(constraint.first_slot),
                                    static_cast<std::size_t>(constraint.width));
    if (std::ranges::any_of(slots, [&](int c) { return c >= first && c < first + D; })) {
      result.push_back({static_cast<int>(p), first, layout.id});
    }
  }
  return result;
}

/// A column's name, in quotes where it needs them (RFC 4180).
std::string column(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void write_preamble(std::ostream& out, const Record& record) {
  out << "# dalembert " << DALEMBERT_VERSION << ", scene \"" << record.layout->scene << "\", stepper "
      << record.stepper << ", tolerance " << record.tolerance << '\n'
      << "# sign convention: M q'' = F + Z, force of constraint Z = +W^T lambda; units: the scene's own\n"
      << "# " << record.statistics.report() << '\n';
}

template <int D>
void write_header(std::ostream& out, const Layout& layout) {
  out << 't';
  for (const auto& p : layout.particles) {
    for (const char* quantity : {".", ".v"}) {
      for (int k = 0; k < D; ++k) out << ',' << column(p.name + quantity + axis[k]);
    }
  }
  for (const auto& c : layout.constraints) {
    for (int k = 0; k < c.rows; ++k) {
      out << ',' << column(c.name + ".lambda" + (c.rows > 1 ? std::to_string(k + 1) : ""));
    }
    for (const auto& p : acted_on<D>(layout, c)) {
      for (int k = 0; k < D; ++k) {
        out << ','
            << column(c.name + ".on." + layout.particles[static_cast<std::size_t>(p.index)].name + ".Z" +
                      axis[k]);
      }
    }
  }
  out << ",energy\n";
}

}  // namespace

template <int D>
void Trajectory<D>::write_csv(std::ostream& out) const {
  const Layout& layout = *record_->layout;
  write_preamble(out, *record_);
  const auto digits = out.precision(std::numeric_limits<double>::max_digits10);
  write_header<D>(out, layout);
  std::vector<std::vector<Particle<D>>> on;
  for (const auto& c : layout.constraints) on.push_back(acted_on<D>(layout, c));
  const auto write = [&out](const Vec<D>& r) {
    for (int k = 0; k < D; ++k) out << ',' << r[k];
  };
  for (std::size_t i = 0; i < size(); ++i) {
    const Sample<D> now = sample(i);
    out << now.time();
    for (std::size_t p = 0; p < layout.particles.size(); ++p) {
      const Particle<D> particle{static_cast<int>(p), layout.particles[p].coordinate, layout.id};
      write(now.position(particle));
      write(now.velocity(particle));
    }
    for (std::size_t c = 0; c < layout.constraints.size(); ++c) {
      const auto& info = layout.constraints[c];
      for (int k = 0; k < info.rows; ++k)
        out << ',' << now.flat().lambda[static_cast<std::size_t>(info.first_row + k)];
      const Constraint<1> handle{static_cast<int>(c), layout.id};
      for (const auto& particle : on[c]) write(now.constraint_force(handle, particle));
    }
    out << ',' << now.energy() << '\n';
  }
  out.precision(digits);
}

template <int D>
void Trajectory<D>::write_csv(const std::string& path) const {
  std::ofstream file(path);
  write_csv(file);
  file.flush();
  if (!file)
    throw Error("Cannot write the trajectory to \"" + path +
                "\": check that the folder exists and is writable");
}

template void Trajectory<2>::write_csv(std::ostream&) const;
template void Trajectory<3>::write_csv(std::ostream&) const;
template void Trajectory<2>::write_csv(const std::string&) const;
template void Trajectory<3>::write_csv(const std::string&) const;

}  // namespace dalembert
