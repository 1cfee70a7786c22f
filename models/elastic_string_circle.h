#pragma once

#include <dalembert/models/bead_on_curve.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// Block on a circle, tied to a point P in its plane by an elastic string (notes, mex251b), without gravity.
/// The string of stiffness k and relaxed length l0 is stretched to b > l0 (3 l0/2 in the notes) where the
/// block is at rest, the point of the circle nearest to P: P is d = r + b from the centre, or r - b.
///
/// With theta from there and R = sqrt(r^2 + d^2 - 2 r d cos theta) >= b the string never goes slack:
///
///   m r theta'' = -k (R - l0) (d/R) sin theta,
///   force of the circle = k (R - l0)(r - d cos theta)/R - m r theta'^2, outwards,
///
/// by Newton's law along the circle and along its radius. At rest it is k (b - l0), inwards if P is outside
/// and outwards if P is inside: k l0/2 in the notes. For small theta, with s = 1 - l0/b,
///
///   omega^2 = s (k/m)(d/r),     (k/3m)(d/r) in the notes, and
///   period = (2 pi/omega)(1 + [1 - 3 (l0/b) r d/(s b^2)] theta0^2/16 + ...).
struct ElasticStringCircle {
  /// Where the string is tied.
  enum class Tied { outside, inside };

  double mass = 1.0;
  double stiffness = 30.0;      ///< k [force/length]
  double relaxed_length = 1.0;  ///< l0
  double stretch = 1.5;         ///< b/l0, > 1
  double radius = 2.0;          ///< r, > b if P is inside
  Tied tied = Tied::outside;
  double angle = 1.0;  ///< theta at t = 0, at rest [rad]

  [[nodiscard]] double distance() const;  ///< d, of P from the centre
  [[nodiscard]] BeadOnCurve scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
