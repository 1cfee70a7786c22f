#include "dalembert/solvers/base/irregular.h"

#include <random>

namespace dalembert {

std::vector<double> irregular(std::size_t count) {
  std::minstd_rand generator;
  std::vector<double> numbers(count);
  for (double& x : numbers)
    x = 2.0 * static_cast<double>(generator()) / static_cast<double>(std::minstd_rand::max()) - 1.0;
  return numbers;
}

}  // namespace dalembert
