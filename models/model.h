#pragma once

#include <dalembert/dalembert.h>

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace dalembert::models {

/// What is compared between a run and a hand derivation at one time.
template <int D>
struct Observation {
  std::vector<Vec<D>> positions;  ///< of the points in the derivation
  std::vector<double> forces;  ///< of constraint, in the derivation's own terms (a tension, a normal force)
};

/// In place of a force that cannot be read, see Sample::is_determined; it is not compared.
inline constexpr double not_determined = std::numeric_limits<double>::quiet_NaN();

/// A scene and how to read the observed quantities from a run of it.
template <int D>
struct Observed {
  Scene<D> scene;
  std::function<Observation<D>(const Sample<D>&)> observe;
  /// What the motion conserves, as an energy: the energy itself, or if something rotates at a constant rate
  /// Omega about an axis the Jacobi integral, energy - Omega times the angular momentum about it. Empty if
  /// there is no such thing.
  std::function<double(const Sample<D>&)> conserved = [](const Sample<D>& sample) { return sample.energy(); };
};

/// A system of the catalogue: the scene, built from the public API, and the same motion and forces
/// from a hand derivation that shares no code with the solver.
template <int D>
struct Model {
  std::string name;       ///< as in the benchmark, e.g. "plane-pendulum"
  std::string notes;      ///< its numbers in the lecture notes
  std::string reference;  ///< what the reference is, in a few words
  double t_end;           ///< the run compared, from t = 0 [time]
  double length;          ///< position errors are relative to this [length]
  double force;           ///< force errors are relative to this: its weight [force]
  double energy;          ///< the drift of what is conserved is relative to this [energy]
  std::function<Observed<D>()> scene;
  /// The observations at the given increasing times.
  std::function<std::vector<Observation<D>>(std::span<const double> times)> observations;
};

using AnyModel = std::variant<Model<2>, Model<3>>;

/// The observations of a system whose reference is a closed form, so that no time needs the one before.
template <int D, class System>
[[nodiscard]] std::vector<Observation<D>> at_each(const System& system, std::span<const double> times) {
  std::vector<Observation<D>> observations;
  observations.reserve(times.size());
  for (const double t : times) observations.push_back(system.reference(t));
  return observations;
}

}  // namespace dalembert::models
