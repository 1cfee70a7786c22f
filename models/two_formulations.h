#pragma once

#include <dalembert/dalembert.h>

#include <functional>
#include <string>
#include <vector>

namespace dalembert::models {

/// A system that is stated twice, so that one statement checks the other.
struct TwoFormulations {
  std::string model;  ///< as in the catalogue
  std::string notes;
  std::string what;  ///< what is compared with what
  /// The largest difference of motion, and of forces of constraint where both give them, relative to the
  /// scene's length, speeds and forces.
  std::function<double(const Options&)> difference;
};

/// Particles with constraints and multipliers against Lagrange's equations of as many coordinates as there
/// are degrees of freedom (notes, mln5, mln8), for every system whose Lagrangian the notes give. Each
/// Lagrangian stands in the header of its model; those that do not:
///
///   plane pendulum   m/2 l^2 phi'^2 + m g l cos phi
///   double pendulum  (m1 + m2) l1^2 p1'^2/2 + m2 l2^2 p2'^2/2 + m2 l1 l2 p1' p2' cos(p1 - p2)
///                    + (m1 + m2) g l1 cos p1 + m2 g l2 cos p2
///   sliding pivot    (M + m)/2 x'^2 + m/2 (L^2 phi'^2 + 2 L x' phi' cos phi) + m g L cos phi
///   hoop about an external axis   m/2 [R^2 (theta' + Omega)^2 + 2 R l Omega (theta' + Omega) cos theta]
///   hoop about its diameter       m/2 R^2 (phi'^2 + Omega^2 sin^2 phi) + m g R cos phi
///   driven pivot     m/2 |p' + l phi' (cos phi, sin phi)|^2 - m g (p_y - l cos phi),  p the pivot
///   disk on a turning track       m/2 [(q' - r omega)^2 + omega^2 q^2] + I/2 (omega - q'/r)^2
[[nodiscard]] std::vector<TwoFormulations> cross_checks();

/// Lagrangians that look different and have the same motion:
///
///   mex21   L and L + dF/dt, F(t, q) any function
///   mex22   m^2 x'^4/12 + m x'^2 W - W^2 and m x'^2/2 - W: Lagrange's equation of the former is that of the
///           latter times 2 (m x'^2/2 + W), for three W
///   mex79   the same L in other coordinates: polar ones, and those of a turning frame
///   mex115  L and the Routhian of what is left without a cyclic coordinate
[[nodiscard]] std::vector<TwoFormulations> equivalent_lagrangians();

}  // namespace dalembert::models
