#pragma once

#include <dalembert/models/bead_on_curve.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// Block on a straight line, tied to a point P off the line by an elastic string (notes, mex251a), without
/// gravity. The string of stiffness k and relaxed length l0 is stretched to d > l0 (3 l0/2 in the notes)
/// where the block is at rest, the foot of the perpendicular from P.
///
/// With x along the line, R = sqrt(d^2 + x^2) >= d the string never goes slack and pulls with k (R - l0):
///
///   m x'' = -k (R - l0) x/R,     force of the line = k (R - l0) d/R, away from P,
///
/// k (d - l0) at rest, k l0/2 in the notes. For small x, -k (R - l0) x/R = -k (1 - l0/d) x - k l0 x^3/(2 d^3)
/// + ..., so omega^2 = (k/m)(1 - l0/d), k/(3m) in the notes, and the stiffening x^3 shortens the period to
/// (2 pi/omega)(1 - 3/16 (l0/d)/(1 - l0/d) (a/d)^2 + ...) for the amplitude a.
struct ElasticStringLine {
  double mass = 1.0;
  double stiffness = 30.0;      ///< k [force/length]
  double relaxed_length = 1.0;  ///< l0
  double stretch = 1.5;         ///< d/l0, > 1
  double amplitude = 1.0;       ///< x at t = 0, at rest [length]

  [[nodiscard]] BeadOnCurve scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
