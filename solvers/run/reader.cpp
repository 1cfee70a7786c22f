#include "dalembert/solvers/run/reader.h"

namespace dalembert {

Reader::Reader(const Problem& problem, const Start& start, double tolerance)
    : manifold_(problem, start.rows, start.scales.lengths()), recovery_(problem, start, tolerance) {}

void Reader::read(Moment& m, const Springs* springs, long steps) {
  if (springs != nullptr) manifold_.follow(*springs);
  recovery_.recover(manifold_, m, steps);
}

void Reader::count(Statistics& statistics) const {
  statistics.evaluations += manifold_.evaluations();
  statistics.factorisations += manifold_.factorisations();
}

}  // namespace dalembert
