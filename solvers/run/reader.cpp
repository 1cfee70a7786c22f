#include "dalembert/solvers/run/reader.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>

namespace dalembert {

namespace {

void add_counts(const Manifold& manifold, Statistics& statistics) {
  statistics.evaluations += manifold.evaluations();
  statistics.factorisations += manifold.factorisations();
}

}  // namespace

Reader::Reader(const Problem& problem, const Start& start, double t, double tolerance)
    : problem_(problem),
      rows_(start.rows),
      lengths_(start.scales.lengths()),
      manifold_(problem, rows_, lengths_),
      recovery_(problem, start, tolerance),
      redundant_(rows_.size() < problem.system().rows_in_force()) {
  if (redundant_) best_sine_ = manifold_.sine({t, start.q, start.v});
}

std::optional<ActiveRows> Reader::better_rows(const Instant& at) {
  if (!redundant_) return std::nullopt;
  const double own = manifold_.sine(at);
  if (own >= constants.worn * best_sine_) return std::nullopt;
  ActiveRows rows = independent_rows(problem_.system(), manifold_.equations().w, rows_);
  const double best = Manifold(problem_, rows, lengths_).sine(at);
  if (own < constants.worn * best) return rows;
  best_sine_ = std::max(own, best);
  return std::nullopt;
}

void Reader::read(Moment& m, const Springs* springs, long steps) {
  if (springs != nullptr) manifold_.follow(*springs);
  const auto rows = better_rows({m.t, m.q, m.v});
  if (!rows) return recovery_.recover(manifold_, m, steps);
  Manifold other(problem_, *rows, lengths_);
  if (springs != nullptr) other.follow(*springs);
  recovery_.recover(other, m, steps);
  add_counts(other, others_);
}

void Reader::count(Statistics& statistics) const {
  add_counts(manifold_, statistics);
  statistics.evaluations += others_.evaluations;
  statistics.factorisations += others_.factorisations;
}

}  // namespace dalembert
