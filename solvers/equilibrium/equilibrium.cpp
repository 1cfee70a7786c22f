#include "dalembert/solvers/equilibrium/equilibrium.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/equilibrium_solver.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

std::shared_ptr<const Record> find_equilibrium(System system, std::span<const double> guess, double time,
                                               const UniformRotation<3>& turning) {
  try {
    const EquilibriumSolver balance(Problem(std::move(system)), guess, time, turning);
    const EquilibriumSolver::State start = balance.start();
    EquilibriumSolver::State s = start;
    if (!balance.solve(s)) {
      s = start;
      balance.descend(s);
    }
    balance.require_lasting(s);
    return balance.record(s);
  } catch (const EquationFault& fault) {
    throw NoEquilibrium(fault.what());
  }
}

namespace detail {

/// As a start is compared with its constraints: relative to the largest velocity.
std::string left_out(const Record& found, std::span<const double> stated) {
  const Layout& layout = *found.layout;
  const FlatSample at = found.sample(0);
  const double close = start_tolerance * std::max(largest(stated), largest(at.v));
  std::string names;
  const auto look = [&](const auto& all, int width) {
    for (const auto& one : all) {
      bool differs = false;
      for (int i = one.coordinate; i < one.coordinate + width; ++i) {
        const auto k = static_cast<std::size_t>(i);
        differs = differs || (stated[k] != 0.0 && std::abs(stated[k] - at.v[k]) > close);
      }
      if (differs) names += " \"" + one.name + '"';
    }
  };
  look(layout.particles, layout.dimension);
  look(layout.rotors, 1);
  if (names.empty()) return {};
  return "the velocities that scene \"" + layout.scene + "\" states for" + names +
         " were left out: nothing moves in an equilibrium but by its turning";
}

}  // namespace detail

}  // namespace dalembert
