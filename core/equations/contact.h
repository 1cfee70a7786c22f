#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace dalembert {

/// The sign that g may have in a one-sided constraint: a floor keeps g >= 0, a string g <= 0.
enum class Allowed { positive, negative };

/// What a one-sided constraint adds to its equation.
struct Contact {
  Allowed allowed = Allowed::positive;  ///< the sign of g
  /// Newton's coefficient: the speed of separation after an impact over that of approach, 0 to 1.
  double restitution = 0.0;

  /// g and lambda times this are >= 0.
  [[nodiscard]] double sign() const { return allowed == Allowed::positive ? 1.0 : -1.0; }
};

/// What Coulomb's law adds to the no-slip equation.
struct Roughness {
  int pressed_by = -1;     ///< index of the constraint that gives the normal force
  double mu = 0.0;         ///< coefficient of sliding friction
  double mu_static = 0.0;  ///< of sticking friction, at least mu
};

/// When a constraint holds, if not always.
struct Condition {
  std::optional<Contact> contact{};      ///< of a one-sided constraint
  std::optional<Roughness> roughness{};  ///< of Coulomb friction
  bool released = false;                 ///< not in force

  /// Whether it holds at all times.
  [[nodiscard]] bool always() const { return !contact && !roughness && !released; }
};

/// When each constraint of a scene holds.
struct Conditions {
  std::vector<Condition> of{};  ///< by the number of the constraint

  /// The numbers of one-sided constraints.
  [[nodiscard]] std::vector<std::size_t> contacts() const;
  /// Those of Coulomb's law.
  [[nodiscard]] std::vector<std::size_t> frictional_constraints() const;
  /// All that are either.
  [[nodiscard]] std::vector<std::size_t> conditional_constraints() const;
  /// Those that the scene has released.
  [[nodiscard]] std::vector<std::size_t> released() const;
};

}  // namespace dalembert
