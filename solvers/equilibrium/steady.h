#pragma once

#include <dalembert/solvers/equilibrium/equilibrium.h>

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

/// A number of a state that is to stay what the scene states: a speed, a spin, a lean.
template <int D>
struct Kept {
  std::string name;                               ///< for errors
  std::function<double(const Sample<D>&)> value;  ///< of positions and velocities
};

template <int D>
struct SteadyOptions {
  std::vector<Kept<D>> keep{};  ///< what tells one of a family of steady motions from the others
  double time = 0.0;            ///< of the state [time]
};

/// For a System, out of which `steady` makes an Equilibrium.
struct FlatKept {
  std::string name;                                ///< for errors
  std::function<double(const FlatSample&)> value;  ///< of positions and velocities
};
struct FoundSteady {
  std::shared_ptr<const Record> state;
  std::shared_ptr<const UniformMotion> motion;
};
/// Throws like `steady`. What is kept has its value in the statement (q, v), from which the search begins
/// after `beside` is added: (dq, dv), or nothing. The scene's time is at most `longest`: along a branch a
/// motion that comes to rest is measured by the others.
[[nodiscard]] FoundSteady find_steady(System system, std::span<const double> q, std::span<const double> v,
                                      double time, const std::vector<FlatKept>& keep,
                                      std::span<const double> beside = {},
                                      double longest = std::numeric_limits<double>::infinity());

namespace detail {

template <int D>
[[nodiscard]] std::vector<FlatKept> flat(const std::vector<Kept<D>>& keep,
                                         const std::shared_ptr<const Layout>& layout) {
  std::vector<FlatKept> all;
  for (const Kept<D>& one : keep)
    all.push_back({one.name, [layout, value = one.value](const FlatSample& at) {
                     return value(Sample<D>(*layout, at));
                   }});
  return all;
}

}  // namespace detail

/// A steady motion near the positions and velocities that a scene states: each of its parts translates and
/// rotates uniformly, and within it rotors turn and bodies spin about axes of their own (wheels, tops), so
/// that the motion is the same at any time, forces of constraint included. Wheels may roll.
///
///   F(t,q,v) + W^T lambda = M A v,   g + C lambda = 0,   psi(t,q,v) = 0,   v = A q + b = sum y_k X_k(q)  (1)
///
/// for q, lambda and y, with X_k the symmetries of the scene: which motions are symmetries, and about which
/// axes bodies are round with all that acts on them, is found from the equations, not assumed.
///
/// Steady motions are families (a speed, a spin, a lean). Newton's corrections of least size in q and y lead
/// to one near the statement; what is to stay exactly as stated `keep` says:
///
///   steady(scene, {.keep = {{"speed", [=](const auto& now) { return now.velocity(frame.centre()).x(); }}}})
///
/// Where velocities do not tell the turning of a part from the spin of a body (an upright top), the part does
/// not turn. `normal_modes` of what is returned are those about the steady motion, in its frame.
///
/// Up to 600 coordinates. Throws NoEquilibrium where none is found or something moves as no symmetry carries
/// on, by name (a motion that is periodic is a matter for `floquet`); InvalidScene for scenes that change
/// with time, with constraints that do not always hold or forces that read multipliers; InconsistentStart.
template <int D>
[[nodiscard]] Equilibrium<D> steady(const Scene<D>& scene, const SteadyOptions<D>& options = {}) {
  System system = scene.system();
  const std::vector<FlatKept> keep = detail::flat<D>(options.keep, system.layout());
  FoundSteady found = find_steady(std::move(system), scene.initial_positions(), scene.initial_velocities(),
                                  options.time, keep);
  return {std::move(found.state), std::move(found.motion)};
}

}  // namespace dalembert
