#include "dalembert/core/results/trajectory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <ostream>

namespace dalembert {

namespace {

/// Names of each coordinate as a position, a velocity and a force: "bob.x", "bob.vx", "bob.Zx".
struct CoordinateNames {
  std::string position, velocity, force;
};

std::vector<CoordinateNames> coordinate_names(const Layout& layout, std::size_t n) {
  std::vector<CoordinateNames> names(n);
  for (const auto& p : layout.particles) {
    for (int k = 0; k < layout.dimension; ++k) {
      const char axis = "xyz"[k];
      names[static_cast<std::size_t>(p.coordinate + k)] = {p.name + '.' + axis, p.name + ".v" + axis,
                                                           p.name + ".Z" + axis};
    }
  }
  for (const auto& r : layout.rotors) {
    names[static_cast<std::size_t>(r.coordinate)] = {r.name + ".angle", r.name + ".rate", r.name + ".torque"};
  }
  return names;
}

/// A column's name, in quotes where it needs them (RFC 4180).
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

/// A column of a constraint's force: the slots that act on one coordinate.
struct ForceColumn {
  int coordinate;
  std::vector<std::size_t> slots;
};

std::vector<ForceColumn> force_columns(const Layout& layout, const Layout::Constraint& c) {
  std::vector<ForceColumn> columns;
  for (const std::size_t slot : c.slots()) {
    const int coordinate = layout.slot_coordinate[slot];
    auto column = std::ranges::find(columns, coordinate, &ForceColumn::coordinate);
    if (column == columns.end()) column = columns.insert(column, {coordinate, {}});
    column->slots.push_back(slot);
  }
  return columns;
}

/// Positions and velocities particle by particle, as a reader expects them: f(coordinate).
template <class F>
void for_each_body(const Layout& layout, const F& f) {
  for (const auto& p : layout.particles) f(static_cast<std::size_t>(p.coordinate), layout.dimension);
  for (const auto& r : layout.rotors) f(static_cast<std::size_t>(r.coordinate), 1);
}

class Writer {
 public:
  Writer(std::ostream& out, const Record& record) : out_(out), record_(record), layout_(*record.layout) {
    for (const auto& c : layout_.constraints) forces_.push_back(force_columns(layout_, c));
  }

  void preamble() {
    out_ << "# dalembert " << DALEMBERT_VERSION << ", scene \"" << layout_.scene << "\", stepper "
         << record_.stepper << ", tolerance " << record_.tolerance << '\n'
         << "# sign convention: M q'' = F + Z, force of constraint Z = +W^T lambda; units: the scene's own\n"
         << "# " << record_.statistics.report() << '\n';
  }

  void header() {
    const auto names = coordinate_names(layout_, record_.coordinates);
    out_ << 't';
    for_each_body(layout_, [&](std::size_t first, int count) {
      const auto own = std::span(names).subspan(first, static_cast<std::size_t>(count));
      for (const auto& name : own) out_ << ',' << quoted(name.position);
      for (const auto& name : own) out_ << ',' << quoted(name.velocity);
    });
    for (std::size_t c = 0; c < layout_.constraints.size(); ++c) {
      const auto& info = layout_.constraints[c];
      for (int k = 0; k < info.rows; ++k) {
        out_ << ',' << quoted(info.name + ".lambda" + (info.rows > 1 ? std::to_string(k + 1) : ""));
      }
      if (!record_.unique.empty()) out_ << ',' << quoted(info.name + ".unique");
      for (const auto& column : forces_[c]) {
        out_ << ',' << quoted(info.name + ".on." + names[static_cast<std::size_t>(column.coordinate)].force);
      }
    }
    out_ << ",energy\n";
  }

  void line(const FlatSample& now) {
    const auto write = [this](std::span<const double> numbers) {
      for (const double x : numbers) out_ << ',' << x;
    };
    out_ << now.time;
    for_each_body(layout_, [&](std::size_t first, int count) {
      write(now.q.subspan(first, static_cast<std::size_t>(count)));
      write(now.v.subspan(first, static_cast<std::size_t>(count)));
    });
    for (std::size_t c = 0; c < layout_.constraints.size(); ++c) {
      const auto& info = layout_.constraints[c];
      write(info.own_rows().in(now.lambda));
      if (!now.unique.empty()) {
        const auto own = info.own_rows().in(now.unique);
        out_ << ',' << (std::ranges::find(own, 0) == own.end() ? 1 : 0);
      }
      for (const auto& column : forces_[c]) {
        double Z = 0.0;
        for (const std::size_t slot : column.slots) Z += now.forces[slot];
        out_ << ',' << Z;
      }
    }
    out_ << ',' << now.energy << '\n';
  }

 private:
  std::ostream& out_;
  const Record& record_;
  const Layout& layout_;
  std::vector<std::vector<ForceColumn>> forces_;
};

}  // namespace

void Record::write_csv(std::ostream& out) const {
  Writer writer(out, *this);
  writer.preamble();
  const auto digits = out.precision(std::numeric_limits<double>::max_digits10);
  writer.header();
  for (std::size_t i = 0; i < times.size(); ++i) writer.line(sample(i));
  out.precision(digits);
}

void Record::write_csv(const std::string& path) const {
  std::ofstream file(path);
  write_csv(file);
  file.flush();
  if (!file) {
    throw Error("Cannot write the trajectory to \"" + path +
                "\": check that the folder exists and is writable");
  }
}

}  // namespace dalembert
