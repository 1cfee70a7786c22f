#pragma once

#include <dalembert/solvers/equilibrium/equilibrium.h>
#include <dalembert/solvers/equilibrium/steady.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dalembert {

/// A scene at one value of a parameter, and its rotation there.
template <int D>
struct Posed {
  Scene<D> scene;                   ///< at this value
  EquilibriumOptions<D> options{};  ///< with its rotation
};

/// The range of the parameter over which equilibria are followed.
struct BranchOptions {
  double from = 0.0, to = 0.0;  ///< finite and different
  /// The arclength of a step, in units of the scene's length and the range: finer steps miss less. Between
  /// 1e-4 and 0.5.
  double step = 0.02;
};

/// An equilibrium at one value of the parameter; State is an Equilibrium<D>.
template <class State>
struct BranchPoint {
  double parameter;  ///< its value here
  State state;       ///< the equilibrium here
  /// The lowest eigenvalue of the stiffness K on the tangent space, over the masses (see normal_modes), free
  /// motions at a state of rest included: below 0 the stiffness is not definite. With circulatory forces the
  /// lowest real part [1 / time^2]. Of a steady motion see `follow_steady`.
  double softest;
  double frequency = 0.0;  ///< at a flutter, of the vibration [rad / time]
};

/// The number of no bifurcation.
inline constexpr std::size_t no_bifurcation = std::numeric_limits<std::size_t>::max();

/// Why a branch ends.
enum class BranchEnd {
  range,       ///< the parameter would leave its range
  closed,      ///< it has returned to where it began
  lost,        ///< no further point was found: less is known than was asked for
  most_points  ///< 5,000 were: `step` is too short for its length
};

/// Connected equilibria; the first branch begins at the scene's own equilibrium at `from`.
template <class State>
struct Branch {
  std::vector<BranchPoint<State>> points;  ///< in their order
  std::size_t origin = no_bifurcation;     ///< the bifurcation where it emanates, if it does
  BranchEnd end = BranchEnd::lost;         ///< why it ends
  /// Of `lost`: where, and what failed there, or that others were too many to follow this one. Of any: before
  /// that where a change of stability was not located, and where more eigenvalues vanish at once than are
  /// looked into.
  std::string why{};
};

template <class State>
struct Diagram {
  std::vector<Branch<State>> branches;
  std::vector<BranchPoint<State>> bifurcations;  ///< where branches intersect
  std::vector<BranchPoint<State>> folds;         ///< where a branch turns back: the parameter is extreme
  /// Where a vibration begins to grow, or ceases to; with frequency 0, of nonholonomic scenes, a motion that
  /// does not vibrate and leads to no other branch.
  std::vector<BranchPoint<State>> flutters{};
};

/// For Systems, out of which `follow_branches` makes branches of Equilibrium<D>.
struct PosedSystem {
  std::shared_ptr<const System> system;  ///< its equations
  std::vector<double> guess;             ///< of its coordinates
  double time;                           ///< of the state [time]
  UniformRotation<3> turning;            ///< zero: rest
  std::vector<double> speeds{};          ///< of a steady motion: the guess of its velocities
  std::vector<FlatKept> keep{};          ///< and what is to stay as stated
};
struct FlatEquilibrium {
  std::shared_ptr<const Record> state;
  UniformRotation<3> turning;
  std::shared_ptr<const UniformMotion> motion{};

  template <int D>
  [[nodiscard]] Equilibrium<D> read(std::shared_ptr<const Record> record) const {
    if (motion) return {std::move(record), motion};
    return {std::move(record), turning};
  }
};
using FlatDiagram = Diagram<FlatEquilibrium>;  ///< without dimension
/// The same as `follow_branches` for Systems.
[[nodiscard]] FlatDiagram find_branches(const std::function<PosedSystem(double)>& pose,
                                        const BranchOptions& options);

namespace detail {

/// A point's own layout, with its own masses and forces, read by the handles of another of the same elements.
[[nodiscard]] std::shared_ptr<const Layout> read_by(const Layout& handles, const Layout& own);

/// The same points as Equilibrium<D>, read by the handles of `layout`.
template <int D>
[[nodiscard]] std::vector<BranchPoint<Equilibrium<D>>> read_by(
    const Layout& handles, const std::vector<BranchPoint<FlatEquilibrium>>& flat) {
  std::vector<BranchPoint<Equilibrium<D>>> points;
  for (const auto& one : flat) {
    auto record = std::make_shared<Record>(*one.state.state);
    record->layout = read_by(handles, *record->layout);
    points.push_back({one.parameter, one.state.read<D>(std::move(record)), one.softest, one.frequency});
  }
  return points;
}

template <int D>
[[nodiscard]] Diagram<Equilibrium<D>> read_by(const Layout& handles, const FlatDiagram& found) {
  Diagram<Equilibrium<D>> all;
  for (const auto& branch : found.branches)
    all.branches.push_back({read_by<D>(handles, branch.points), branch.origin, branch.end, branch.why});
  all.bifurcations = read_by<D>(handles, found.bifurcations);
  all.folds = read_by<D>(handles, found.folds);
  all.flutters = read_by<D>(handles, found.flutters);
  return all;
}

}  // namespace detail

/// Follows the equilibria of a scene as a parameter changes, `build(parameter)` being the Posed<D> scene:
/// along each branch by pseudo-arclength continuation, so that it may turn back (a fold); where a real
/// eigenvalue of the stiffness changes its sign, the point is located to round-off and the branches that
/// emanate there are followed too. (Keller, in Applications of Bifurcation Theory, 1977; Allgower, Georg,
/// Numerical Continuation Methods, 1990.) Where an equilibrium loses its stability to a vibration that grows
/// (follower forces, negative damping, gyroscopic forces) no branch of equilibria emanates: such points are
/// located likewise, see `flutters`. Each branch states why it ends, see BranchEnd. Up to 50 are followed;
/// the others are listed with their first point, as lost.
///
/// Equilibria that a symmetry of the scene carries into each other are one: a column that tilts in any
/// direction has one tilted branch. Symmetries are found from the equations, see `steady`: translations and
/// rotations that the frame keeps.
///
/// Where eigenvalues of several shapes vanish at once branches are sought along each shape, and of two shapes
/// along their bisectors.
///
/// Every value builds the scene anew; only numbers may differ. What is returned is read with the handles of
/// the scene that was built last: `build` may store them for its caller.
///
/// With nonholonomic constraints equilibria at rest are families: followed is the nearest of the next value,
/// and K is that of what may move.
///
/// Up to 600 coordinates. No scene is built outside of the range. Throws
/// InvalidArgument for invalid options, InvalidScene for scenes that are not suitable or whose first branch
/// has a fold at `from`, and what `equilibrium` throws there.
template <int D, class Build>
[[nodiscard]] Diagram<Equilibrium<D>> follow_branches(const Build& build, const BranchOptions& options) {
  std::shared_ptr<const System> last;
  const auto pose = [&](double parameter) {
    const Posed<D> posed = build(parameter);
    const auto q = posed.scene.initial_positions();
    last = std::make_shared<const System>(posed.scene.system());
    return PosedSystem{last, {q.begin(), q.end()}, posed.options.time, posed.options.turning};
  };
  const FlatDiagram found = find_branches(pose, options);
  return detail::read_by<D>(*last->layout(), found);
}

}  // namespace dalembert
