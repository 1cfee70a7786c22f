#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/bench/report.h>
#include <dalembert/solvers/base/options.h>

#include <string>
#include <vector>

/// What each command of dalembert-bench asks, and what it may be given. A command that returns a number
/// returns how many of its rows are wrong; a run that was refused is none. All throw Error for a name or a
/// number that makes no sense, before anything is run, and if a file cannot be written.
namespace dalembert::bench {

struct WorkPrecisionOptions {
  std::vector<std::string> models = {"all"};     ///< names of the catalogue, or "all"
  std::vector<Method> steppers = {Method::ida};  ///< those that a model does not have give no row
  std::vector<double> tolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  int samples = 101;  ///< equally spaced; 2, the ends of the run, times the integration alone
  int repeats = 3;    ///< the run time reported is the median of this many runs
  ReportOptions report{};
};

/// How much run time does an error cost? Runs models over falling tolerances and compares each
/// with its hand derivation. A run that was refused has its outcome in the table, and nan for errors.
void work_precision(const WorkPrecisionOptions& options);

/// Up to this many beads the end of a run is compared with the chain's hand derivation.
inline constexpr int largest_compared = 1000;

struct ScalingOptions {
  std::string model = "chain";
  std::vector<int> sizes = {10, 100, 1000};  ///< run in increasing order
  std::vector<Method> steppers = {Method::ida};
  double tolerance = 1e-6;
  double t_end = 1.0;
  ReportOptions report{};
};

/// How do run time and memory grow with the size of a scene? error_position is that of the last
/// positions, nan above `largest_compared`; peak_memory_mib the resident memory of the whole process
/// at its peak so far, taken before the comparison. A run that was refused has its outcome in the table.
void scaling(const ScalingOptions& options);

struct SetUpOptions {
  std::vector<int> sizes = {1, 10, 100, 1000};
  std::vector<Stepper> steppers = {Stepper::ida, Stepper::erk};
  int repeats = 3;
  ReportOptions report{};
};

/// What does a scene cost at its start? Pendulums, contacts and friction by their number, each stated, begun
/// and run for a millisecond: the median time. A run that was refused has its outcome in the table.
void set_up(const SetUpOptions& options);

struct OwnConstraintOptions {
  int beads = 100;
  int repeats = 5;
  std::vector<Stepper> steppers = {Stepper::ida, Stepper::erk};
  ReportOptions report{};
};

/// What does a user's own constraint cost? A chain whose rods are lambdas against the same chain of
/// Distances, run in turn; the median of the ratios of their run times, and the largest difference of
/// their positions.
void own_constraint(const OwnConstraintOptions& options);

struct LeaveOutOptions {
  int size = 100;  ///< beads of the chains, and pendulums of the independent islands
  int repeats = 5;
  std::vector<Stepper> steppers = {Stepper::ida, Stepper::erk};
  double tolerance = 1e-8;
  ReportOptions report{};
};

/// What does a scene save by leaving out what it does not need? Each row is one motion stated twice, in
/// full and without, run in turn; median run times of integration and output. `unknowns` counts those of
/// the implicit stepper's equations, (q, v, lambda, mu). A row is wrong if its two motions are further apart
/// than the tolerance allows.
[[nodiscard]] int leave_out(const LeaveOutOptions& options);

struct RatiosOptions {
  std::vector<std::string> scenes = {"all"};
  std::vector<Method> steppers = all_methods();
  std::vector<double> errors = {1e-6, 1e-8};  ///< of position, relative to the model's length
  int repeats = 3;                            ///< rounds
  double limit = 2.0;  ///< a run that took longer is the last of its stepper's curve [s]
  ReportOptions report{};
};

/// How far is the library from code derived by hand, and how far ahead of its peers? The processor time of
/// the integration alone that each takes to reach an error of position at the end of a run.
///
/// Each runs at falling tolerances, half a decade apart, until two runs in turn meet the error: one
/// may do so by a lucky sign. The two runs about the error are then run by all in turn, round after
/// round; between their median times the time at the error is interpolated, both on logarithmic scales,
/// unless a tighter run took less.
///
/// Where error_reached is above the error the curve ended before, at the limit or at a tolerance that the
/// stepper refused: run_time_s is what its last run took, a lower bound.
void ratios(const RatiosOptions& options);

/// The names of its scenes, for a help text.
[[nodiscard]] std::string known_scenes();

struct PagesOptions {
  std::string directory = ".";                ///< of the files
  std::vector<std::string> models = {"all"};  ///< names of the catalogue, or "all"
  int samples = 201;
  double tolerance = 1e-8;
  Stepper stepper = Stepper::erk;
};

/// Writes for each model a certified run: NAME.html, the page that plays it, and its comparison with the hand
/// derivation, NAME-motion.csv, with the columns t; positionK.x and positionK.x.reference of each observed
/// point and axis; forceK and forceK.reference; and the largest errors over points and forces, true and
/// estimated, relative to the model's length and force: error_position, estimated_position, error_force,
/// estimated_force (inf where the certificate says nothing).
/// With "all" also a page for each model of events and each scene of the lecture, without a comparison.
/// models.csv lists what was run: model, notes, reference, t_end, stepper, tolerance, outcome.
void pages(const PagesOptions& options);

}  // namespace dalembert::bench
