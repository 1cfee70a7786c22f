#pragma once

#include <dalembert/core/results/audit.h>

#include <string>

namespace dalembert {

/// What a run cost, and how well it kept its constraints.
struct Statistics {
  int degrees_of_freedom = 0;   ///< of velocity: coordinates less independent rigid constraint equations
  int redundant_equations = 0;  ///< constraint equations that follow from others, and were left out
  int singular_positions = 0;   ///< isolated ones, at which the run was taken across and restarted
  /// What all steps may err by, added up: the tolerance or more, of `length` in position, of that over `time`
  /// in velocity. Distances by which events move the scene onto what they impose are in it. The growth that a
  /// motion itself gives to errors is not in it, see `certify`, but where the balance of work shows a larger
  /// error (see Options::audit) it is that.
  double accuracy = 0.0;
  /// The part of it that round-off gives, which no tolerance makes smaller.
  double round_off = 0.0;
  long steps = 0;                 ///< accepted steps
  long evaluations = 0;           ///< of the equations of motion
  long factorisations = 0;        ///< of a KKT matrix
  long error_test_failures = 0;   ///< steps repeated because their error was too large
  long convergence_failures = 0;  ///< steps repeated because Newton's iteration did not converge
  /// Steps of the explicit stepper limited by stability, not accuracy (counted by samples). If these are most
  /// of the steps, Stepper::ida may be faster: where nothing fast needs to be followed.
  long stability_limited = 0;
  std::string advice;              ///< what slowed or spoiled the run, if known, and what to do about it
  std::string linear_algebra;      ///< what factors the matrices: LDL the Schur complement, KLU the whole
  double length = 0.0;             ///< the scene's, to which tolerances were relative [length]
  double time = 0.0;               ///< the scene's, in which it moves by that length [time]
  double residual_position = 0.0;  ///< largest |g|/|grad g| at any sample [length]
  double residual_velocity = 0.0;  ///< largest |psi|/|W row| at any sample [speed]
  double correction = 0.0;         ///< largest move that put a sample onto its constraints [length]
  Audit audit{};                   ///< what holding the results against the laws of mechanics has found
  double run_time = 0.0;           ///< processor time of integration and output, without set-up [s]

  /// One line for a log.
  [[nodiscard]] std::string report() const;
};

}  // namespace dalembert
