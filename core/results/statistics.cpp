#include "dalembert/core/results/statistics.h"

#include <sstream>

namespace dalembert {

std::string Statistics::report() const {
  std::ostringstream out;
  out << degrees_of_freedom << " degrees of freedom, ";
  if (redundant_equations > 0) out << redundant_equations << " redundant equations, ";
  if (singular_positions > 0) out << singular_positions << " singular positions crossed, ";
  out << steps << " steps, accuracy " << accuracy << ", " << evaluations << " evaluations, " << factorisations
      << " factorisations, " << error_test_failures << " error test failures, " << convergence_failures
      << " convergence failures, length " << length << ", time " << time << ", residuals "
      << residual_position << " (position) " << residual_velocity << " (velocity), correction " << correction
      << ", " << run_time << " s";
  if (!linear_algebra.empty()) out << ", " << linear_algebra;
  if (!advice.empty()) out << "; " << advice;
  return out.str();
}

}  // namespace dalembert
