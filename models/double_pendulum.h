#pragma once

#include <dalembert/models/hanging_rods.h>

#include <numbers>
#include <span>
#include <vector>

namespace dalembert::models {

/// Double pendulum (notes, mex20): a second pendulum hung from the bob of the first, from rest.
///
/// With p1, p2 the angles from the downward vertical and d = p1 - p2, Lagrange's equations are
///
///   (m1 + m2) l1 p1'' + m2 l2 (p2'' cos d + p2'^2 sin d) + (m1 + m2) g sin p1 = 0
///   l2 p2'' + l1 (p1'' cos d - p1'^2 sin d) + g sin p2 = 0
///
/// with p2'' eliminated:
///
///   l1 (m1 + m2 sin^2 d) p1'' = -m2 sin d (l2 p2'^2 + l1 p1'^2 cos d)
///                               - (m1 + m2) g sin p1 + m2 g cos d sin p2.
///
/// Newton's law for the lower bob along its rod, then for the upper bob along its own, gives
///
///   T2 = m2 (g cos p2 + l2 p2'^2 + l1 p1'^2 cos d + l1 p1'' sin d)
///   T1 = m1 (g cos p1 + l1 p1'^2) + T2 cos d.
struct DoublePendulum {
  double mass1 = 1.0, mass2 = 1.0;      ///< of the upper and the lower bob
  double length1 = 1.0, length2 = 1.0;  ///< of the upper and the lower rod
  double gravity = 9.81;
  double angle1 = std::numbers::pi / 2;  ///< at t = 0 [rad]; pi/2 is horizontal
  double angle2 = std::numbers::pi / 2;

  [[nodiscard]] HangingRods scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
