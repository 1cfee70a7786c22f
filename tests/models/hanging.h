#pragma once

#include "newton.h"
#include <dalembert/models/hanging_rods.h>

#include <cmath>
#include <span>
#include <vector>

namespace dalembert::models {

/// Checks at each time that the tensions of rods hanging from the origin are what their beads'
/// accelerations demand, m_i (a_i - g) = T_(i+1) e_(i+1) - T_i e_i, and that their energy is constant.
/// The bound of each comparison must itself be below `sharpness` times weight and energy scale.
inline void expect_newton_and_energy(const Model<2>& model, const std::vector<double>& masses, double gravity,
                                     std::span<const double> times, double h, double sharpness) {
  double first_energy = 0.0, first_error = 0.0;
  for (const double t : times) {
    const Observation<2> seen = model.observations(std::span(&t, 1)).front();
    Bounded<double> total{0.0, 0.0};
    std::vector<Vec<2>> pull;  // T_i e_i
    Vec<2> above = Vec<2>::Zero();
    for (std::size_t i = 0; i < masses.size(); ++i) {
      pull.push_back(seen.forces[i] * (seen.positions[i] - above).normalized());
      above = seen.positions[i];
    }
    pull.push_back(Vec<2>::Zero());
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const Stencil<2> bead(model, t, h, i);
      const auto demanded = force_by_newton(bead, masses[i], gravity);
      EXPECT_LT((pull[i + 1] - pull[i] - demanded.value).norm(), demanded.error)
          << model.name << ", bead " << i << ", t = " << t;
      EXPECT_LT(demanded.error, sharpness * model.force);
      const auto own = energy(bead, masses[i], gravity);
      total = {total.value + own.value, total.error + own.error};
    }
    if (t == times.front()) {
      first_energy = total.value;
      first_error = total.error;
    }
    EXPECT_LE(std::abs(total.value - first_energy), total.error + first_error) << model.name << ", t = " << t;
    EXPECT_LT(total.error, sharpness * model.energy);
  }
}

}  // namespace dalembert::models
