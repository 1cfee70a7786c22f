#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace dalembert {

/// The laws that the results of a run are held against, by the numbers that were handed out alone.
enum class Law {
  newton,            ///< M a = F + W^T lambda
  position,          ///< g = 0, of one-sided ones in force as well
  velocity,          ///< psi = 0
  acceleration,      ///< W a + gamma = 0
  compliance,        ///< g + C lambda = 0
  point_forces,      ///< the force of each constraint on each coordinate is its part of W^T lambda
  energy,            ///< the energy is the kinetic one and all potential ones
  released,          ///< what is not in force exerts none
  no_penetration,    ///< s g >= 0 of a one-sided constraint, s the sign that it allows
  no_pull,           ///< s lambda >= 0
  no_distant_force,  ///< lambda g = 0
  friction_cone,     ///< |sigma| <= mu_static |N|
  sliding,           ///< sigma = -mu |N| u/|u| where it slides
  impulse,           ///< M (v+ - v-) = W^T P: momentum and angular momentum
  impulse_carrier,   ///< P of rigid constraints in force and of closed contacts alone, of the allowed sign
  restitution,       ///< a contact separates e times as fast as it approached
  impact_energy,     ///< an impact adds no energy but through drives
  work               ///< the energy changes by the work of what has no potential
};
/// How many there are.
inline constexpr std::size_t number_of_laws = static_cast<std::size_t>(Law::work) + 1;
/// The name of a law, for reports.
[[nodiscard]] const char* name(Law law);

/// How far a law was violated, where most, and what the tolerance, the accuracy of the run and round-off
/// allow.
struct Finding {
  Law law{};                       ///< which one
  std::string element{};           ///< the constraint, particle or force by its label
  double time = 0.0;               ///< of the worst case
  double size = 0.0, limit = 0.0;  ///< in the unit of the law

  /// Above 1 it is broken.
  [[nodiscard]] double ratio() const { return size > 0.0 ? size / limit : 0.0; }
};

/// What an audit of a run has found: of every law that applied to anything the worst case.
struct Audit {
  std::vector<Finding> worst{};  ///< in the order of Law

  /// Whether everything was within its limit.
  [[nodiscard]] bool passed() const;
  /// One line for each law.
  [[nodiscard]] std::string report() const;
};

}  // namespace dalembert
