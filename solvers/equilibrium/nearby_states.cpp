#include "dalembert/solvers/equilibrium/nearby_states.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/equilibrium/equilibrium.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <cmath>
#include <optional>
#include <utility>

namespace dalembert {

namespace {

std::optional<NearbyState> found(const Problem& problem, const Start& start, double time, int number,
                                 double way, bool moves) {
  const System& system = problem.system();
  const double L = start.scales.length, T = start.scales.time;
  const auto noise = [&](std::size_t i, int which) {
    return std::sin(static_cast<double>(i + 1) * (1.0 + 0.37 * which) + 2.0 * number);
  };
  for (; way >= 1e-4; way *= 0.25) {
    NearbyState s{start.q, std::vector<double>(start.q.size()), std::vector<double>(start.q.size()),
                  std::vector<double>(system.rows())};
    for (std::size_t i = 0; i < s.q.size(); ++i) {
      s.q[i] += way * start.scales.unit(i) * noise(i, 0);
      if (moves) s.v[i] = start.v[i] + way * start.scales.unit(i) / T * noise(i, 1);
    }
    try {
      Manifold manifold(problem, start.rows, start.scales.lengths());
      const double close = 1e-13 * L + start.scales.rounding(s.q);
      if (manifold.project_positions(time, s.q, s.v, close).size > off_constraints * L) continue;
      if (manifold.solve_motion(time, s.q, s.v, s.a, s.lambda)) return s;
    } catch (const EquationFault&) {
      continue;
    }
  }
  return std::nullopt;
}

}  // namespace

NearbyState nearby_state(const Problem& problem, const Start& start, double time, int number, double way) {
  auto state = found(problem, start, time, number, way, number > 0);
  if (!state && number == 0) state = found(problem, start, time, number, way, true);
  if (state) return std::move(*state);
  throw NoEquilibrium("Scene \"" + problem.system().layout()->scene +
                      "\": its symmetries were not found, since near the start no states satisfy its "
                      "constraints with forces that are numbers");
}

}  // namespace dalembert
