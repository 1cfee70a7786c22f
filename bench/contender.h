#pragma once

#include <dalembert/solvers/base/options.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dalembert::bench {

/// Who integrates: the library's steppers, an equation of motion derived by hand, and peers where
/// they were found when this was built. The tables name them in the column "stepper".
enum class Contender {
  ida,
  erk,
  hand,         ///< double precision, Runge-Kutta-Fehlberg 7(8) of Boost.odeint
  simbody_pin,  ///< Simbody, minimal coordinates
  simbody_rod   ///< Simbody, Cartesian coordinates and rods
};
[[nodiscard]] const char* name(Contender contender);

/// Those that this build has.
[[nodiscard]] std::vector<Contender> contenders();

/// The library's own stepper of that name, if it is one.
[[nodiscard]] std::optional<Stepper> stepper(Contender contender);

/// What a reader of these contenders' figures must know, as a sentence to append; mostly nothing.
[[nodiscard]] std::string remark(std::span<const Contender> contenders);

}  // namespace dalembert::bench
