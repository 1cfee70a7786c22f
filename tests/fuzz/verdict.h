#pragma once

#include "draft.h"
#include <dalembert/tests/outcome.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace dalembert::fuzz {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A scene: the family it is of, its number there, and what steps it.
struct Task {
  std::uint64_t seed;
  Stepper stepper;
  Family family = Family::any;
};

/// What became of a scene. `fault` is empty unless the library did what it must not: then it describes that.
struct Verdict {
  Outcome outcome{};
  std::string fault{};
  std::string kind{};      ///< of the scene's plan, by name
  std::string features{};  ///< of products, by name
  std::string log{};       ///< how to write the scene down by hand
  std::string detail{};    ///< size of what was measured, for whoever looks into limits
};

/// Makes the scene and runs it.
[[nodiscard]] Verdict judge(const Task& task);

/// What each coordinate is measured in: the scene's length, or 1 for an angle.
[[nodiscard]] std::vector<double> units(const System& system, double length);

/// What is wrong with a run's samples; empty if nothing. `complete` tells a run that came to its end
/// from what an IntegrationFailure kept.
template <int D>
[[nodiscard]] std::string fault_of_run(const Draft<D>& draft, const Trajectory<D>& run,
                                       std::optional<double> failed_at, std::string& detail);

/// What is wrong with the one-sided constraints of a run: gaps, signs of forces, what happens at events,
/// energy.
template <int D>
[[nodiscard]] std::string fault_of_contacts(const Draft<D>& draft, const Trajectory<D>& run,
                                            std::string& detail);

/// What a run may err by, as a multiple of its accuracy: every step may err by it, and some dozens of them
/// are made in the one or two times in which a scene moves by its length. In units of the scene: its length,
/// that over its time, and the mass of all times that over its time again.
inline constexpr double error_of_run = 100.0;

/// Runs a scene and its twin, in which the redundant constraints are left out or that the other stepper runs,
/// and says what is wrong with the run or how the two differ. Throws what the run of the scene itself throws.
template <int D>
[[nodiscard]] std::string fault_of_twins(const Draft<D>& draft, std::string& detail);

}  // namespace dalembert::fuzz
