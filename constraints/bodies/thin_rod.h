#pragma once

#include <dalembert/constraints/bodies/body_rod.h>
#include <dalembert/core/points/body_point.h>
#include <dalembert/core/scene/scene.h>

#include <array>
#include <string>

namespace dalembert {

/// A uniform thin rod as its user states it, by its two ends.
template <int D>
struct ThinRodState {
  double mass = 0.0;                       ///< finite and > 0
  Vec<D> start = Vec<D>::Zero();           ///< one end [length]
  Vec<D> end = Vec<D>::Zero();             ///< another place than `start`
  Vec<D> start_velocity = Vec<D>::Zero();  ///< of `start`
  Vec<D> end_velocity = Vec<D>::Zero();    ///< of `end`; along the rod it must be that of `start`
};

/// A uniform thin rod, in the plane or in space: half its mass in each of two particles at
/// length/(2 sqrt 3) from its centre, held by a Distance. With r_c the centre and d = end - start,
///
///   T = m/2 (r_c'^2 + d'^2/12),    I = m length^2/12 across, 0 along,
///
/// is exactly the rod's. It has no inertia about its own axis and so no angle about it: two
/// degrees of freedom of rotation in space. Every point of its line is a constant linear map of the two
/// particles, so its ends can be pinned like any other point.
template <int D>
struct ThinRod {
  static constexpr int dimension = D;
  std::array<Particle<D>, 2> particles;  ///< half its mass each
  Constraint<1> distance;                ///< between the particles
  double length = 0.0;                   ///< from start to end

  /// The point at a fraction of the way from start (0) to end (1).
  [[nodiscard]] BodyPoint<D, 2> point(double fraction) const;
  /// Its end at `start`.
  [[nodiscard]] BodyPoint<D, 2> start() const { return point(0.0); }
  /// Its centre of mass.
  [[nodiscard]] BodyPoint<D, 2> centre() const { return point(0.5); }
  /// Its end at `end`.
  [[nodiscard]] BodyPoint<D, 2> end() const { return point(1.0); }
};

/// Adds a thin rod to a scene; its particles and its Distance are named after it. Throws InvalidScene
/// if its mass is not positive or its ends coincide.
template <int D>
ThinRod<D> add_thin_rod(Scene<D>& scene, const ThinRodState<D>& state, const std::string& name);

extern template struct ThinRod<2>;
extern template struct ThinRod<3>;

}  // namespace dalembert
