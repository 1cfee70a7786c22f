#pragma once

#include <dalembert/solvers/certificate/certificate.h>

#include <string>

namespace dalembert {

namespace detail {
[[nodiscard]] std::string report_of_forces(const Record& run, const TwoRuns* certified);
}

/// A line for each constraint that was stated: its largest force in the samples of a run, with its time;
/// whether the motion determines it (`is_unique`), and whether it could be read at all samples; and what its
/// multiplier is, with direction and sign. The size of several multipliers is the root of the sum of their
/// squares, of forces and torques alike.
template <int D>
[[nodiscard]] std::string report(const Trajectory<D>& run) {
  return detail::report_of_forces(*run.record(), nullptr);
}
/// The same with the error of each, and below it what is known of all errors.
template <int D>
[[nodiscard]] std::string report(const Certificate<D>& certificate) {
  return detail::report_of_forces(*certificate.run().record(), &certificate.runs()) +
         certificate.statement() + '\n';
}

}  // namespace dalembert
