#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

namespace dalembert {

/// A plane of b slides and turns in a plane of a.
///
///   g = (z_a . (c_b - c_a),  -y_a . z_b,  x_a . z_b)      [length, rad]
///
/// for unit vectors with z normal to the plane. Multipliers: the force on b along z_a, at c_b, and the
/// torques on b about x_a and y_a.
template <class A, class B>
struct Planar {
  static_assert(A::dimension == 3, "Planar is spatial");
  static constexpr std::string_view kind = "Planar";
  static constexpr std::string_view meaning =
      "force on the second body along the normal, then torques about the two axes across it";
  static constexpr bool turns = true;
  JointFrames<A, B> frames;

  /// Point and normal are where they are in space when the bodies are added.
  Planar(const A& a, const B& b, const Vec<3>& point, const Vec<3>& normal)
      : frames(a, b, point, detail::joint_axes(normal)) {}

  auto points() const {
    const auto& a = frames.a;
    const auto& b = frames.b;
    return std::tie(a.origin, a.axes[0], a.axes[1], a.axes[2], b.origin, b.axes[2]);
  }
  [[nodiscard]] Sketch sketch() const { return {"slider"}; }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& z_a, const auto& c_b,
                  const auto& z_b) const {
    const double l = frames.length, l2 = l * l;
    return vec(z_a.dot(c_b - c_a) / l, -y_a.dot(z_b) / l2, x_a.dot(z_b) / l2);
  }
  [[nodiscard]] std::string fault() const { return frames.fault("its normal must be finite and not zero"); }
};

}  // namespace dalembert
