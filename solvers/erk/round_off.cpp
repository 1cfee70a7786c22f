#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/friction_switches.h>
#include <dalembert/solvers/erk/round_off.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

void ErkStepper::RoundOff::measure(const Node& at, const System& system, std::span<const double> lengths,
                                   Manifold& manifold, FrictionSwitches& switching) {
  const auto rounded = [this](double x) { return x * (chance_() % 2 == 0 ? 1.0 + epsilon : 1.0 - epsilon); };
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = rounded(at.q()[i]);
    v_[i] = rounded(at.v()[i]);
  }
  try {
    if (!manifold.accelerate({rounded(at.t), q_, v_}, a_)) return;
  } catch (const EquationFault&) {
    return;  // a rounding away from where the equations end
  }
  // Behind a switch the accelerations are others, and so are those without a direction.
  if (switching.differs({at.t, q_, v_})) return;
  const auto keep = [](double& largest, double sample) {
    largest = std::max(constants.step_memory * largest, sample);
  };
  for (std::size_t i = 0; i < a_.size(); ++i) keep(of_accelerations_[i], std::abs(a_[i] - at.a()[i]));
  keep(of_positions_, position_violation(system, manifold.equations(), lengths).size);
  keep(of_velocities_, velocity_violation(system, manifold.equations(), lengths).size);
}

}  // namespace dalembert
