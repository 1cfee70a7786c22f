#pragma once

#include <dalembert/core/equations/arguments.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace dalembert {

/// Where something rigid is: `rotation * r + shift`, of a place r of it as it was.
struct Pose {
  Mat<3, 3> rotation = Mat<3, 3>::Identity();  ///< orthonormal
  Vec<3> shift = Vec<3>::Zero();               ///< [length]
};

/// What a picture shows of a constraint or force: its type says so by a member `Sketch sketch() const`, and
/// one that says nothing is drawn as lines between its points. A picture has no part in the motion.
///
/// Shapes and their sizes: "rod" and "string" (length), "spring" (relaxed length), "damper", "ball", "weld",
/// "hinge" and "slider" (their axis is the last direction among the points), "gear" (two radii), "wheel"
/// (centre, rotor and track; radius), "upright wheel" (centre, heading and spin; radius), "track" (a point
/// and two of a line), "disk" (centre and two points; radius, point and normal of the plane), "plane" (point,
/// normal), "sphere" (centre, radius), "cylinder" (point, axis, radius), "cone" (apex, axis, half angle),
/// "axis" (point, direction), "implicit" (where `equation` is 0), "lines" and "none".
struct Sketch {
  using Place = std::array<double, 3>;  ///< [length]; in the plane the third is 0

  std::string_view shape = "lines";  ///< one of those above
  std::vector<double> sizes{};       ///< of the shape, in the order above
  /// Where what is drawn is carried at time t, if it moves.
  std::function<Pose(double t)> pose{};
  /// A curve or surface, as it is before it is carried anywhere.
  std::function<double(const Place& r)> equation{};
};

/// A point of a picture: numbers out of q, a place, or a path.
struct SketchedPoint {
  std::vector<int> coordinates{};  ///< that it reads; none if the scene does not move it
  std::vector<double> map{};       ///< its numbers out of these, row after row; empty if they are its numbers
  Sketch::Place position{};        ///< of a fixed one
  std::function<Sketch::Place(double t)> path{};  ///< of a driven one
  bool rotor = false;                             ///< an angle
  bool direction = false;                         ///< a vector, no place
};

/// A constraint or force as a picture needs it.
struct Drawing {
  Sketch sketch{};                      ///< its own
  std::vector<SketchedPoint> points{};  ///< in the order of its equation
};

namespace detail {

template <int D>
[[nodiscard]] Sketch::Place place_of(const Vec<D>& r) {
  Sketch::Place place{};
  for (int k = 0; k < D; ++k) place[static_cast<std::size_t>(k)] = r[k];
  return place;
}

/// Appends numbers of a vector to those of a sketch.
void append_numbers(std::vector<double>& sizes, std::span<const double> numbers);
template <int D>
void append(std::vector<double>& sizes, const Vec<D>& r) {
  append_numbers(sizes, {r.data(), static_cast<std::size_t>(D)});
}

/// Whether a map of the particles of a body, of D rows, gives a vector: one that a shift of all does not
/// change.
[[nodiscard]] bool is_direction(std::span<const double> map, std::size_t rows);

template <Point P>
[[nodiscard]] SketchedPoint sketched(const P& point) {
  SketchedPoint drawn;
  if constexpr (P::coordinates > 0) {
    const auto reads = point.reads();
    drawn.coordinates.assign(reads.begin(), reads.end());
    drawn.rotor = std::is_same_v<P, Rotor>;
    if constexpr (HasMap<P>) {
      const auto& map = point.map();
      for (int row = 0; row < map.rows(); ++row)
        for (int column = 0; column < map.cols(); ++column) drawn.map.push_back(map(row, column));
      drawn.direction = is_direction(drawn.map, P::dimension);
    }
  } else if constexpr (P::driven) {
    drawn.path = [path = point.path](double t) {
      return place_of<P::dimension>(path(t).template cast<double>());
    };
  } else {
    drawn.position = place_of<P::dimension>(point.position);
    drawn.direction = OfParticles<P>;  // a FixedVector
  }
  return drawn;
}

/// A user's own equation of one place is a curve or surface; of several points lines lead between them.
template <class E>
[[nodiscard]] Sketch sketch_of(const E& element) {
  if constexpr (requires { element.sketch(); }) {
    return element.sketch();
  } else {
    return {};
  }
}

template <class E>
[[nodiscard]] std::shared_ptr<const Drawing> drawing_of(const E& element) {
  Drawing drawing{sketch_of(element), {}};
  std::apply([&](const auto&... point) { (drawing.points.push_back(sketched(point)), ...); },
             element.points());
  return std::make_shared<const Drawing>(std::move(drawing));
}

/// A curve or surface as a sketch: its own, or where its equation is 0.
template <int D, class Surface>
[[nodiscard]] Sketch figure_of(const Surface& surface) {
  if constexpr (requires { surface.sketch(); }) {
    return surface.sketch();
  } else if constexpr (requires(const Vec<D>& r) {
                         { surface(r) } -> std::convertible_to<double>;
                       }) {
    return {"implicit", {}, {}, [surface](const Sketch::Place& r) {
              return static_cast<double>(surface(Vec<D>::from(r.data())));
            }};
  } else {
    return {"none"};  // it changes in time in a way of its own
  }
}

/// A turn about an axis of unit length through a point.
[[nodiscard]] Pose turned_about(const Vec<3>& point, const Vec<3>& axis, double angle);
/// What is carried by a motion, and may have been carried by another before.
[[nodiscard]] Sketch carried(Sketch sketch, std::function<Pose(double t)> pose);

}  // namespace detail

}  // namespace dalembert
