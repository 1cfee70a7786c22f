#include "dalembert/view/write_gltf.h"

#include <dalembert/core/errors.h>
#include <dalembert/view/body_boxes.h>
#include <dalembert/view/glb.h>
#include <dalembert/view/pictures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

namespace dalembert {

namespace {

enum : std::size_t { sphere, cylinder, cube, mark };  // the solids, in this order

/// Parts of the extent of the scene: they make small things visible, and have no part in the motion.
constexpr double radius_of_particle = 0.02, radius_of_line = 0.006, radius_of_mark = 0.01;

/// Samples whose times single precision tells apart.
std::vector<std::size_t> told_apart(const Record& run) {
  std::vector<std::size_t> all;
  float last = -1.0F;
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    const auto t = static_cast<float>(run.times[i] - run.times.front());
    if (t > last) all.push_back(i);
    last = std::max(last, t);
  }
  return all;
}

[[noreturn]] void beyond_single(const std::string& what, double x) {
  std::ostringstream out;
  out << "write_gltf: " << what << ", " << x
      << ", is beyond the single precision of glTF, from 1e-38 to 3e38; choose other units";
  throw InvalidArgument(out.str());
}

/// Of what may not be rounded to 0 either.
void require_single(const std::string& what, double x) {
  if (x != 0.0 && !std::isnormal(static_cast<float>(x))) beyond_single(what, x);
}

void require_finite(const MovingSolid& its) {
  const auto require = [&its](const char* what, const std::vector<Eigen::Vector3d>& all) {
    for (const Eigen::Vector3d& one : all)
      for (const double x : one)
        if (!std::isfinite(static_cast<float>(x))) beyond_single(what + (" of \"" + its.name + '"'), x);
  };
  require("a coordinate", its.place);
  require("the size", its.size);
}

/// The rotation by the least angle from the direction of a to that of b: twice that to the direction halfway.
/// Of opposite ones it is any half turn across.
Eigen::Quaterniond least_rotation(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d from = a.normalized(), both = from + b.normalized();
  Eigen::Quaterniond turn;
  if (both.norm() > 1e-8) {  // else its direction is lost in round-off
    const Eigen::Vector3d halfway = both.normalized();
    turn.w() = from.dot(halfway);
    turn.vec() = from.cross(halfway);
  } else {
    turn.w() = 0.0;
    turn.vec() = from.unitOrthogonal();
  }
  return turn;
}

class AnimatedRun {
 public:
  explicit AnimatedRun(const Record& run) : run_(run), layout_(*run.layout), samples_(told_apart(run)) {
    require_single("the length of the run", run.times.back() - run.times.front());
    for (const std::size_t i : samples_)
      result.times.push_back(static_cast<float>(run.times[i] - run.times.front()));
    result.name = layout_.scene;
    if (layout_.dimension == 3)  // z upwards to y upwards
      result.turned = least_rotation(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
    result.solids = {unit_sphere(), unit_cylinder(), unit_cube(), unit_sphere()};
    result.colours = {{0.0F, 0.17F, 0.45F}, {0.35F, 0.35F, 0.38F}, {0.85F, 0.45F, 0.1F}, {0.1F, 0.1F, 0.1F}};
    extent_ = extent();
    require_single("the size of the scene", extent_);
    const auto bodies = body_boxes(layout_, run.sample(0));
    add_particles(bodies);
    for (const BodyBox& body : bodies) add_body(body);
    for (const auto& constraint : layout_.constraints)
      if (!constraint.internal) add_lines(constraint.name, constraint.drawing);
    for (const auto& force : layout_.forces) add_lines(force.name, force.drawing);
    leave_out_unused();
    std::ranges::for_each(result.moving, require_finite);
  }

  Animation result{};

 private:
  using Places = std::vector<Eigen::Vector3d>;

  [[nodiscard]] Places places(const SketchedPoint& point) const {
    Places all;
    for (const std::size_t i : samples_) {
      const Sketch::Place r = place_at(point, run_.sample(i), layout_.dimension);
      all.emplace_back(r[0], r[1], r[2]);
    }
    return all;
  }
  [[nodiscard]] SketchedPoint point_of(const Layout::Particle& p) const {
    SketchedPoint point;
    for (int k = 0; k < layout_.dimension; ++k) point.coordinates.push_back(p.coordinate + k);
    return point;
  }
  /// The diagonal of all places that particles and the points of constraints come to; 1 if that is 0.
  [[nodiscard]] double extent() const {
    Eigen::AlignedBox3d box;
    const auto take = [&](const SketchedPoint& point) {
      if (point.rotor || point.direction) return;
      for (const Eigen::Vector3d& r : places(point)) box.extend(r);
    };
    for (const auto& p : layout_.particles) take(point_of(p));
    for (const auto& c : layout_.constraints)
      if (c.drawing) std::ranges::for_each(c.drawing->points, take);
    const double diagonal = box.isEmpty() ? 0.0 : box.diagonal().norm();
    return diagonal > 0.0 ? diagonal : 1.0;
  }
  [[nodiscard]] Places constant(double size) const {
    return Places(samples_.size(), Eigen::Vector3d::Constant(size * extent_));
  }

  void add_particles(const std::vector<BodyBox>& bodies) {
    std::vector<char> in_a_body(layout_.particles.size());
    for (const BodyBox& body : bodies)
      for (const int i : body.particles) in_a_body[static_cast<std::size_t>(i)] = 1;
    for (std::size_t i = 0; i < layout_.particles.size(); ++i)
      if (!in_a_body[i])
        result.moving.push_back({layout_.particles[i].name,
                                 sphere,
                                 places(point_of(layout_.particles[i])),
                                 {},
                                 constant(radius_of_particle)});
  }

  /// The box turns as its axes do; edges of no length are given that of a line.
  void add_body(const BodyBox& body) {
    if (body.axes.empty()) {
      result.moving.push_back({body.name, sphere, places(body.centre), {}, constant(radius_of_particle)});
      return;
    }
    std::vector<Places> axes;
    for (const SketchedPoint& axis : body.axes) axes.push_back(places(axis));
    MovingSolid box{body.name, cube, places(body.centre), {}, {}};
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      Eigen::Vector3d half = Eigen::Vector3d::Constant(radius_of_line * extent_);
      for (std::size_t k = 0; k < axes.size(); ++k)
        half[static_cast<Eigen::Index>(k)] = axes[k].front().norm();
      box.size.push_back(half);
      const Eigen::Vector3d first = axes[0][i].normalized();
      if (axes.size() == 1) {
        turn_to(box.turned, Eigen::Vector3d::UnitX(), first);
        continue;
      }
      Eigen::Matrix3d frame;
      frame.col(0) = first;
      frame.col(1) = (axes[1][i] - first * first.dot(axes[1][i])).normalized();
      frame.col(2) = frame.col(0).cross(frame.col(1));
      keep(box.turned, Eigen::Quaterniond(frame));
    }
    result.moving.push_back(std::move(box));
  }

  void add_lines(const std::string& name, const std::shared_ptr<const Drawing>& drawing) {
    constexpr std::array drawn{"lines", "rod", "string", "spring", "damper"};
    if (!drawing || std::ranges::find(drawn, drawing->sketch.shape) == drawn.end()) return;
    std::optional<Places> before;
    for (const SketchedPoint& point : drawing->points) {
      if (point.rotor || point.direction) continue;
      Places here = places(point);
      if (point.coordinates.empty() && drawing->points.size() > 1)
        result.moving.push_back({name + " end", mark, here, {}, constant(radius_of_mark)});
      if (before) add_line(name, *before, here);
      before = std::move(here);
    }
  }
  void add_line(const std::string& name, const Places& a, const Places& b) {
    MovingSolid line{name, cylinder, {}, {}, {}};
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Eigen::Vector3d along = b[i] - a[i];
      const double length = along.norm(), radius = radius_of_line * extent_;
      line.place.emplace_back((a[i] + b[i]) / 2.0);
      line.size.emplace_back(radius, radius, length);
      turn_to(line.turned, Eigen::Vector3d::UnitZ(),
              length > 0.0 ? Eigen::Vector3d(along / length) : Eigen::Vector3d::UnitZ().eval());
    }
    result.moving.push_back(std::move(line));
  }

  /// Solids that nothing is.
  void leave_out_unused() {
    for (std::size_t k = result.solids.size(); k-- > 0;) {
      if (std::ranges::find(result.moving, k, &MovingSolid::solid) != result.moving.end()) continue;
      result.solids.erase(result.solids.begin() + static_cast<std::ptrdiff_t>(k));
      result.colours.erase(result.colours.begin() + static_cast<std::ptrdiff_t>(k));
      for (MovingSolid& one : result.moving)
        if (one.solid > k) --one.solid;
    }
  }

  /// Appends the least rotation from the one before that brings `axis` to `direction`: a line has no twist.
  static void turn_to(std::vector<Eigen::Quaterniond>& turned, const Eigen::Vector3d& axis,
                      const Eigen::Vector3d& direction) {
    const Eigen::Quaterniond last = turned.empty() ? Eigen::Quaterniond::Identity() : turned.back();
    keep(turned, (least_rotation(last * axis, direction) * last).normalized());
  }
  /// Of the two quaternions of a rotation the one closer to the last: players interpolate between them.
  static void keep(std::vector<Eigen::Quaterniond>& turned, Eigen::Quaterniond next) {
    if (!turned.empty() && turned.back().dot(next) < 0.0) next.coeffs() *= -1.0;
    turned.push_back(next);
  }

  const Record& run_;
  const Layout& layout_;
  std::vector<std::size_t> samples_;
  double extent_ = 1.0;
};

}  // namespace

void detail::write_gltf(const Record& run, const std::filesystem::path& path) {
  if (run.times.empty()) throw InvalidArgument("write_gltf: the run has no samples");
  if (path.extension() != ".glb")
    throw InvalidArgument("write_gltf: \"" + path.string() + "\" must end in .glb, the binary form of glTF");
  std::ofstream file(path, std::ios::binary);
  write_glb(file, AnimatedRun(run).result);
  file.flush();
  if (!file)
    throw Error("Cannot write the animation to \"" + path.string() +
                "\": check that the folder exists and is writable");
}

}  // namespace dalembert
