#pragma once

#include <dalembert/models/model.h>

namespace dalembert::models {

/// A scene of one disk rolling on the left of a straight track in the plane.
struct DiskOnTrack {
  Scene<2> scene;
  Particle<2> centre;
  Rotor wheel;
  Constraint<1> contact;  ///< PointLineDistance: its multiplier is the normal force, positive off the track
  Constraint<1> grip;     ///< Rolling: its multiplier is the friction on the disk along the track
};

/// What a disk is and how it starts.
struct DiskState {
  double mass, radius, inertia;
  Vec<2> position, velocity;
  double angular_velocity;  ///< counter-clockwise [rad/time]
};

/// A disk on the track through the origin and `ahead`, a point.
template <Point P>
[[nodiscard]] DiskOnTrack disk_on_track(const std::string& name, const DiskState& disk, const P& ahead) {
  DiskOnTrack built{.scene = Scene<2>(name), .centre = {}, .wheel = {}, .contact = {}, .grip = {}};
  built.centre = built.scene.add_particle({disk.mass, disk.position, disk.velocity});
  built.wheel = built.scene.add_rotor(
      {.inertia = disk.inertia, .angle = 0.0, .angular_velocity = disk.angular_velocity});
  built.contact = built.scene.add(PointLineDistance{built.centre, Fixed<2>{}, ahead, disk.radius});
  built.grip = built.scene.add(Rolling{built.centre, built.wheel, Fixed<2>{}, ahead, disk.radius});
  return built;
}

/// Observes the centre, and the friction along the track and the normal force.
[[nodiscard]] Observed<2> observed(DiskOnTrack built);

}  // namespace dalembert::models
