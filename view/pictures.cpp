#include "dalembert/view/pictures.h"

#include <dalembert/view/level_set.h>

#include <algorithm>
#include <span>

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

/// All places that particles and points of constraints come to, and somewhat more.
const Eigen::AlignedBox3d& Pictures::box() {
  if (!box_.isEmpty()) return box_;
  const auto extend = [&](const SketchedPoint& point, const FlatSample& at) {
    if (point.direction || point.rotor) return;
    const Sketch::Place r = place_at(point, at, layout_->dimension);
    box_.extend(Eigen::Vector3d(r[0], r[1], r[2]));
  };
  for (const Shown& shown : all_->shown()) {
    const FlatSample at = shown.sample();
    for (const auto& constraint : layout_->constraints)
      for (const SketchedPoint& point : constraint.drawing->points) extend(point, at);
    for (const auto& p : layout_->particles) {
      SketchedPoint point;
      for (int k = 0; k < layout_->dimension; ++k) point.coordinates.push_back(p.coordinate + k);
      extend(point, at);
    }
  }
  constexpr double more = 0.25;  // of its size, which a curve is drawn beyond where something was
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(more * box_.sizes().maxCoeff());
  box_ = Eigen::AlignedBox3d(box_.min() - around, box_.max() + around);
  if (layout_->dimension == 2) box_.min().z() = box_.max().z() = 0.0;
  return box_;
}

Pictures::Drawn Pictures::drawn(const Drawing& drawing) {
  Drawn its{.drawing = &drawing, .paths = {}, .pose = {}, .level_set = {}};
  for (const SketchedPoint& point : drawing.points) {
    its.paths.emplace_back();
    if (!point.path) continue;
    its.paths.back() = all_->add(layout_->dimension, [&](const FlatSample& at, std::span<double> out) {
      std::ranges::copy_n(point.path(at.time).begin(), layout_->dimension, out.begin());
    });
  }
  if (drawing.sketch.pose) {
    its.pose = all_->add(12, [&](const FlatSample& at, std::span<double> out) {
      const Pose pose = drawing.sketch.pose(at.time);
      Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows;
      rows << Eigen::Matrix3d(pose.rotation), Eigen::Vector3d(pose.shift);
      std::ranges::copy_n(rows.data(), 12, out.begin());
    });
  }
  constexpr int cells_in_plane = 150, cells_in_space = 24;
  if (drawing.sketch.equation)
    its.level_set = level_set(drawing.sketch.equation, box(), layout_->dimension,
                              layout_->dimension == 2 ? cells_in_plane : cells_in_space);
  return its;
}

void Pictures::write_point(Json& json, const SketchedPoint& point, const Numbers& path) const {
  json.object([&] {
    if (point.direction) json.member("direction", true);
    if (point.rotor) {
      json.member("rotor", point.coordinates.front());
    } else if (point.path) {
      json.member("path", path);
    } else if (point.coordinates.empty()) {
      json.list("at", std::span(point.position).first(static_cast<std::size_t>(layout_->dimension)),
                [&](double x) { json.value(x); });
    } else if (point.map.empty()) {
      json.member("coordinates", point.coordinates);
    } else {
      json.member("coordinates", point.coordinates);
      json.member("map", point.map);
    }
  });
}

void Pictures::write(Json& json, const Drawn& its) const {
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

}  // namespace dalembert
