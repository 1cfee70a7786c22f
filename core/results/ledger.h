#pragma once

#include <array>
#include <string>
#include <vector>

namespace dalembert {

/// What moved energy and momentum in a run, at every sample; the option `ledger` asks for it. Work and
/// impulses are sums since the start, integrated over the steps. It balances: the kinetic energy has changed
/// by the sum of all `work`, momentum by the impulses of applied forces and of the ground, angular momentum
/// by their moments.
///
/// NaN from where on an integral is not known: over an instant at which a force is not determined.
struct Ledger {
  /// A quantity at every sample, by the label of what it belongs to.
  struct Account {
    std::string name;            ///< the label of an element, or "kinetic energy" and the like
    std::vector<double> values;  ///< one number per sample
  };
  using Vector = std::array<double, 3>;  ///< in the plane z = 0, and of moments only z differs from 0

  Account kinetic{"kinetic energy", {}};      ///< [energy]
  Account potential{"potential energy", {}};  ///< of all forces that have one
  std::vector<Account> elastic{};             ///< of every compliant constraint
  /// On the particles and rotors: of the constant forces together, of every other force, of every constraint
  /// (a drive, friction; 0 to round-off of most), of "what holds bodies together" (0 to round-off), and of
  /// "impacts" and "changes of the scene" [energy].
  std::vector<Account> work{};
  std::vector<Vector> momentum{};          ///< of all particles [mass speed]
  std::vector<Vector> angular_momentum{};  ///< of them about the origin [mass speed length]
  /// What all applied forces gave, and what all constraints gave, impacts among them: of these what acts
  /// between particles cancels, and the rest is the ground's.
  std::vector<Vector> applied_impulse{}, applied_moment{};  ///< [force time], [force time length]
  std::vector<Vector> ground_impulse{}, ground_moment{};    ///< [force time], [force time length]
};

}  // namespace dalembert
