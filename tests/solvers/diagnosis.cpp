#include "dalembert/solvers/run/diagnosis.h"

#include "scenes.h"

#include <gmock/gmock.h>

namespace dalembert::diagnosis_test {
namespace {

/// A bob of 1 kg on a rod: in units of its mass, length and time a force is 9.81 N. 53184 of them have grown
/// from the weight, but not from 60000 at the start.
TEST(Diagnosis, NamesAMultiplierOnlyIfItHasGrown) {
  const Pendulum pendulum;
  const System system = pendulum.scene.system();
  const Start start = consistent_start(Problem(system), pendulum.scene.initial_positions(),
                                       pendulum.scene.initial_velocities(), {.t_end = 1.0});
  auto e = system.evaluation();
  system.evaluate({0.0, start.q, start.v}, e);
  const std::vector<double> grown{53184.0 * 9.81}, weight{9.81}, large{60000.0 * 9.81};
  EXPECT_THAT(unbounded_multiplier(system, start.scales, e.w, grown, weight),
              testing::HasSubstr("Distance \"rod\""));
  EXPECT_EQ(unbounded_multiplier(system, start.scales, e.w, grown, large), "");
}

}  // namespace
}  // namespace dalembert::diagnosis_test
