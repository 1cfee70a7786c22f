#pragma once

#include <dalembert/models/model.h>

#include <array>
#include <span>
#include <vector>

namespace dalembert::models {

/// One link of Andrews' mechanism, in axes fixed in it from its first joint.
struct AndrewsLink {
  double mass, inertia;  ///< the inertia about the centre of mass
  Vec<2> centre;         ///< of mass
  Vec<2> joint;          ///< the second joint
  double angle;          ///< of its axes at the start
};

/// A scene of seven links.
struct AndrewsScene {
  Scene<2> scene;
  std::array<RigidBody<2>, 7> links;
  std::array<BodyPoint<2>, 7> joints;      ///< the second joint of each link: F, E, E, E, G, E, H
  std::array<Constraint<2>, 3> pins_at_E;  ///< of links 3, 4, 6 to link 2; multipliers: force on 3, 4, 6
};

/// Andrews' squeezing mechanism (IFToMM benchmark A03; Hairer and Wanner, Solving ODEs II, VII.7): seven
/// links with three closed loops, driven by a constant torque on the first, from rest.
///
/// Links with their first and second joint: 1 from O to F, 2 from F to E, 3 from B to E, 4 from G to E,
/// 5 from A to G, 6 from H to E, 7 from A to H; O, A, B are fixed. A spring pulls from C at the point
/// D of link 3. In the published angles the links are at
///
///   theta = (beta, beta + Theta, gamma, phi + delta, delta, Omega + epsilon, epsilon).
///
/// With R(theta) the rotation of a link, every point is a fixed one plus a sum of terms R(theta_k) s,
///
///   dr/dtheta_k = J R(theta_k) s   (J a quarter turn),   r'' = sum of J R s theta_k'' - R s theta_k'^2,
///
/// so Newton's and Euler's laws, projected on dr/dtheta_k, and the three ways to reach E,
///
///   E_3 - E_2 = 0,   E_4 - E_2 = 0,   E_6 - E_2 = 0,
///
/// differentiated twice, are 13 linear equations for theta'' and for the forces at E on links 3, 4, 6.
/// T + c_0 (l - l_0)^2/2 - torque beta is constant.
struct Andrews {
  double torque = 0.033;
  double stiffness = 4530.0, relaxed_length = 0.07785;  ///< c_0, l_0
  Vec<2> A{-0.06934, -0.00227}, B{-0.03635, 0.03273}, C{0.014, 0.072};
  Vec<2> D{0.02, -0.018};  ///< in the axes of link 3
  std::array<AndrewsLink, 7> links = published_links();

  [[nodiscard]] AndrewsScene scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;

  [[nodiscard]] static std::array<AndrewsLink, 7> published_links();
};

}  // namespace dalembert::models
