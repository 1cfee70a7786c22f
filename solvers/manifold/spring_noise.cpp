#include "dalembert/solvers/manifold/spring_noise.h"

#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

std::vector<double> spring_noise(const System& system, const Scales& scales, const Instant& at) {
  auto of_forces = system.linearisation();
  const std::vector<double> none(system.rows());
  system.linearise_forces(at, none, of_forces);
  const auto pattern = system.stiffness_pattern();
  std::vector<double> noise(at.q.size());
  for (std::size_t k = system.stiffness_of_constraints(); k < pattern.size(); ++k) {
    const auto [row, column] = pattern[k];
    const double rounding = 10.0 * epsilon * std::max(scales.unit(column), std::abs(at.q[column]));
    noise[row] += std::abs(of_forces.stiffness[k]) * rounding;
  }
  return noise;
}

}  // namespace dalembert
