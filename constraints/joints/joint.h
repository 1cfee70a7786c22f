#pragma once

#include <dalembert/constraints/bodies/motion.h>
#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A joint of a scene, as returned by add_joint: a handle to its multipliers, and what reads its reaction
/// and its motion. It holds the joint as it was added: after Scene::replace it is to be made anew,
/// `hinge = {hinge, other}`.
template <class J>
struct Joint : Constraint<rows_of_constraint<J>> {
  J joint;  ///< as it was added
};

/// Adds a joint to a scene, or anything else with frames (a drive, a gear):
///
///   const auto hinge = add_joint(scene, Revolute{Ground<3>{}, door, {0, 0, 0}, {0, 0, 1}}, "hinge");
///   ...
///   const Reaction<3> on_door = reaction(run.sample(i), hinge);
///
/// Throws like Scene::add, which adds it too but returns the handle alone.
template <class J>
Joint<J> add_joint(Scene<decltype(J::frames)::dimension>& scene, const J& joint,
                   const std::string& name = {}) {
  return {scene.add(joint, name), joint};
}

/// What a joint exerts on its body b; a gets the opposite, at the same point.
template <int D>
struct Reaction {
  Vec<D> force;        ///< along the axes of space
  MomentOf<D> torque;  ///< about b's point of the joint, along the axes of space
};

/// Throws like Sample::constraint_force.
template <int D, class J>
[[nodiscard]] Reaction<D> reaction(const Sample<D>& sample, const Joint<J>& joint) {
  const auto& a = joint.joint.frames.a;
  const auto& b = joint.joint.frames.b;
  const Vec<D> about = sample.position(b.origin);
  const Constraint<rows_of_constraint<J>>& constraint = joint;
  if constexpr (requires { b.origin.particles; }) {
    return {sample.constraint_force(constraint, b.origin),
            sample.constraint_moment(constraint, b.origin, about)};
  } else {
    return {-sample.constraint_force(constraint, a.origin),
            -sample.constraint_moment(constraint, a.origin, about)};
  }
}

/// The angle by which b has turned against a since they were added, about the joint's axis, between -pi and
/// pi [rad].
template <int D, class J>
[[nodiscard]] double angle(const Sample<D>& sample, const Joint<J>& joint) {
  return std::apply([&](const auto&... axes) { return detail::angle_between(sample.position(axes)...); },
                    detail::turning_frames(joint).turning());
}

/// The rate of that angle [rad / time].
template <int D, class J>
[[nodiscard]] double angular_velocity(const Sample<D>& sample, const Joint<J>& joint) {
  return std::apply(
      [&](const auto&... axes) {
        return detail::rate_of_angle(sample.position(axes)..., sample.velocity(axes)...);
      },
      detail::turning_frames(joint).turning());
}

/// How far b's point has moved from a's along the joint's axis (in the plane its direction) [length].
template <int D, class J>
[[nodiscard]] double travel(const Sample<D>& sample, const Joint<J>& joint) {
  const auto& frames = detail::sliding_frames(joint);
  const Vec<D> along = sample.position(frames.a.axes[detail::along<D>]);
  return along.dot(sample.position(frames.b.origin) - sample.position(frames.a.origin)) / frames.length;
}

}  // namespace dalembert
