#include <dalembert/dalembert.h>
#include <dalembert/models/bouncing_ball.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/plane_pendulum.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

namespace dalembert::simulate_to_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// An estimate is right to a fifth, see TwoRuns.
constexpr double allowed = 1.25;

/// Against the closed form m (l phi'^2 + g cos phi).
TEST(SimulateTo, MeetsAnErrorOfForce) {
  const models::PlanePendulum model;
  const auto built = model.scene();
  for (const double wanted : {1e-3, 1e-6, 1e-9}) {
    const auto found = simulate_to(built.scene, {.t_end = 10.0, .force_error = wanted});
    EXPECT_TRUE(found.outcome.met) << found.outcome.words;
    double error = 0.0;
    for (const Sample<2>& now : found.run())
      error =
          std::max(error, std::abs(-now.multiplier(built.rods[0]) - model.reference(now.time()).forces[0]));
    EXPECT_LE(error, allowed * wanted);
    EXPECT_LE(found.certificate.largest().force.error, wanted);
  }
}

TEST(SimulateTo, MeetsAnErrorOfPosition) {
  const models::PlanePendulum model;
  const auto built = model.scene();
  const auto found = simulate_to(built.scene, {.t_end = 10.0, .samples = 11, .position_error = 1e-7});
  ASSERT_TRUE(found.outcome.met) << found.outcome.words;
  ASSERT_EQ(found.run().size(), 11U);
  for (std::size_t i = 0; i < 11; ++i) {
    const Vec<2> due = model.reference(found.run().times()[i]).positions[0];
    EXPECT_LE((found.run().position(built.beads[0], i) - due).norm(), allowed * 1e-7);
  }
}

/// The bob passes its lowest point after a quarter of the period 4 K(k)/omega0, and each half of it.
TEST(SimulateTo, MeetsAnErrorOfTheTimesOfEvents) {
  const models::PlanePendulum model;
  const auto built = model.scene();
  const auto bob = built.beads[0];
  const std::vector<Event<2>> events{{"is lowest", [=](const auto& now) { return now.position(bob).x(); }}};
  const auto found = simulate_to(built.scene, {.t_end = 10.0, .event_error = 1e-8}, events);
  ASSERT_TRUE(found.outcome.met) << found.outcome.words;
  const auto all = found.run().events();
  ASSERT_GE(all.size(), 8U);
  for (std::size_t k = 0; k < all.size(); ++k)
    EXPECT_NEAR(all[k].time, (0.25 + 0.5 * static_cast<double>(k)) * model.period(), allowed * 1e-8);
}

/// Of a force of 3 m g and a length of 1.
TEST(SimulateTo, TakesRelativeErrors) {
  const auto built = models::PlanePendulum{}.scene();
  const auto found = simulate_to(built.scene, {.t_end = 10.0, .force_error = 1e-6, .relative = true});
  ASSERT_TRUE(found.outcome.met) << found.outcome.words;
  EXPECT_LE(found.certificate.largest().force.error, 3.0 * 9.81 * 1e-6);
}

TEST(SimulateTo, StepsStiffScenesImplicitly) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(compliant(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0}, 1e-10), "rod");
  const auto found = simulate_to(scene, {.t_end = 1.0, .position_error = 1e-4});
  EXPECT_TRUE(found.outcome.met) << found.outcome.words;
  EXPECT_EQ(found.run().record()->stepper, "ida");
}

/// Round-off in a force of 30 N is above 1e-16 N.
TEST(SimulateTo, SaysWhatItReachedWhereNoMoreIsPossible) {
  const auto built = models::PlanePendulum{}.scene();
  const auto found = simulate_to(built.scene, {.t_end = 10.0, .force_error = 1e-16});
  EXPECT_FALSE(found.outcome.met);
  EXPECT_THAT(found.outcome.words, HasSubstr("The request is not met"));
  EXPECT_LT(found.certificate.largest().force.error, 1e-8);
}

/// A double pendulum from the horizontal: differences grow tenfold in some 1.8 s, so that no double is known
/// to t = 60. A first tolerance of 1e-5 is known for less than what is left of 1e-14 over these.
TEST(SimulateTo, OfChaoticRunsTheOneThatIsKnownLongestIsTheBest) {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto a = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  const auto b = scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}});
  scene.add(Distance{Fixed<2>{}, a, 1.0});
  scene.add(Distance{a, b, 1.0});
  const auto found = simulate_to(scene, {.t_end = 60.0, .position_error = 1e-3});
  EXPECT_FALSE(found.outcome.met);
  const auto known = [&](const Certificate<2>& certificate) {
    std::size_t i = 0;
    while (i < certificate.run().size() && std::isfinite(certificate.position_error(b, i))) ++i;
    return i;
  };
  for (const double tolerance : {1e-5, 1e-7, 1e-9})
    EXPECT_GE(known(found.certificate),
              known(certify(scene, {.t_end = 60.0, .tolerance = tolerance, .stepper = Stepper::erk})));
  EXPECT_THAT(found.outcome.words, HasSubstr("it is the best"));
  EXPECT_THAT(found.outcome.words, Not(HasSubstr("Ask for a tighter tolerance")));
}

TEST(SimulateTo, RefusesRequestsThatMakeNoSense) {
  const auto built = models::PlanePendulum{}.scene();
  EXPECT_THROW((void)simulate_to(built.scene, {.t_end = 1.0}), InvalidArgument);
  EXPECT_THROW((void)simulate_to(built.scene, {.t_end = 1.0, .force_error = -1.0}), InvalidArgument);
  EXPECT_THROW((void)simulate_to(built.scene, {.t_end = -1.0, .force_error = 1.0}), InvalidArgument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)simulate_to(built.scene, {.t_end = 1.0, .position_error = nan}), InvalidArgument);
}

/// Errors of the pendulum's closed form at either end of the curve, to the part that the reference errs by.
TEST(WorkPrecision, HoldsTheTrueErrors) {
  const models::PlanePendulum model;
  const auto built = model.scene();
  const auto curve =
      work_precision(built.scene, {.t_end = 2.0, .samples = 11}, {.tolerances = {1e-4, 1e-7}, .repeats = 1});
  ASSERT_EQ(curve.points.size(), 4U);
  for (const WorkPrecisionPoint& point : curve.points) {
    const auto run = simulate(built.scene, {.t_end = 2.0,
                                            .samples = 11,
                                            .tolerance = point.tolerance,
                                            .stepper = point.stepper == "erk" ? Stepper::erk : Stepper::ida});
    double error = 0.0;
    for (const Sample<2>& now : run)
      error =
          std::max(error, (now.position(built.beads[0]) - model.reference(now.time()).positions[0]).norm());
    EXPECT_NEAR(point.position_error, error, 0.05 * error) << point.stepper << ' ' << point.tolerance;
    EXPECT_GT(point.statistics.run_time, 0.0);
  }
  std::ostringstream csv, plot;
  curve.write_csv(csv);
  EXPECT_THAT(csv.str(), HasSubstr("stepper,tolerance,steps,evaluations,error_position,error_force"));
  EXPECT_EQ(std::ranges::count(csv.str(), '\n'), 5);
  curve.write_plot(plot);
  EXPECT_THAT(plot.str(), HasSubstr("plot $ida using 1:2"));
}

/// A quote, a line's end or a backquote in gnuplot's own quotes would end the text, or be run.
TEST(WorkPrecision, PlotsASceneOfAnyName) {
  std::ostringstream plot;
  WorkPrecision{"a \"b\"\nc 'd' `e`", {}}.write_plot(plot);
  EXPECT_THAT(plot.str(), HasSubstr("set title 'a \"b\" c ''d'' `e`' noenhanced\n"));
}

TEST(WorkPrecision, SaysWhenItsFilesWereNotWritten) {
  const std::string full = "/dev/full";  // which Linux has: no room is left on it
  if (!std::filesystem::exists(full)) GTEST_SKIP();
  const WorkPrecision one{"scene", {{.stepper = "ida", .tolerance = 1e-4}}};
  const auto room = testing::ThrowsMessage<Error>(HasSubstr("cannot write /dev/full: is there no room left"));
  EXPECT_THAT([&] { one.write_csv(full); }, room);
  EXPECT_THAT([&] { one.write_plot(full); }, room);
}

TEST(WorkPrecision, KeepsWhatWasRefusedAsAPointWithoutErrors) {
  const auto built = models::PlanePendulum{}.scene();
  EXPECT_THROW((void)work_precision(built.scene, {.t_end = 1.0}, {.tolerances = {}}), InvalidArgument);
  EXPECT_THROW((void)work_precision(built.scene, {.t_end = 1.0}, {.tolerances = {1.0}}), InvalidArgument);
  const auto curve = work_precision(built.scene, {.t_end = 10.0, .max_steps = 400},
                                    {.steppers = {Stepper::ida}, .tolerances = {1e-3, 1e-5}, .repeats = 1});
  ASSERT_EQ(curve.points.size(), 2U);
}

}  // namespace
}  // namespace dalembert::simulate_to_test
