#include "dalembert/core/results/columns.h"

#include <dalembert/core/results/trajectory.h>

#include <algorithm>

namespace dalembert {

namespace {

/// Names of each coordinate as a position, a velocity and a force: "bob.x", "bob.vx", "bob.Zx".
struct CoordinateNames {
  std::string position, velocity, force;
  bool angle = false;
};

std::vector<CoordinateNames> coordinate_names(const Layout& layout) {
  std::vector<CoordinateNames> names(layout.coordinates());
  for (const auto& p : layout.particles) {
    for (int k = 0; k < layout.dimension; ++k) {
      const char axis = "xyz"[k];
      names[static_cast<std::size_t>(p.coordinate + k)] = {p.name + '.' + axis, p.name + ".v" + axis,
                                                           p.name + ".Z" + axis};
    }
  }
  for (const auto& r : layout.rotors) {
    names[static_cast<std::size_t>(r.coordinate)] = {r.name + ".angle", r.name + ".rate", r.name + ".torque",
                                                     true};
  }
  return names;
}

/// The slots of a constraint that act on one coordinate.
struct ForceSlots {
  std::size_t coordinate;
  std::vector<std::size_t> slots;
};

std::vector<ForceSlots> force_slots(const Layout& layout, const Layout::Constraint& c) {
  std::vector<ForceSlots> all;
  for (const std::size_t slot : c.slots()) {
    const auto coordinate = static_cast<std::size_t>(layout.slot_coordinate[slot]);
    auto own = std::ranges::find(all, coordinate, &ForceSlots::coordinate);
    if (own == all.end()) own = all.insert(own, {coordinate, {}});
    own->slots.push_back(slot);
  }
  return all;
}

class RunColumns {
 public:
  explicit RunColumns(const Record& record)
      : record_(record), layout_(*record.layout), names_(coordinate_names(layout_)) {}

  [[nodiscard]] std::vector<Column> all() {
    all_.push_back({"t", "time", [](const FlatSample& now) { return now.time; }});
    for (const auto& p : layout_.particles)
      add_motion(
          Places::from(static_cast<std::size_t>(p.coordinate), static_cast<std::size_t>(layout_.dimension)));
    for (const auto& r : layout_.rotors) add_motion(Places::from(static_cast<std::size_t>(r.coordinate), 1));
    for (const auto& c : layout_.constraints) add_constraint(c);
    all_.push_back({"energy", "energy", [](const FlatSample& now) { return now.energy; }});
    return std::move(all_);
  }

 private:
  void add_motion(const Places& coordinates) {
    for (const std::size_t k : coordinates)
      all_.push_back({names_[k].position, names_[k].angle ? "angle" : "length",
                      [k](const FlatSample& now) { return now.q[k]; }});
    for (const std::size_t k : coordinates)
      all_.push_back({names_[k].velocity, names_[k].angle ? "angle/time" : "length/time",
                      [k](const FlatSample& now) { return now.v[k]; }});
  }

  void add_constraint(const Layout::Constraint& c) {
    int number = 0;
    for (const std::size_t row : c.own_rows())
      all_.push_back({c.name + ".lambda" + (c.rows > 1 ? std::to_string(++number) : ""), "multiplier",
                      [row](const FlatSample& now) { return now.lambda[row]; }});
    if (!record_.unique.empty())
      all_.push_back({c.name + ".unique", "1 or 0", [own = c.own_rows()](const FlatSample& now) {
                        return std::ranges::find(own.in(now.unique), 0) == own.in(now.unique).end() ? 1.0
                                                                                                    : 0.0;
                      }});
    for (const ForceSlots& on : force_slots(layout_, c))
      all_.push_back({c.name + ".on." + names_[on.coordinate].force,
                      names_[on.coordinate].angle ? "force length" : "force",
                      [slots = on.slots](const FlatSample& now) {
                        double Z = 0.0;
                        for (const std::size_t slot : slots) Z += now.forces[slot];
                        return Z;
                      }});
  }

  const Record& record_;
  const Layout& layout_;
  std::vector<CoordinateNames> names_;
  std::vector<Column> all_{};
};

}  // namespace

std::vector<Column> columns(const Record& record) { return RunColumns(record).all(); }

}  // namespace dalembert
