#pragma once

#include <dalembert/models/disk_on_track.h>

#include <numbers>

namespace dalembert::models {

/// Disk of inertia I = c m r^2 rolling on an incline of angle alpha, up at first and down again (notes,
/// mln76). Although written as a constraint on velocities, rolling on a line is integrable: holonomic.
///
/// With s along e = (cos alpha, -sin alpha), downhill, the normal n = (sin alpha, cos alpha), and the disk
/// turning by phi' = -s'/r, Newton's law along e and n and for the turning is
///
///   m s'' = m g sin alpha + f,     0 = N - m g cos alpha,     I phi'' = r f.
///
/// The last gives f = -c m s'', hence
///
///   s'' = g sin alpha/(1 + c),   friction f = -c/(1 + c) m g sin alpha,   normal force N = m g cos alpha:
///
/// two thirds of the frictionless acceleration and a third of the downhill pull for a disk, c = 1/2.
struct DiskOnIncline {
  double mass = 1.0;
  double radius = 0.5;
  double inertia_ratio = 0.5;  ///< c = I/(m r^2): 1/2 for a disk, 1 for a hoop
  double gravity = 9.81;
  double slope = std::numbers::pi / 6;  ///< alpha [rad]
  double speed = -3.0;                  ///< s' at t = 0, < 0 uphill [length/time]

  [[nodiscard]] DiskOnTrack scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;  ///< forces: f, N
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
