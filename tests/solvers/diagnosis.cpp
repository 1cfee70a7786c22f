#include "dalembert/solvers/run/diagnosis.h"

#include "../both_steppers.h"
#include "failure_of.h"
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

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Fall : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, Fall, both_steppers, stepper_name);

std::string stopped_by(const Scene<3>& scene, double tolerance, Stepper stepper) {
  const auto failure =
      failure_of([&] { (void)simulate(scene, {.t_end = 5.0, .tolerance = tolerance, .stepper = stepper}); });
  return failure ? failure->what() : "it ran";
}

/// A comet falls straight into a centre of force -k/r.
TEST_P(Fall, IsExplainedByWhatIsSingularAndWhere) {
  for (const double tolerance : {1e-4, 1e-6}) {
    Scene<3> sky;
    const auto comet = sky.add_particle({.mass = 2.0, .position = {1.0, 0.3, 0.0}}, "comet");
    sky.add(potential(points(comet), [](auto r) { return -4.0 / r.norm(); }), "pull");
    EXPECT_THAT(stopped_by(sky, tolerance, GetParam()),
                AllOf(HasSubstr("Potential \"pull\""), HasSubstr("comet at ("), HasSubstr("singular"),
                      Not(HasSubstr("discontinuous"))));
  }
}

/// A bead slides straight down a cone, as the library or the user states it. It comes to the apex however far
/// a step may be off: explicit steps went on below it, and each was projected back onto it.
TEST_P(Fall, IntoTheApexOfAConeEndsThere) {
  for (const double height : {0.7, 1.0}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-11}) {
      for (const bool own : {false, true}) {
        Scene<3> scene;
        scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
        const auto bead = scene.add_particle({.mass = 2.0, .position = {height, 0.0, height}}, "bead");
        if (own)
          scene.add(
              holonomic(points(bead), [](auto r) { return r.z() - sqrt(r.x() * r.x() + r.y() * r.y()); }),
              "funnel");
        else
          scene.add(OnSurface{bead, Cone{}}, "funnel");
        EXPECT_THAT(stopped_by(scene, tolerance, GetParam()),
                    AllOf(HasSubstr("\"funnel\""), HasSubstr("singular"), Not(HasSubstr("discontinuous"))))
            << height << ", " << tolerance << ", " << own;
      }
    }
  }
}

/// A bead slides down into a corner that compares nothing.
TEST_P(Fall, IntoACornerMayBeThatOfAConstraint) {
  Scene<3> scene;
  scene.add(UniformGravity<3>{{0.0, 0.0, -1.0}});
  const auto bead = scene.add_particle({.mass = 2.0, .position = {-1.0, 0.0, 1.0}}, "bead");
  scene.add(holonomic(points(bead), [](auto r) { return r.z() - sqrt(r.x() * r.x()); }), "corner");
  EXPECT_THAT(stopped_by(scene, 1e-8, GetParam()), HasSubstr("a constraint whose gradient jumps"));
}

}  // namespace
}  // namespace dalembert::diagnosis_test
