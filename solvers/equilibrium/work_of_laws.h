#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/rotating_frame.h>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The numbers of a vector.
inline std::span<double> flat(Eigen::VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }
inline std::span<const double> flat(const Eigen::VectorXd& x) {
  return {x.data(), static_cast<std::size_t>(x.size())};
}

/// A state on the constraints beside one that rests in a frame: the velocity X(q) of the frame, and two
/// velocities relative to it that the constraints allow.
struct RelativeState {
  Eigen::VectorXd q, frame, u, other;
};

/// Of a force, or of many: what it does, and the sum of the terms of that without signs.
struct Work {
  double power = 0.0, power_terms = 0.0;              ///< u.(F(q, X + u) - F(q, X))
  double circulation = 0.0, circulation_terms = 0.0;  ///< b.T u - u.T b, of the other velocity b

  Work& operator+=(const Work& more);
};

/// What the forces without a potential do on each uncoupled part of a scene, with T = F_q + F_v A at (q, X).
/// Those that read multipliers are left out.
class WorkOfLaws {
 public:
  /// A batch of forces, and one of them.
  using Force = std::pair<std::size_t, std::size_t>;
  struct OnPart {
    Work sum{};
    Force drives{}, brakes{}, circulates{};  ///< those with most power, least power, most circulation

   private:
    friend class WorkOfLaws;
    double most = 0.0, least = 0.0, most_circulation = 0.0;
    void add(const Work& work, const Force& by);
  };

  /// All must outlive this. `units` of the coordinates, to which round-off of positions is relative.
  WorkOfLaws(const System& system, const Islands& parts, const RotatingFrame& frame, Eigen::VectorXd units);

  /// Which parts they act on.
  [[nodiscard]] std::vector<char> parts() const;
  /// In parts that are marked the power of what is odd in u: -F(q, X - u) in place of -F(q, X). Throws
  /// EquationFault.
  [[nodiscard]] std::vector<OnPart> at(double t, const RelativeState& s,
                                       const std::vector<char>& only_odd) const;

 private:
  struct Velocities;

  const System* system_;
  const Islands* parts_;
  const RotatingFrame* frame_;
  Eigen::VectorXd units_;
  std::vector<std::size_t> laws_{};
};

}  // namespace dalembert
