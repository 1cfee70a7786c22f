#pragma once

#include <dalembert/constraints/bodies/motion.h>
#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A joint of a scene, as returned by add_joint: a handle to its multipliers, and what reads its reaction
/// and its motion.
template <class J>
struct Joint : Constraint<rows_of_constraint<J>> {
  J joint;
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
  Vec<D> force;    ///< along the axes of space
  Turn<D> torque;  ///< about b's point of the joint, along the axes of space
};

namespace detail {

/// The resultant of a constraint's forces on a body, and their moment about a point.
template <int D, int Rows>
[[nodiscard]] Reaction<D> resultant(const Sample<D>& sample, Constraint<Rows> constraint,
                                    const BodyPoint<D>& of_body, const Vec<D>& about) {
  const Vec<D> zero = Vec<D>::Zero();
  Reaction<D> sum{zero, moment(zero, zero)};
  for (const auto& p : of_body.particles) {
    const Vec<D> Z = sample.constraint_force(constraint, p);
    sum.force += Z;
    sum.torque += moment(Vec<D>(sample.position(p) - about), Z);
  }
  return sum;
}

template <int D, Point P>
[[nodiscard]] Vec<D> position_of(const Sample<D>& sample, const P& point) {
  if constexpr (P::inputs == 0) {
    return point.position;
  } else {
    return sample.position(point);
  }
}
template <int D, Point P>
[[nodiscard]] Vec<D> velocity_of(const Sample<D>& sample, const P& point) {
  if constexpr (P::inputs == 0) {
    return Vec<D>::Zero();
  } else {
    return sample.velocity(point);
  }
}

}  // namespace detail

/// Throws like Sample::constraint_force.
template <int D, class J>
[[nodiscard]] Reaction<D> reaction(const Sample<D>& sample, const Joint<J>& joint) {
  const auto& a = joint.joint.frames.a;
  const auto& b = joint.joint.frames.b;
  const Vec<D> about = detail::position_of<D>(sample, b.origin);
  const Constraint<rows_of_constraint<J>>& constraint = joint;
  if constexpr (requires { b.origin.particles; }) {
    return detail::resultant(sample, constraint, b.origin, about);
  } else {
    const Reaction<D> on_a = detail::resultant(sample, constraint, a.origin, about);
    return {-on_a.force, -on_a.torque};
  }
}

/// The angle by which b has turned against a since they were added, about the joint's axis, between -pi and
/// pi [rad].
template <int D, class J>
[[nodiscard]] double angle(const Sample<D>& sample, const Joint<J>& joint) {
  const auto& a = joint.joint.frames.a;
  const auto& b = joint.joint.frames.b;
  return detail::angle_between(detail::position_of<D>(sample, a.axes[0]),
                               detail::position_of<D>(sample, a.axes[1]),
                               detail::position_of<D>(sample, b.axes[0]));
}

/// The rate of that angle [rad / time].
template <int D, class J>
[[nodiscard]] double angular_velocity(const Sample<D>& sample, const Joint<J>& joint) {
  const auto& a = joint.joint.frames.a;
  const auto& b = joint.joint.frames.b;
  return detail::rate_of_angle(
      detail::position_of<D>(sample, a.axes[0]), detail::position_of<D>(sample, a.axes[1]),
      detail::position_of<D>(sample, b.axes[0]), detail::velocity_of<D>(sample, a.axes[0]),
      detail::velocity_of<D>(sample, a.axes[1]), detail::velocity_of<D>(sample, b.axes[0]));
}

/// How far b's point has moved from a's along the joint's axis (in the plane its direction) [length].
template <int D, class J>
[[nodiscard]] double travel(const Sample<D>& sample, const Joint<J>& joint) {
  const auto& a = joint.joint.frames.a;
  const auto& b = joint.joint.frames.b;
  const Vec<D> along = detail::position_of<D>(sample, a.axes[detail::along<D>]);
  return along.dot(detail::position_of<D>(sample, b.origin) - detail::position_of<D>(sample, a.origin)) /
         joint.joint.frames.lever;
}

}  // namespace dalembert
