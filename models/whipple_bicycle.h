#pragma once

#include <dalembert/dalembert.h>

#include <Eigen/Core>

namespace dalembert::models {

/// The bicycle upright, and how its lateral motion is read.
struct WhippleScene {
  Scene<3> scene;
  RigidBody<3> frame;  ///< the rear one, with its rider
  ::dalembert::Joint<Revolute<RigidBody<3>, RigidBody<3>>> head;

  [[nodiscard]] double lean(const Sample<3>& at) const;   ///< of the frame, to the right [rad]
  [[nodiscard]] double steer(const Sample<3>& at) const;  ///< of the fork, to the right [rad]
};

/// Whipple's bicycle with the benchmark's parameters: Meijaard, Papadopoulos, Ruina, Schwab, Proc. R. Soc. A
/// 463 (2007) 1955, table 1, as rigid bodies with three hinges and two wheels that roll. (There y is to the
/// right and z is down: products of inertia change their sign here, where z is up.)
///
/// Its lean and steer (phi, delta) obey, up to terms of third order,
///
///   M q'' + v C1 q' + (g K0 + v^2 K2) q = 0
///
/// with the matrices that the paper prints in 14 digits. Those of its table 2 are their eigenvalues.
struct WhippleBicycle {
  double speed = 5.0;
  double lean_rate = 0.0;  ///< about the line of contact, at first [rad / time]

  static constexpr double gravity = 9.81;
  static constexpr double weave_speed = 4.29238253634111;    ///< stable from here
  static constexpr double capsize_speed = 6.02426201538837;  ///< to here

  [[nodiscard]] WhippleScene scene() const;
  /// Of (q, q')' = A (q, q').
  [[nodiscard]] Eigen::Matrix4d published() const;
};

}  // namespace dalembert::models
