#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// How far a scene without a characteristic length has moved so far, and how fast it has been.
struct PathExtent {
  double length = 0.0;  ///< largest distance of a coordinate from its start
  double speed = 0.0;   ///< largest speed of one that is a length,
  double rate = 0.0;    ///< or an angle
  double step = 0.0;    ///< the last one
};

/// The scene's characteristic length and time, from which absolute tolerances and the first step follow, so
/// that a run is the same in any units.
struct Scales {
  /// Where nothing moves any length serves; the square of this one, its inverse and both over the smallest
  /// tolerance are finite numbers.
  static constexpr double least = 1e-140;

  double length;
  double time;
  std::vector<char> is_angle;  ///< each coordinate, or it is a length
  std::vector<double> origin;  ///< the coordinates at the start

  /// A lone particle far from anything has no length but that of its path so far. Its start tells nothing: at
  /// the cusp of a cycloid it rests, and its first motion has not yet begun to bend. So errors are relative
  /// to `extent`, which only grows, and with it `length` and `time`.
  bool length_from_path = false;
  /// It rests: its length is that of the path on which it will leave, from where a segment of the run begins
  /// with another force. Until then any length does.
  bool waits_for_path = false;
  PathExtent extent{};
  double lever = 0.0;   ///< by which constraints turn its angles into lengths: it is no shorter than that
  double forced = 0.0;  ///< the acceleration that its forces alone give it at the start

  /// What coordinate i is measured in: `length`, or 1 for an angle.
  [[nodiscard]] double unit(std::size_t i) const { return is_angle[i] ? 1.0 : length; }
  /// Of each coordinate the length that corresponds to one unit of it: 1, or `length` for an angle.
  [[nodiscard]] std::vector<double> lengths() const;
  /// The largest |x_i| in these units.
  [[nodiscard]] double largest(std::span<const double> x) const;
  [[nodiscard]] double speed() const { return length / time; }
  /// The error allowed to coordinate i at q: relative to the scene, or to how far the coordinate has
  /// come, wherever the origin lies; and never below round-off.
  [[nodiscard]] double position_error(std::size_t i, double q, double tolerance) const {
    return tolerance * (unit(i) + std::abs(q - origin[i])) +
           std::numeric_limits<double>::epsilon() * std::abs(q);
  }
  /// The error allowed to velocity i: relative to `length` in `time`, or the top speed of a path, and to
  /// itself.
  [[nodiscard]] double velocity_error(std::size_t i, double v, double tolerance) const;
  /// The extent when the next step, of h, is at (q, v).
  [[nodiscard]] PathExtent extended_by(std::span<const double> q, std::span<const double> v, double h,
                                       double tolerance) const;
  void adopt(const PathExtent& next);
  /// The same at time t, which a first step, see IdaStepper, must advance.
  void adopt_for_first_step(PathExtent next, double t, double tolerance);
  /// A rounding of the coordinate farthest from 0.
  [[nodiscard]] double largest_rounding(std::span<const double> q) const;
  /// Roundings of a difference of positions, at least one: far from the origin as many as these are farther
  /// off than `length`.
  [[nodiscard]] double roundings_of_difference(std::span<const double> q) const;
  /// How far from its constraints round-off alone may leave a state.
  [[nodiscard]] double rounding(std::span<const double> q) const;
};

}  // namespace dalembert
