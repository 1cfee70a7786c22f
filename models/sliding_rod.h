#pragma once

#include <dalembert/models/model.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// A rod with one end on a track.
struct RodOnTrack {
  Scene<2> scene;
  RigidBody<2> rod;     ///< its first axis points from the sliding end to the free one
  BodyPoint<2> foot;    ///< the end that slides
  Constraint<1> track;  ///< its multiplier is the force of the track on the foot, positive upwards
};

/// Uniform rod (mass m, length l, I = m l^2/12) that topples while one end, its foot, slides on the x axis
/// (notes, mex115). The axis holds the foot only: the rod swings on below it.
///
/// With theta from upright, towards +x, the centre of mass is (x + (l/2) sin theta, (l/2) cos theta), x the
/// place of the foot. Nothing pushes along x: beta_x = m x' + (m l/2) theta' cos theta is conserved and the
/// centre moves with x_c' = beta_x/m. What is left of the Lagrangian (the Routhian, up to a constant),
///
///   R = (m l^2/24)(1 + 3 sin^2 theta) theta'^2 - (m g l/2) cos theta,
///
/// gives  l (1 + 3 sin^2 theta) theta'' = 3 sin theta (2 g - l theta'^2 cos theta).
/// Newton's law for the centre along y:
///
///   track force = m (g + y_c''),   y_c'' = -(l/2)(theta'' sin theta + theta'^2 cos theta).
struct SlidingRod {
  double mass = 1.0;
  double length = 1.0;
  double gravity = 9.81;
  double angle = 1.0;  ///< theta at t = 0, at rest [rad]
  double drift = 0.3;  ///< beta_x/m, the constant velocity of the centre along x [length/time]

  [[nodiscard]] RodOnTrack scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
