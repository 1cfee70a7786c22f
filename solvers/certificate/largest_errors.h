#pragma once

#include <dalembert/solvers/certificate/two_runs.h>

#include <string>

namespace dalembert {

/// The largest estimated error of one kind in a run.
struct LargestError {
  double error = 0.0;  ///< in the unit of the quantity
  double time = 0.0;   ///< where it is largest [time]
  std::string of{};    ///< the particle, rotor, constraint or event
};

/// The largest errors in a run, at its samples and at what happened, where they are known.
struct LargestErrors {
  LargestError position, velocity;       ///< of particles
  LargestError angle, angular_velocity;  ///< of rotors
  LargestError force;                    ///< multipliers, of a constraint as a vector
  LargestError impulse, event_time;      ///< at events
  std::size_t beside_jumps = 0;          ///< samples at which what jumps is not known, see Doubt
  std::size_t rests = 0;                 ///< after infinitely many impacts, of which only the time is known
  std::size_t undetermined = 0;          ///< samples at which a force of constraint is not determined
  std::size_t beyond = 0;                ///< samples and events at which nothing is known
};

/// Of both runs of a certificate.
[[nodiscard]] LargestErrors largest_errors(const TwoRuns& runs);

}  // namespace dalembert
