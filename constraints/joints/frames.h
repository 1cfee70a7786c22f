#pragma once

#include <dalembert/constraints/bodies/orthonormal.h>
#include <dalembert/constraints/bodies/rigid_body.h>
#include <dalembert/core/equations/constraint.h>

#include <array>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

/// What all joints have in common: how two bodies carry the frame of a joint.
namespace dalembert {

/// What is at rest, as a body of a joint: `Revolute{Ground<3>{}, door, point, axis}`.
template <int D>
struct Ground {
  static constexpr int dimension = D;
};

/// A vector that never turns; in an equation it stands beside those of bodies. It is no place, so it does
/// not count as one where the scene is measured: unlike Fixed it is made of (no) particles.
template <int D>
struct FixedVector {
  static constexpr int dimension = D;
  static constexpr int inputs = 0;
  static constexpr int coordinates = 0;
  static constexpr bool driven = false;
  static constexpr std::array<Particle<D>, 0> particles{};  ///< none: the ground has no particles

  Vec<D> position = Vec<D>::Zero();  ///< of its origin; it does not matter
};

/// The frame of a joint as one body carries it (a marker): its point, and its axes as vectors.
template <class Body>
struct JointFrame;

template <int D>
struct JointFrame<RigidBody<D>> {
  BodyPoint<D> origin;
  std::array<BodyPoint<D>, static_cast<std::size_t>(D)> axes;

  static JointFrame at(const RigidBody<D>& body, const Vec<D>& place, const Mat<D, D>& axes) {
    if (!place.allFinite() || !axes.allFinite()) return {};  // its joint has a `fault`
    JointFrame frame{body.point_at(place), {}};
    for (int k = 0; k < D; ++k) frame.axes[static_cast<std::size_t>(k)] = body.vector_along(axes.col(k));
    return frame;
  }
};

template <int D>
struct JointFrame<Ground<D>> {
  Fixed<D> origin;
  std::array<FixedVector<D>, static_cast<std::size_t>(D)> axes;

  static JointFrame at(const Ground<D>& /*ground*/, const Vec<D>& place, const Mat<D, D>& axes) {
    JointFrame frame{{place}, {}};
    for (int k = 0; k < D; ++k) frame.axes[static_cast<std::size_t>(k)].position = axes.col(k);
    return frame;
  }
};

namespace detail {

template <class Body>
inline constexpr bool moves = true;
template <int D>
inline constexpr bool moves<Ground<D>> = false;
/// Whether a joint may hold it.
template <class Body>
inline constexpr bool has_axes =
    !moves<Body> || requires(const Body& its, const Vec<Body::dimension>& place) {
  its.point_at(place);
};

/// Axes x, y, z with z along a direction.
[[nodiscard]] Mat<3, 3> joint_axes(const Vec<3>& direction);
/// x along a direction of the plane, y turned left.
[[nodiscard]] Mat<2, 2> joint_axes(const Vec<2>& direction);
/// z along an axis, x along the part of `across` that is across it.
[[nodiscard]] Mat<3, 3> axes_across(const Vec<3>& axis, const Vec<3>& across);
/// x along a direction, y along another at a right angle to it.
[[nodiscard]] Mat<3, 3> axes_of_two(const Vec<3>& along_x, const Vec<3>& along_y);

}  // namespace detail

/// The frames of a joint between two bodies, or a body and the ground. They are stated in space, where the
/// bodies are when they are added; each body carries its own from there on, and the joint's equations say how
/// the two may separate. (Stated in either body's coordinates, the user would have to rotate them.)
///
/// The axes are vectors of length `length`, the size of a body of the joint, so that an equation between them
/// has its force at that length: with unit vectors torques would be weighted against forces by the choice of
/// units wherever joints are redundant (see detail::forces_at_points).
template <class A, class B>
struct JointFrames {
  static constexpr int dimension = A::dimension;
  static_assert(A::dimension == B::dimension, "the bodies of a joint have the dimension of its scene");
  static_assert(detail::moves<A> || detail::moves<B>, "a joint needs a body that can move");
  static_assert(detail::has_axes<A> && detail::has_axes<B>,
                "a joint holds bodies of add_body: pin points of a ThinRod or Lamina by Coincident");
  using First = A;                         ///< the first body's type
  using Second = B;                        ///< the second body's type
  using Axes = Mat<dimension, dimension>;  ///< a rotation matrix

  Vec<dimension> place;  ///< of b's frame, when the bodies were added
  Axes stated;           ///< the axes then; columns
  double length;         ///< [length]
  JointFrame<A> a;       ///< on the first body
  JointFrame<B> b;       ///< on the second body

  /// Both frames at one place of space.
  JointFrames(const A& body_a, const B& body_b, const Vec<dimension>& at, const Axes& axes)
      : JointFrames(body_a, at, body_b, at, axes) {}
  /// Each frame at a place of its body.
  JointFrames(const A& body_a, const Vec<dimension>& at_a, const B& body_b, const Vec<dimension>& at_b,
              const Axes& axes)
      : place(at_b),
        stated(axes),
        length(size(body_a, body_b)),
        a(JointFrame<A>::at(body_a, at_a, length * axes)),
        b(JointFrame<B>::at(body_b, at_b, length * axes)) {}

  // What equations of joints act on.
  /// x_a, y_a, x_b, of which the angle about the axis is made.
  auto turning() const { return std::tie(a.axes[0], a.axes[1], b.axes[0]); }
  /// In space c_a, x_a, y_a, c_b, z_b: the places, and the directions that keep z_b along z_a.
  auto axis() const { return std::tie(a.origin, a.axes[0], a.axes[1], b.origin, b.axes[2]); }
  /// In space c_a, x_a, y_a, c_b, x_b, z_b, in the plane c_a, y_a, c_b, x_b: besides, those that keep x_b
  /// along x_a.
  auto whole() const {
    if constexpr (dimension == 2) {
      return std::tie(a.origin, a.axes[1], b.origin, b.axes[0]);
    } else {
      return std::tie(a.origin, a.axes[0], a.axes[1], b.origin, b.axes[0], b.axes[2]);
    }
  }

  /// What is wrong with it, if anything is; `axes` names what its user stated them by.
  [[nodiscard]] std::string fault(const char* axes) const {
    if (!place.allFinite()) return "its point must be finite";
    if (!detail::orthonormal(stated)) return axes;
    if constexpr (detail::moves<A> && detail::moves<B>) {
      if (a.origin.particles == b.origin.particles) return "joins a body with itself";
    }
    if (!(length > 0.0)) return "a body of it was never added; use what add_body returned";
    return {};
  }

 private:
  [[nodiscard]] static double size(const A& body_a, const B& body_b) {
    if constexpr (detail::moves<B>) {
      return body_b.arms.norm();
    } else {
      return body_a.arms.norm();
    }
  }
};

namespace detail {

/// A joint, itself or by what add_joint returned for it.
template <class J>
[[nodiscard]] const auto& joint_of(const J& of) {
  if constexpr (requires { of.joint; }) {
    return of.joint;
  } else {
    return of;
  }
}
template <class J>
[[nodiscard]] const auto& frames_of(const J& of) {
  return joint_of(of).frames;
}
template <class J>
using JointType = std::remove_cvref_t<decltype(joint_of(std::declval<const J&>()))>;

/// Whether the bodies of a joint turn against each other about the axis of its frames, and slide along it.
template <class J>
inline constexpr bool turns = requires {
  requires JointType<J>::turns;
};
template <class J>
inline constexpr bool slides = requires {
  requires JointType<J>::slides;
};

/// The frames of a joint that turns, that slides.
template <class J>
[[nodiscard]] const auto& turning_frames(const J& of) {
  static_assert(turns<J>, "its joint must turn about its axis: Revolute, Cylindrical, Planar, Screw");
  return frames_of(of);
}
template <class J>
[[nodiscard]] const auto& sliding_frames(const J& of) {
  static_assert(slides<J>, "its joint must slide along its axis: Prismatic, Cylindrical, Screw");
  return frames_of(of);
}

template <class J>
using FramesOf = std::remove_cvref_t<decltype(frames_of(std::declval<const J&>()))>;
template <class J>
using BodyA = typename FramesOf<J>::First;
template <class J>
using BodyB = typename FramesOf<J>::Second;

}  // namespace detail

}  // namespace dalembert
