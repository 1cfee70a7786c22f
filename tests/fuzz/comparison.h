#pragma once

#include "verdict.h"

#include <exception>
#include <optional>
#include <string>
#include <vector>

/// One motion computed twice: of a scene and the same stated otherwise, run otherwise, or by the other
/// stepper.
namespace dalembert::fuzz {

/// A run to its end, to where it failed, or none where the start is refused.
template <int D>
struct Ending {
  std::optional<Trajectory<D>> run{};
  std::exception_ptr failure = nullptr;
  std::optional<double> failed_at{};
  std::string why{};
};

[[nodiscard]] inline Stepper other_than(Stepper stepper) {
  return stepper == Stepper::ida ? Stepper::erk : Stepper::ida;
}

template <int D>
[[nodiscard]] Ending<D> run_of(const Draft<D>& draft);

/// A scene's statement with velocities that differ along one axis and go on to, in one of 2 D ways.
template <int D>
[[nodiscard]] Statement faster(const Draft<D>& draft, int way, double rate, double length);

/// How two runs are compared.
struct Measure {
  std::string of;       ///< what the second is
  bool forces = false;  ///< net forces of constraint, too
  bool velocities = true;
  double coarse = 0.0;    ///< what positions may differ by beside errors [length]
  std::size_t first = 0;  ///< the sample of the first run that is the first of the second
};

/// A scene and what became of it.
template <int D>
struct Run {
  const Draft<D>& draft;
  const Ending<D>& ending;
};

/// How far apart two runs are beyond what their errors explain; empty if nowhere. `own` is the run by which
/// the growth of errors is found: that of the second scene, to the same time.
template <int D>
[[nodiscard]] std::string fault_of_comparison(const Run<D>& one, const Run<D>& two, const Run<D>& own,
                                              const Measure& measure, std::string& detail);

/// The same for two whole runs: errors may grow as those of either.
template <int D>
[[nodiscard]] std::string fault_of_twin(const Run<D>& one, const Run<D>& two, const Measure& measure,
                                        std::string& detail);

/// Runs a scene of the family `products` in all its ways. Throws what its run throws.
template <int D>
[[nodiscard]] std::string fault_of_product(Draft<D>& draft, std::string& detail);

}  // namespace dalembert::fuzz
