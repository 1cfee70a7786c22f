#pragma once

#include <dalembert/solvers/simulation.h>

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

/// Which runs show what errors of a scene cost.
struct WorkPrecisionOptions {
  std::vector<Stepper> steppers{Stepper::ida, Stepper::erk};                        ///< each gives a curve
  std::vector<double> tolerances{1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};  ///< of the runs, falling
  int repeats = 3;  ///< the median of whose run times counts, >= 1
};

/// A run of such a curve: its largest errors, and what it cost.
struct WorkPrecisionPoint {
  std::string stepper;          ///< its name
  double tolerance = 0.0;       ///< of the run
  double position_error = 0.0;  ///< [length]; NaN if it is not known, see Certificate
  double force_error = 0.0;     ///< [force]; likewise
  double event_error = 0.0;     ///< [time]; likewise
  Statistics statistics{};      ///< with the median of all run times
  std::string refused{};        ///< why the scene could not be run
};

/// Error against run time of one scene, for work-precision diagrams.
struct WorkPrecision {
  std::string scene;                       ///< its name
  std::vector<WorkPrecisionPoint> points;  ///< of all steppers, in their order

  /// Columns: stepper, tolerance, steps, evaluations, error_position, error_force, error_event, run_time_s.
  void write_csv(std::ostream& out) const;
  /// A program for gnuplot that draws error of position and of force against run time, with its data.
  void write_plot(std::ostream& out) const;
  /// The same into files; throws Error if they cannot be written.
  void write_csv(const std::string& path) const;
  /// Likewise.
  void write_plot(const std::string& path) const;
};

/// Runs a scene by each stepper over falling tolerances and compares all with one more accurate run, at a
/// hundredth of the least of them. What it refuses is a point without errors.
///
///   work_precision(scene, {.t_end = 10.0}).write_plot("pendulum.gp");      // gnuplot -p pendulum.gp
///
/// The tolerance and stepper of the options do not count. Throws what the more accurate run throws.
template <int D>
[[nodiscard]] WorkPrecision work_precision(const Scene<D>& scene, const Options& options,
                                           const WorkPrecisionOptions& which = {},
                                           const std::vector<Event<D>>& events = {});

extern template WorkPrecision work_precision(const Scene<2>&, const Options&, const WorkPrecisionOptions&,
                                             const std::vector<Event<2>>&);
extern template WorkPrecision work_precision(const Scene<3>&, const Options&, const WorkPrecisionOptions&,
                                             const std::vector<Event<3>>&);

namespace detail {
/// One curve: `measure` is called for each tolerance, and then the whole curve again, so that what disturbs a
/// machine for a while hits each tolerance once and not one always. What was refused is not repeated.
[[nodiscard]] std::vector<WorkPrecisionPoint> work_precision_curve(
    std::span<const double> tolerances, int repeats,
    const std::function<WorkPrecisionPoint(double tolerance)>& measure);
}  // namespace detail

}  // namespace dalembert
