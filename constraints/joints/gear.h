#pragma once

#include <dalembert/constraints/joints/equations.h>
#include <dalembert/constraints/joints/frames.h>

#include <numeric>

namespace dalembert {

/// Two gears in mesh, turning about parallel axes; in the plane or in space, where each needs its hinge. The
/// teeth of an internal gear (a ring) count negative.
///
/// With alpha the angle of the line of centres as gear a sees it and beta as b does,
///
///   g = r_a alpha + r_b beta,   r_a : r_b = teeth_a : teeth_b,   r_a + r_b = |c_b - c_a|,               (1)
///
/// modulo k teeth, k the greatest common divisor of their numbers: no turns are counted, so none are lost,
/// and a step does not lose a tooth. Gears that an event engages must have turned by a multiple of k teeth.
/// The angles are those from the line of centres, which may turn too: planets need nothing else, and the
/// multiplier is the force of the teeth at the pitch point, on b along axis x (c_b - c_a), on a the
/// opposite. (Angles against the ground would give a couple on each gear, and bearings without their load.
/// The component of a real tooth's force along the line of centres, by the angle of its flank, is left out.)
template <class A, class B>
struct Gear {
  static constexpr std::string_view kind = "Gear";
  static constexpr std::string_view meaning = "force of the teeth at the pitch point, on the second gear";
  static constexpr std::string_view singular = "the centres of its gears coincide";
  JointFrames<A, B> frames;  ///< at the centres, x along the line of centres
  double distance;           ///< of the centres across the axis [length]
  int teeth_a, teeth_b;      ///< not 0; negative of an internal gear

  /// Centres and the direction of the axes are those in space when the bodies are added.
  Gear(const A& a, const B& b, const Vec<3>& centre_a, const Vec<3>& centre_b, const Vec<3>& axis,
       int teeth_of_a, int teeth_of_b) requires(A::dimension == 3)
      : frames(a, centre_a, b, centre_b, detail::axes_across(axis, centre_b - centre_a)),
        distance(frames.stated.col(0).dot(centre_b - centre_a)),
        teeth_a(teeth_of_a),
        teeth_b(teeth_of_b) {}
  /// The same in the plane.
  Gear(const A& a, const B& b, const Vec<2>& centre_a, const Vec<2>& centre_b, int teeth_of_a,
       int teeth_of_b) requires(A::dimension == 2)
      : frames(a, centre_a, b, centre_b, detail::joint_axes(Vec<2>(centre_b - centre_a))),
        distance(frames.stated.col(0).dot(centre_b - centre_a)),
        teeth_a(teeth_of_a),
        teeth_b(teeth_of_b) {}

  auto points() const {
    const auto& a = frames.a;
    const auto& b = frames.b;
    return std::tie(a.origin, a.axes[0], a.axes[1], b.origin, b.axes[0], b.axes[1]);
  }
  [[nodiscard]] Sketch sketch() const {
    const double tooth = distance / (teeth_a + teeth_b);
    return {"gear", {std::abs(tooth * teeth_a), std::abs(tooth * teeth_b)}};
  }
  auto operator()(const auto& c_a, const auto& x_a, const auto& y_a, const auto& c_b, const auto& x_b,
                  const auto& y_b) const {
    const auto line = c_b - c_a;
    const int common = std::gcd(teeth_a, teeth_b);
    const auto phase = (teeth_a / common) * detail::angle_between(x_a, y_a, line) +
                       (teeth_b / common) * detail::angle_between(x_b, y_b, line);
    return distance / (teeth_a + teeth_b) * common * detail::out_of_mesh(phase);
  }
  [[nodiscard]] std::string fault() const {
    if (teeth_a == 0 || teeth_b == 0 || teeth_a + teeth_b == 0 || (teeth_a < 0 && teeth_b < 0)) {
      return "teeth = " + std::to_string(teeth_a) + " and " + std::to_string(teeth_b) +
             ", must not be 0, nor equal and opposite, and only those of one, the ring, negative";
    }
    return frames.fault("its centres and axis must be finite, the centres apart across the axis");
  }
};

}  // namespace dalembert
