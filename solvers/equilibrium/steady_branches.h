#pragma once

#include <dalembert/solvers/equilibrium/branches.h>

namespace dalembert {

/// A scene at one value of a parameter, with the velocities there, and what of its steady motion is kept.
template <int D>
struct PosedSteady {
  Scene<D> scene;              ///< at this value
  SteadyOptions<D> options{};  ///< with the quantities that are kept
};

/// The same as `find_branches`, of steady motions.
[[nodiscard]] FlatDiagram find_steady_branches(const std::function<PosedSystem(double)>& pose,
                                               const BranchOptions& options);

/// Follows a steady motion as a parameter changes, a speed above all, `build(parameter)` being the
/// PosedSteady<D> scene. What it states is the guess, corrected by what the last point was corrected by;
/// `keep` has there the value that it has in the statement.
///
/// Every eigenvalue of the small motions is followed, see `normal_modes`: where a vibration begins to grow,
/// or ceases to, is in `flutters` (a bicycle's weave); where something grows without vibrating, in
/// `bifurcations` (its capsize; to other steady motions, which are not followed). All are located to the
/// round-off of eigenvalues. `softest` of a point is minus the fastest growth of all [1/time].
///
/// One value of the parameter has one point: where the branch turns back it is `lost`, and says so. Up to 600
/// coordinates. Throws InvalidArgument for invalid options and what `steady` throws at `from`.
template <int D, class Build>
[[nodiscard]] Diagram<Equilibrium<D>> follow_steady(const Build& build, const BranchOptions& options) {
  std::shared_ptr<const System> last;
  const auto pose = [&](double parameter) {
    const PosedSteady<D> posed = build(parameter);
    const auto q = posed.scene.initial_positions(), v = posed.scene.initial_velocities();
    last = std::make_shared<const System>(posed.scene.system());
    std::vector<FlatKept> keep = detail::flat<D>(posed.options.keep, last->layout());
    return PosedSystem{last, {q.begin(), q.end()}, posed.options.time,
                       {},   {v.begin(), v.end()}, std::move(keep)};
  };
  const FlatDiagram found = find_steady_branches(pose, options);
  return detail::read_by<D>(*last->layout(), found);
}

}  // namespace dalembert
