#include "dalembert/models/catalogue.h"

#include <dalembert/models/cone.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/error.h>
#include <dalembert/models/plane_pendulum.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace dalembert::models::catalogue_test {
namespace {

constexpr std::array tolerances{1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};

template <int D>
Measurement measured(const Model<D>& model, double tolerance) {
  return measure(model, {.t_end = model.t_end, .tolerance = tolerance});
}

TEST(Catalogue, NamesDifferAndEveryModelSaysWhatItIs) {
  std::set<std::string> names;
  for (const AnyModel& any : catalogue()) {
    std::visit(
        [&](const auto& model) {
          EXPECT_TRUE(names.insert(model.name).second) << model.name;
          EXPECT_FALSE(model.notes.empty());
          EXPECT_FALSE(model.reference.empty());
          EXPECT_EQ(model.scene().scene.name(), model.name);
        },
        any);
  }
}

// The bounds of the requirements on the library (issue "Foundation"), as fractions of length and weight.

TEST(Catalogue, PlanePendulumIsAsAccurateAsRequired) {
  const Model<2> model = PlanePendulum{}.model();
  const Measurement usual = measured(model, 1e-8);
  EXPECT_LE(usual.error_position, 1e-5);
  EXPECT_LE(usual.error_force, 1e-4);
  EXPECT_LE(usual.statistics.steps, 3500);
  const Measurement tight = measured(model, 1e-12);
  EXPECT_LE(tight.error_position, 1e-8);
  EXPECT_LE(tight.error_force, 1e-7);
}

TEST(Catalogue, ConeAndDoublePendulumAreAsAccurateAsRequired) {
  const Measurement cone = measured(ConeSlide{}.model(), 1e-8);
  EXPECT_LE(cone.error_position, 1e-4);
  EXPECT_LE(cone.error_force, 1e-3);
  const Measurement pendulum = measured(DoublePendulum{}.model(), 1e-8);
  EXPECT_LE(pendulum.error_position, 1e-4);
  EXPECT_LE(pendulum.error_force, 1e-3);
}

/// Falling tolerances for every model. A tighter tolerance may be worse than a looser one by a factor of
/// `margin`.
void expect_errors_fall(const AnyModel& any, double margin) {
  std::visit(
      [&](const auto& model) {
        double best_position = INFINITY, best_force = INFINITY;
        for (const double tolerance : tolerances) {
          const Measurement m = measured(model, tolerance);
          EXPECT_LE(m.error_position, margin * best_position) << model.name << " at " << tolerance;
          EXPECT_LE(m.error_force, margin * best_force) << model.name << " at " << tolerance;
          best_position = std::min(best_position, m.error_position);
          best_force = std::min(best_force, m.error_force);
        }
      },
      any);
}

TEST(Catalogue, ErrorsOfThePlanePendulumFallWithTheTolerance) {
  expect_errors_fall(PlanePendulum{}.model(), 3.0);
}

TEST(Catalogue, EveryModelStaysOnItsConstraintsAndCloseToItsReference) {
  for (const AnyModel& any : catalogue()) {
    std::visit(
        [&](const auto& model) {
          for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
            SCOPED_TRACE(model.name + " at " + std::to_string(tolerance));
            const Measurement m = measured(model, tolerance);
            EXPECT_LE(m.statistics.residual_position, 1e-9);
            EXPECT_LE(m.statistics.residual_velocity, 1e-9);
            // Every step adds at most its tolerance, some of it twice as an error of speed, and the motion
            // amplifies it a hundredfold at most; the separatrix by its own exp(omega0 t) = 525.
            const double bound = 525 * static_cast<double>(m.statistics.steps) * tolerance;
            EXPECT_LE(m.error_position, bound);
            EXPECT_LE(m.error_force, 10 * bound);
            if (model.scene().conserved) {
              EXPECT_LE(m.energy_drift, bound);
            }
          }
        },
        any);
  }
}

}  // namespace
}  // namespace dalembert::models::catalogue_test
