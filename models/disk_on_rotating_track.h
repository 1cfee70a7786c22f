#pragma once

#include <dalembert/models/disk_on_track.h>

namespace dalembert::models {

/// Disk of inertia I = c m r^2 rolling on a straight track that turns at the rate omega in a horizontal
/// plane, about a point of the track (notes, mex116); the disk starts at rest relative to it.
///
/// With e along the track, n = e turned left, q the place of the contact along it, the centre is q e + r n:
///
///   v = (q' - r omega) e + omega q n,     a = (q'' - omega^2 q) e + (2 omega q' - omega^2 r) n.
///
/// The track's own point at the contact moves with omega q n, so rolling is phi' = omega - q'/r. With
/// friction f along e and normal force N along n,  m a = f e + N n  and  I phi'' = r f  give f = -c m q'' and
///
///   (1 + c) q'' = omega^2 q,   q = q0 cosh(omega t/sqrt(1 + c)),
///   friction f = -c/(1 + c) m omega^2 q,     normal force N = m (2 omega q' - omega^2 r):
///
/// for a disk (c = 1/2) 3/2 q'' = omega^2 q and f = -m omega^2 q/3. At first N < 0: the track holds the disk
/// back. Only N does work, with the power N omega q.
struct DiskOnRotatingTrack {
  double mass = 1.0;
  double radius = 0.2;
  double inertia_ratio = 0.5;  ///< c = I/(m r^2): 1/2 for a disk, 1 for a hoop
  double spin = 1.0;           ///< omega [rad/time]
  double start = 1.0;          ///< q0 [length], > 0

  [[nodiscard]] DiskOnTrack scene() const;
  [[nodiscard]] Observation<2> reference(double t) const;  ///< forces: f, N
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
