#include "dalembert/solvers/run/output_projection.h"

namespace dalembert {

OutputProjection::OutputProjection(const Problem& problem, const Start& start, double tolerance)
    : manifold_(problem, start.rows, start.scales.lengths()), recovery_(problem, start, tolerance) {}

void OutputProjection::read(OutputState& m, const CompliantMultipliers* compliant, long steps) {
  if (compliant != nullptr) manifold_.use_multipliers(*compliant);
  recovery_.recover(manifold_, m, steps);
}

void OutputProjection::count(Statistics& statistics) const {
  statistics.evaluations += manifold_.evaluations();
  statistics.factorisations += manifold_.factorisations();
}

}  // namespace dalembert
