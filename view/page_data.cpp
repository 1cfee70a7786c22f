#include "dalembert/view/page_data.h"

#include <dalembert/core/results/ledger.h>
#include <dalembert/solvers/certificate/largest_errors.h>
#include <dalembert/solvers/certificate/statement.h>
#include <dalembert/view/body_boxes.h>
#include <dalembert/view/level_set.h>
#include <dalembert/view/quantities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dalembert {

Sketch::Place place_at(const SketchedPoint& point, const FlatSample& at, int dimension) {
  Sketch::Place place = point.position;
  const std::size_t n = point.coordinates.size();
  if (point.path) return point.path(at.time);
  const auto q = [&](std::size_t k) { return at.q[static_cast<std::size_t>(point.coordinates[k])]; };
  if (point.map.empty()) {
    for (std::size_t k = 0; k < n; ++k) place[k] = q(k);
    return place;
  }
  for (std::size_t row = 0; row < static_cast<std::size_t>(dimension); ++row)
    for (std::size_t k = 0; k < n; ++k) place[row] += point.map[row * n + k] * q(k);
  return place;
}

namespace {

constexpr const char* words_of(Happened what) {
  switch (what) {
    case Happened::event:
      return "event";
    case Happened::opened:
      return "opens";
    case Happened::struck:
      return "impact";
    case Happened::rested:
      return "comes to rest";
    case Happened::sticks:
      return "sticks";
    case Happened::slides:
      return "slides";
  }
  return "";
}

/// One attempt at a page: with every so many samples.
class PageData {
 public:
  PageData(const Record& run, const TwoRuns* certified, std::size_t every)
      : run_(run),
        certified_(certified),
        layout_(*run.layout),
        every_(every),
        all_(instants(run, certified, every), certified),
        D_(layout_.dimension) {
    add_time_and_energy();
    add_motion();
    for (const auto& constraint : layout_.constraints)
      if (!constraint.internal) constraints_.push_back(acting(constraint));
    for (const auto& force : layout_.forces)
      forces_.push_back(force.drawing ? drawn(*force.drawing) : Drawn{});
    add_ledger();
  }

  [[nodiscard]] std::size_t bytes(Digits digits) { return all_.columns().bytes(digits); }
  void write(Json& json, Digits digits, const PageOptions& options);

 private:
  using Kind = Quantities::Kind;
  using Numbers = std::vector<std::size_t>;

  /// Columns of what a picture needs besides the coordinates.
  struct Drawn {
    const Drawing* drawing = nullptr;
    std::vector<Numbers> paths{};  ///< of each driven point
    Numbers pose{};                ///< of what is carried: three rows of four
    std::vector<double> level_set{};
  };
  /// The force of a constraint on one of its points.
  struct Arrow {
    std::size_t point;
    Numbers force;
    std::optional<std::size_t> error;
    bool torque;  ///< on the body of that point, or on a rotor
  };
  struct Acting {
    const Layout::Constraint* constraint;
    Drawn drawn;
    std::vector<Arrow> arrows;
    Numbers lambda;
    std::optional<std::size_t> error;
    Numbers unique;                         ///< none if all always are
    std::optional<std::size_t> released{};  ///< whether it is out of force, if it ever is
  };
  /// A particle or rotor.
  struct Moving {
    Numbers q, v, a;
    std::optional<std::size_t> position_error, velocity_error;
  };

  std::optional<std::size_t> error(int numbers, Kind kind, const Quantities::Reading& read) {
    if (certified_ == nullptr) return {};
    return all_.add_error(numbers, kind, read);
  }
  void add_time_and_energy() {
    time_ = all_.columns().add([&](std::size_t i) { return all_.shown()[i].time(); });
    const auto energy = [](const FlatSample& at, std::span<double> out) { out[0] = at.energy; };
    energy_ = all_.add(1, energy).front();
    energy_error_ = error(1, Kind::other, energy);
  }
  Moving moving(int first, int count, Kind position, Kind velocity) {
    const auto part = [first, count](auto member) {
      return [=](const FlatSample& at, std::span<double> out) {
        std::ranges::copy(
            (at.*member).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)),
            out.begin());
      };
    };
    const auto q = part(&FlatSample::q), v = part(&FlatSample::v), a = part(&FlatSample::a);
    return {all_.add(count, q), all_.add(count, v), all_.add(count, a), error(count, position, q),
            error(count, velocity, v)};
  }
  void add_motion() {
    for (const auto& p : layout_.particles)
      particles_.push_back(moving(p.coordinate, D_, Kind::position, Kind::velocity));
    for (const auto& r : layout_.rotors)
      rotors_.push_back(moving(r.coordinate, 1, Kind::angle, Kind::angular_velocity));
  }

  Drawn drawn(const Drawing& drawing);
  [[nodiscard]] const Eigen::AlignedBox3d& box();
  Acting acting(const Layout::Constraint& constraint);
  void add_arrows(Acting& its);
  [[nodiscard]] std::optional<std::size_t> released(std::size_t constraint);
  std::optional<Arrow> torque_arrow(const Acting& its);
  void add_ledger();

  void write_heading(Json& json, Digits digits, const PageOptions& options) const;
  void write_point(Json& json, const SketchedPoint& point, const Numbers& path) const;
  void write_drawn(Json& json, const Drawn& its) const;
  void write_motion(Json& json) const;
  void write_moving(Json& json, const Moving& its) const;
  void write_bodies(Json& json) const;
  void write_constraints(Json& json) const;
  void write_events(Json& json) const;
  void write_statistics(Json& json) const;
  void write_certificate(Json& json) const;
  [[nodiscard]] std::string label_of(const Occurrence& one) const;
  static void write_error(Json& json, const std::optional<std::size_t>& error,
                          std::string_view name = "error") {
    if (error) json.member(name, *error);
  }

  const Record& run_;
  const TwoRuns* certified_;
  const Layout& layout_;
  std::size_t every_;
  Quantities all_;
  int D_;
  std::size_t time_ = 0, energy_ = 0;
  std::optional<std::size_t> energy_error_;
  std::vector<Moving> particles_, rotors_;
  std::vector<Acting> constraints_;
  std::vector<Drawn> forces_;
  Eigen::AlignedBox3d box_;
  std::vector<std::pair<std::string, std::size_t>> ledger_;
};

/// All places that particles and points of constraints come to, and somewhat more.
const Eigen::AlignedBox3d& PageData::box() {
  if (!box_.isEmpty()) return box_;
  const auto extend = [&](const SketchedPoint& point, const FlatSample& at) {
    if (point.direction || point.rotor) return;
    const Sketch::Place r = place_at(point, at, D_);
    box_.extend(Eigen::Vector3d(r[0], r[1], r[2]));
  };
  for (const Shown& shown : all_.shown()) {
    const FlatSample at = shown.sample();
    for (const auto& constraint : layout_.constraints)
      for (const SketchedPoint& point : constraint.drawing->points) extend(point, at);
    for (const auto& p : layout_.particles) {
      SketchedPoint point;
      for (int k = 0; k < D_; ++k) point.coordinates.push_back(p.coordinate + k);
      extend(point, at);
    }
  }
  constexpr double more = 0.25;  // of its size, which a curve is drawn beyond where something was
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(more * box_.sizes().maxCoeff());
  box_ = Eigen::AlignedBox3d(box_.min() - around, box_.max() + around);
  if (D_ == 2) box_.min().z() = box_.max().z() = 0.0;
  return box_;
}

PageData::Drawn PageData::drawn(const Drawing& drawing) {
  Drawn its{.drawing = &drawing, .paths = {}, .pose = {}, .level_set = {}};
  for (const SketchedPoint& point : drawing.points) {
    its.paths.emplace_back();
    if (!point.path) continue;
    its.paths.back() = all_.add(D_, [&](const FlatSample& at, std::span<double> out) {
      std::ranges::copy_n(point.path(at.time).begin(), D_, out.begin());
    });
  }
  if (drawing.sketch.pose) {
    its.pose = all_.add(12, [&](const FlatSample& at, std::span<double> out) {
      const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows =
          drawing.sketch.pose(at.time).matrix().topRows<3>();
      std::ranges::copy_n(rows.data(), 12, out.begin());
    });
  }
  constexpr int cells_in_plane = 150, cells_in_space = 24;
  if (drawing.sketch.equation)
    its.level_set = level_set(drawing.sketch.equation, box(), D_, D_ == 2 ? cells_in_plane : cells_in_space);
  return its;
}

PageData::Acting PageData::acting(const Layout::Constraint& constraint) {
  Acting its{.constraint = &constraint,
             .drawn = drawn(*constraint.drawing),
             .arrows = {},
             .lambda = {},
             .error = {},
             .unique = {}};
  const auto lambda = [own = constraint.own_rows()](const FlatSample& at, std::span<double> out) {
    std::ranges::copy(own.in(at.lambda), out.begin());
  };
  its.lambda = all_.add(constraint.rows, lambda);
  its.error = error(constraint.rows, Kind::force, lambda);
  if (!run_.unique.empty())
    its.unique =
        all_.add(constraint.rows, [own = constraint.own_rows()](const FlatSample& at, std::span<double> out) {
          std::ranges::copy(own.in(at.unique), out.begin());
        });
  add_arrows(its);
  its.released = released(static_cast<std::size_t>(&constraint - layout_.constraints.data()));
  return its;
}

/// An event may change it: then the layout does.
std::optional<std::size_t> PageData::released(std::size_t constraint) {
  const auto out = [constraint](const Layout& layout) {
    return layout.constraints[constraint].holds.released;
  };
  const auto ever = [&](const auto& later) { return out(*later.layout); };
  if (!out(layout_) && std::ranges::none_of(run_.later, ever)) return {};
  return all_.columns().add([&](std::size_t i) {
    const Shown& shown = all_.shown()[i];
    return out(*shown.record->layout_of(shown.number)) ? 1.0 : 0.0;
  });
}

/// The force on a point of a body is the sum of those on its particles: the weights of a place add up to 1.
void PageData::add_arrows(Acting& its) {
  std::size_t slot = static_cast<std::size_t>(its.constraint->first_slot);
  const auto& points = its.drawn.drawing->points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t count = points[k].coordinates.size(), first = slot;
    slot += count;
    if (count == 0 || points[k].direction) continue;
    const int numbers = points[k].rotor ? 1 : D_;
    const auto force = [=](const FlatSample& at, std::span<double> out) {
      std::ranges::fill(out, 0.0);
      for (std::size_t i = 0; i < count; ++i) out[i % out.size()] += at.forces[first + i];
    };
    its.arrows.push_back({k, all_.add(numbers, force), error(numbers, Kind::other, force), points[k].rotor});
  }
  if (auto torque = torque_arrow(its)) its.arrows.push_back(std::move(*torque));
}

/// On the second body of a joint, or the first if that is the ground: sum r_i x f_i over what the forces at
/// its directions are on its particles; as these add up to 0 it does not depend on the origin.
std::optional<PageData::Arrow> PageData::torque_arrow(const Acting& its) {
  const auto& points = its.drawn.drawing->points;
  std::optional<std::size_t> place;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!points[k].direction && !points[k].rotor && !points[k].map.empty()) place = k;
  if (!place) return {};
  const std::vector<int>& coordinates = points[*place].coordinates;
  std::vector<std::size_t> slots;  // the first one of each direction
  std::size_t slot = static_cast<std::size_t>(its.constraint->first_slot);
  for (const SketchedPoint& point : points) {
    if (point.direction && point.coordinates == coordinates) slots.push_back(slot);
    slot += point.coordinates.size();
  }
  if (slots.empty()) return {};
  const int D = D_, numbers = D == 2 ? 1 : 3;
  const auto torque = [slots, coordinates, D](const FlatSample& at, std::span<double> out) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), r = sum, f = sum;
    for (const std::size_t first : slots) {
      for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const int k = static_cast<int>(i) % D;
        r[k] = at.q[static_cast<std::size_t>(coordinates[i])];
        f[k] = at.forces[first + i];
        if (k == D - 1) sum += r.cross(f);
      }
    }
    if (D == 2) {
      out[0] = sum.z();
    } else {
      std::ranges::copy(sum, out.begin());
    }
  };
  return Arrow{*place, all_.add(numbers, torque), error(numbers, Kind::other, torque), true};
}

/// Its numbers are those of samples: at other instants there are none.
void PageData::add_ledger() {
  if (!run_.ledger) return;
  const auto add = [&](const std::string& name, const auto& number_at) {
    ledger_.emplace_back(name, all_.columns().add([&](std::size_t i) {
      const Shown& shown = all_.shown()[i];
      return shown.of_run(run_) ? number_at(shown.number) : std::numeric_limits<double>::quiet_NaN();
    }));
  };
  const auto account = [&](const std::string& prefix, const Ledger::Account& its) {
    add(prefix + its.name, [&](std::size_t i) { return its.values[i]; });
  };
  const Ledger& ledger = *run_.ledger;
  account("", ledger.kinetic);
  account("", ledger.potential);
  for (const auto& its : ledger.elastic) account("elastic energy of ", its);
  for (const auto& its : ledger.work) account("work of ", its);
  for (std::size_t k = 0; k < static_cast<std::size_t>(D_); ++k)
    add(std::string("momentum ") + "xyz"[k], [&](std::size_t i) { return ledger.momentum[i][k]; });
  for (std::size_t k = D_ == 2 ? 2 : 0; k < 3; ++k)
    add(std::string("angular momentum ") + "xyz"[k],
        [&](std::size_t i) { return ledger.angular_momentum[i][k]; });
}

void PageData::write_point(Json& json, const SketchedPoint& point, const Numbers& path) const {
  json.object([&] {
    if (point.direction) json.member("direction", true);
    if (point.rotor) {
      json.member("rotor", point.coordinates.front());
    } else if (point.path) {
      json.member("path", path);
    } else if (point.coordinates.empty()) {
      json.list("at", std::span(point.position).first(static_cast<std::size_t>(D_)),
                [&](double x) { json.value(x); });
    } else if (point.map.empty()) {
      json.member("coordinates", point.coordinates);
    } else {
      json.member("coordinates", point.coordinates);
      json.member("map", point.map);
    }
  });
}

void PageData::write_drawn(Json& json, const Drawn& its) const {
  if (its.drawing == nullptr) return json.member("shape", "none");
  json.member("shape", its.drawing->sketch.shape);
  json.member("sizes", its.drawing->sketch.sizes);
  if (!its.pose.empty()) json.member("pose", its.pose);
  if (!its.level_set.empty()) {
    std::vector<float> places(its.level_set.begin(), its.level_set.end());
    json.list("levelSet", places, [&](float x) { json.value(static_cast<double>(x)); });
  }
  std::size_t k = 0;
  json.list("points", its.drawing->points,
            [&](const auto& point) { write_point(json, point, its.paths[k++]); });
}

void PageData::write_moving(Json& json, const Moving& its) const {
  json.member("position", its.q);
  json.member("velocity", its.v);
  json.member("acceleration", its.a);
  write_error(json, its.position_error, "positionError");
  write_error(json, its.velocity_error, "velocityError");
}

void PageData::write_motion(Json& json) const {
  std::size_t k = 0;
  json.list("particles", layout_.particles, [&](const auto& p) {
    json.object([&] {
      json.member("name", p.name);
      json.member("mass", p.mass);
      json.member("coordinate", p.coordinate);
      write_moving(json, particles_[k++]);
    });
  });
  k = 0;
  json.list("rotors", layout_.rotors, [&](const auto& r) {
    json.object([&] {
      json.member("name", r.name);
      json.member("inertia", r.inertia);
      json.member("coordinate", r.coordinate);
      write_moving(json, rotors_[k++]);
    });
  });
}

void PageData::write_bodies(Json& json) const {
  json.list("bodies", body_boxes(layout_, all_.shown().front().sample()), [&](const BodyBox& body) {
    json.object([&] {
      json.member("name", body.name);
      json.member("particles", body.particles);
      json.list("places", std::vector{body.centre}, [&](const auto& p) { write_point(json, p, {}); });
      json.list("axes", body.axes, [&](const auto& p) { write_point(json, p, {}); });
      json.list("touched", body.touched, [&](const auto& p) { write_point(json, p, {}); });
    });
  });
}

void PageData::write_constraints(Json& json) const {
  json.list("constraints", constraints_, [&](const Acting& its) {
    const Layout::Constraint& c = *its.constraint;
    json.object([&] {
      json.member("index", &c - layout_.constraints.data());
      json.member("kind", c.kind);
      json.member("name", c.name);
      json.member("meaning", c.meaning);
      if (c.holds.contact) json.member("oneSided", c.holds.contact->sign());
      if (c.holds.roughness) json.member("pressedBy", c.holds.roughness->pressed_by);
      write_drawn(json, its.drawn);
      json.member("lambda", its.lambda);
      write_error(json, its.error);
      if (!its.unique.empty()) json.member("unique", its.unique);
      if (its.released) json.member("released", *its.released);
      json.list("arrows", its.arrows, [&](const Arrow& arrow) {
        json.object([&] {
          json.member("point", arrow.point);
          json.member("force", arrow.force);
          json.member("torque", arrow.torque);
          write_error(json, arrow.error);
        });
      });
    });
  });
  std::size_t k = 0;
  json.list("forces", layout_.forces, [&](const auto& force) {
    json.object([&] {
      json.member("kind", force.kind);
      json.member("name", force.name);
      write_drawn(json, forces_[k++]);
    });
  });
}

std::string PageData::label_of(const Occurrence& one) const {
  if (one.what != Happened::event) return layout_.constraints[one.event].name;
  const auto& names = run_.event_names;
  return one.event < names.size() ? names[one.event] : "event " + std::to_string(one.event);
}

void PageData::write_events(Json& json) const {
  std::size_t row = 0;
  const auto& shown = all_.shown();
  json.list("events", Places::from(0, run_.events.size()), [&](std::size_t k) {
    const Occurrence& one = run_.events[k];
    while (row < shown.size() && shown[row].event != k) ++row;
    json.object([&] {
      json.member("name", label_of(one));
      json.member("what", words_of(one.what));
      json.member("time", one.time);
      if (row < shown.size()) json.member("row", row);
      if (one.what != Happened::event) json.member("constraint", one.event);
      if (certified_ != nullptr) json.member("error", certified_->error_of_time(k));
    });
  });
}

void PageData::write_statistics(Json& json) const {
  const Statistics& s = run_.statistics;
  json.object("statistics", [&] {
    json.member("degrees of freedom", s.degrees_of_freedom);
    json.member("redundant equations", s.redundant_equations);
    json.member("singular positions", s.singular_positions);
    json.member("accuracy", s.accuracy);
    json.member("round-off", s.round_off);
    json.member("steps", s.steps);
    json.member("evaluations", s.evaluations);
    json.member("factorisations", s.factorisations);
    json.member("error test failures", s.error_test_failures);
    json.member("convergence failures", s.convergence_failures);
    json.member("stability-limited steps", s.stability_limited);
    json.member("linear algebra", s.linear_algebra);
    json.member("length of the scene", s.length);
    json.member("time of the scene", s.time);
    json.member("residual of positions", s.residual_position);
    json.member("residual of velocities", s.residual_velocity);
    json.member("correction", s.correction);
    json.member("processor time [s]", s.run_time);
    json.member("advice", s.advice);
  });
  json.list("audit", s.audit.worst, [&](const Finding& finding) {
    json.object([&] {
      json.member("law", name(finding.law));
      json.member("element", finding.element);
      json.member("time", finding.time);
      json.member("size", finding.size);
      json.member("limit", finding.limit);
    });
  });
  json.list("ledger", ledger_, [&](const auto& account) {
    json.object([&] {
      json.member("name", account.first);
      json.member("column", account.second);
    });
  });
}

void PageData::write_certificate(Json& json) const {
  if (certified_ == nullptr) return;
  json.object("certificate", [&] {
    json.member("statement", statement(*certified_, largest_errors(*certified_)));
    json.member("complete", certified_->complete());
    json.member("knownUntil", certified_->known_until());
  });
}

void PageData::write_heading(Json& json, Digits digits, const PageOptions& options) const {
  json.member("format", 1);
  json.member("version", DALEMBERT_VERSION);
  json.member("title", options.title.empty() ? layout_.scene : options.title);
  json.member("scene", layout_.scene);
  json.member("dimension", D_);
  json.member("stepper", run_.stepper);
  json.member("tolerance", run_.tolerance);
  json.member("samples", run_.times.size());
  json.member("every", every_);
  json.member("digits", digits == Digits::sixteen ? 16 : 7);
  json.object("units", [&] {
    json.member("length", options.units.length);
    json.member("time", options.units.time);
    json.member("force", options.units.force);
  });
  json.member("time", time_);
  json.member("energy", energy_);
  write_error(json, energy_error_, "energyError");
}

void PageData::write(Json& json, Digits digits, const PageOptions& options) {
  json.object([&] {
    write_heading(json, digits, options);
    write_motion(json);
    write_bodies(json);
    write_constraints(json);
    write_events(json);
    write_statistics(json);
    write_certificate(json);
    all_.columns().write(json, digits);
  });
}

}  // namespace

void write_page_data(std::ostream& out, const Record& run, const TwoRuns* certified,
                     const PageOptions& options) {
  Json json(out);
  for (std::size_t every = 1;; ++every) {
    PageData page(run, certified, every);
    for (const Digits digits : {Digits::sixteen, Digits::seven}) {
      const bool least = digits == Digits::seven && every >= run.times.size();
      if (page.bytes(digits) <= options.most_bytes || least) return page.write(json, digits, options);
    }
    // The next one that can do: what is left over of a column goes down as its rows do.
    const auto fraction = page.bytes(Digits::seven) / std::max<std::size_t>(options.most_bytes, 1);
    every = std::max(every, every * fraction);
  }
}

}  // namespace dalembert
