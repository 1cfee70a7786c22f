#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/equilibrium/uniform_rotation.h>

#include <memory>
#include <span>
#include <string>
#include <utility>

namespace dalembert {

struct UniformMotion;  // see uniform_motion.h

/// No equilibrium was found from a guess, or what was found does not persist; what() names the particle that
/// would move, or the constraint that does.
class NoEquilibrium : public Error {
  using Error::Error;
};

/// Which equilibrium to look for.
template <int D>
struct EquilibriumOptions {
  UniformRotation<D> turning{};  ///< zero: rest; else everything rotates with it, drives too
  double time = 0.0;             ///< of the state, for scenes that rotate or depend on time [time]
};

/// A state in which a scene remains, at rest or rotating uniformly, and the forces of constraint there.
template <int D>
class Equilibrium {
 public:
  /// One of rest or of a uniform rotation.
  Equilibrium(std::shared_ptr<const Record> state, const UniformRotation<3>& turning,
              std::string left_out = {})
      : state_(std::move(state)), turning_(turning), left_out_(std::move(left_out)) {}
  /// One along a symmetry, see `steady`.
  Equilibrium(std::shared_ptr<const Record> state, std::shared_ptr<const UniformMotion> motion)
      : state_(std::move(state)), motion_(std::move(motion)) {}
  Equilibrium(const Equilibrium&) = default;             ///< shares its numbers, also of one that is moved
  Equilibrium& operator=(const Equilibrium&) = default;  ///< shares its numbers

  /// Positions, velocities, multipliers and forces of constraint, by handle; see Sample. A view, valid as
  /// long as a copy of the Equilibrium is.
  [[nodiscard]] Sample<D> sample() const& { return {*state_->layout, state_->sample(0)}; }
  void sample() const&& = delete;  // keep the Equilibrium first
  /// The same as arrays, with the length in its statistics to which the search was relative, see Options.
  [[nodiscard]] const Record& record() const& { return *state_; }
  void record() const&& = delete;
  /// The motion of a steady one; null if its turning is all of it.
  [[nodiscard]] const UniformMotion* motion() const { return motion_.get(); }
  /// Its rotation, of one that `equilibrium` found; in the plane about an axis along z.
  [[nodiscard]] const UniformRotation<3>& turning() const { return turning_; }
  /// Whose velocities, stated in the scene, are not those of this equilibrium, in a sentence; empty if none.
  [[nodiscard]] const std::string& left_out() const { return left_out_; }
  /// Names and places of its numbers.
  [[nodiscard]] const Layout& layout() const& { return *state_->layout; }
  void layout() const&& = delete;

 private:
  std::shared_ptr<const Record> state_;
  UniformRotation<3> turning_{};
  std::string left_out_{};
  std::shared_ptr<const UniformMotion> motion_{};
};

namespace detail {
/// See Equilibrium::left_out, of velocities as a scene states them.
[[nodiscard]] std::string left_out(const Record& found, std::span<const double> stated);
}  // namespace detail

/// The same for a System, out of which `equilibrium` makes an Equilibrium; one sample.
[[nodiscard]] std::shared_ptr<const Record> find_equilibrium(System system, std::span<const double> guess,
                                                             double time, const UniformRotation<3>& turning);

/// The equilibrium near the initial positions of a scene, stable or not (see normal_modes):
///
///   F(t,q,v) + W^T lambda = M v',     g + C lambda = 0,     v = Omega x (r - p),  v' = Omega x v        (1)
///
/// with Omega = 0 for rest, else a relative equilibrium: the bead that a turning hoop holds up, a governor's
/// working angle, a circular orbit. Omega is then that of the drives or, where nothing is driven, the one
/// that is wanted.
///
/// Newton's iteration on (1) for q and lambda, with the curvature of the constraints, -sum lambda g_qq, while
/// it reduces the residual; along the forces no farther than into the valley they lead to; against them, to a
/// state that is not stable, only from so near that it converges. From where it does not, the scene descends
/// in steps of
///
///   (K + s M) dq = W^T dlambda + residual,     W dq = 0 (2)
///
/// along each of which the forces do work: with s large down the gradient, with s falling to 0 into Newton's
/// iteration (pseudo-transient continuation: Kelley, Keyes, SIAM J. Numer. Anal. 35, 1998); what is found is
/// then stable as a rule. Of a family of equilibria (free motions, nonholonomic constraints, along which a
/// scene moves as it descends), one near the guess is found. Forces of redundant constraints are those of
/// least norm, as in a run.
///
/// A scene's velocities are no part of the guess: at rest all are 0, else those of the turning. Which ones
/// were left out `left_out` says, and NormalModes::describe().
///
/// Throws NoEquilibrium where nothing is found, where what is found does not persist, because something moves
/// or rotates otherwise, and for forces that read multipliers: friction at rest takes any value up to a
/// limit. InconsistentStart if the constraints cannot be satisfied, InvalidArgument if `turning` or `time` is
/// not finite or a planar scene is to rotate about an axis other than its normal.
template <int D>
[[nodiscard]] Equilibrium<D> equilibrium(const Scene<D>& scene, const EquilibriumOptions<D>& options = {}) {
  auto found = find_equilibrium(scene.system(), scene.initial_positions(), options.time, options.turning);
  auto left_out = detail::left_out(*found, scene.initial_velocities());
  return {std::move(found), options.turning, std::move(left_out)};
}

}  // namespace dalembert
