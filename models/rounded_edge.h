#pragma once

#include <dalembert/dalembert.h>

#include <cmath>
#include <numbers>

namespace dalembert::models {

/// The edge of a table, y = 0 for x < 0, and its wall, x = 0 for y < 0, rounded over some lengths R:
///
///   g = R log(e^(x/R) + e^(y/R)) = 0                                                            (1)
///
/// R e^(-|x|/R) is all that it differs by from the table at x, and likewise from the wall. An arc between two
/// straight lines would do, but its curvature jumps at either end, and with it the force on every bead that
/// comes by, a discontinuity that an integrator has to find each time; (1) is analytic. grad g = (u, 1 - u),
/// u = e^(x/R), is a unit vector on table and wall and 1/sqrt 2 long between.
///
/// With d = (x - y)/R the slope is tan theta = u/(1 - u) = e^d, theta from 0 on the table to pi/2 on the
/// wall, and
///
///   x = -R log(1 + e^-d),   y = -R log(1 + e^d),
///   curvature = sin theta cos theta (sin theta + cos theta)/R   <= 1/(sqrt 2 R),                (2)
///   int curvature^2 ds = int_0^(pi/2) curvature dtheta = 2/(3 R).                               (3)
///
/// The length s along it, counted so that s = -y on the wall, the depth, is, ds being dtheta over (2),
///
///   s/R = sqrt 2 asinh 1 - log 2 + 2 asinh(sqrt 2 sinh(d/2)) - sqrt 2 asinh(tanh(d/2)):         (4)
///
/// on the table s = x + sigma R with sigma = 2 sqrt 2 asinh 1 - 2 log 2 = 1.107, by which it is shorter than
/// the way through the corner. Where s = 0, theta = 24.9 degrees, is the place of the corner: from there down
/// it is as far as from the corner of a sharp edge.
struct RoundedEdge {
  double radius = 0.01;  ///< R [length]

  [[nodiscard]] static double shortcut() {  ///< sigma
    return 2.0 * std::numbers::sqrt2 * std::asinh(1.0) - 2.0 * std::numbers::ln2;
  }
  /// The part of (3) from s = 0 on: (1 + cos^3 theta - sin^3 theta)/2 there.
  static constexpr double curved_beyond_corner = 0.835;

  auto operator()(const auto& r) const { return radius * log(exp(r.x() / radius) + exp(r.y() / radius)); }

  [[nodiscard]] Vec<2> position(double d) const {
    return -radius * Vec<2>(std::log1p(std::exp(-d)), std::log1p(std::exp(d)));
  }
  /// s, of a place on it [length].
  [[nodiscard]] double along(const Vec<2>& place) const {
    const double half = 0.5 * (place.x() - place.y()) / radius;
    return radius * (0.5 * shortcut() + 2.0 * std::asinh(std::numbers::sqrt2 * std::sinh(half)) -
                     std::numbers::sqrt2 * std::asinh(std::tanh(half)));
  }
};

}  // namespace dalembert::models
