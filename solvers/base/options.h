#pragma once

#include <string>
#include <vector>

namespace dalembert {

/// The integration method.
enum class Stepper {
  ida,  ///< implicit (BDF of SUNDIALS' IDA): for every scene, the stiff ones in particular
  erk   ///< explicit (Runge-Kutta of order 8): several times faster where nothing is stiff
};
/// As it appears in reports: "ida" or "erk".
[[nodiscard]] const char* name(Stepper stepper);

/// What happens where the results of a run break a law of mechanics that its scene states: see Law.
enum class Audited {
  error,   ///< the run stops, and says which law, what breaks it, when, and by how much
  report,  ///< it goes on; Trajectory::audit tells
  off      ///< no law is looked at; not together with a ledger
};

/// Below this, round-off in the velocities of BDF's divided differences decides the step size.
inline constexpr double smallest_tolerance = 1e-13;

/// How to run a scene. An aggregate: `simulate(scene, {.t_end = 10.0, .tolerance = 1e-8})`.
struct Options {
  double t_end = 0.0;    ///< where the run ends, > t_start [time]
  double t_start = 0.0;  ///< time of the initial state [time]

  /// Number of samples, equally spaced, with one at either end; 2 to 1e8. Ignored where one of the next two
  /// is given.
  int samples = 101;
  double sample_interval =
      0.0;  ///< or the time between samples, from t_start; at most the run's length [time]
  std::vector<double> times{};  ///< or samples at these times, increasing, within the run

  /// Relative accuracy: the error of each step is held to the tolerance (in `ida`, whose steps are many, to a
  /// twentieth of it) times the scene's characteristic length in position, and that length over the scene's
  /// time in velocity. Between 1e-13 and 1e-1. The error of the result grows with the length of the run; the
  /// benchmarks show how much.
  double tolerance = 1e-6;
  Stepper stepper = Stepper::ida;  ///< the integration method
  /// Keep the motion between the samples too, for Trajectory::at: for each coordinate 12 numbers per step of
  /// `ida`, 18 of `erk`, and in `ida` 18 for each multiplier if a constraint is compliant; two to four times
  /// the run time (`dalembert-bench leave-out`). `erk` then evaluates the equations in the middle of each
  /// step too.
  bool dense = false;
  /// Every sample and every impact is held against the laws of mechanics by code that shares nothing with the
  /// steppers; see Law for what they are and Audit for what is found.
  Audited audit = Audited::error;
  /// Keep a Ledger: energies, work and momenta at every sample. The work is integrated over every step, and
  /// its balance audited: for scenes with drives, friction or forces without a potential that is the only
  /// check of energy. A run then takes several times as long.
  bool ledger = false;
  long max_steps = 10'000'000;  ///< give up after so many steps
  /// No step is longer; 0: as long as the tolerance allows. For events, drives and forces that vary much
  /// faster than the motion: a smooth pulse that falls within a step, in time or in space, may leave no trace
  /// in it. Where equations compare, steps end by themselves. Finite, >= 0 [time]
  double max_step = 0.0;

  /// False: an initial state that violates a constraint is an error. True: it is projected onto the
  /// constraint manifold, by Newton steps that are each the least in the mass-weighted norm.
  bool assemble = false;

  /// The scene's characteristic length, to which the tolerance is relative; 0: the size of the box around its
  /// points or, for a lone particle, the radius of its curve or surface, or the extent of its path so far.
  /// See Statistics for the value used. Finite, >= 0 [length]
  double length = 0.0;
};

/// What each step of a run with this tolerance is held to, in the measures of Options::tolerance.
[[nodiscard]] double tolerance_of_a_step(Stepper stepper, double tolerance);

/// No step of a run is longer: max_step, or the whole run.
[[nodiscard]] double longest_step(const Options& options);

/// The sample times that the options ask for. Throws InvalidArgument, naming the option, its value
/// and its bounds, if any option makes no sense.
[[nodiscard]] std::vector<double> sample_times(const Options& options);

/// The same for a run that starts at this time. Throws InvalidArgument if they name another t_start than 0.
[[nodiscard]] Options starting_at(double time, Options options);

/// The part of that check that does not concern sampling.
void validate(const Options& options);

}  // namespace dalembert
