#include <dalembert/models/two_formulations.h>

#include <gtest/gtest.h>

namespace dalembert::models::two_formulations_test {
namespace {

/// Of two seconds or so the errors of both runs are within 100 times the tolerance.
void expect_agreement(const std::vector<TwoFormulations>& all) {
  for (const TwoFormulations& two : all) {
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
        const double off =
            two.difference({.t_end = 2.0, .samples = 21, .tolerance = tolerance, .stepper = stepper});
        EXPECT_LE(off, 100.0 * tolerance) << two.model << ", " << two.what << ", " << name(stepper);
      }
    }
  }
}

TEST(CrossCheck, AgreesForEverySystemWhoseLagrangianTheNotesGive) { expect_agreement(cross_checks()); }

TEST(EquivalentLagrangians, HaveTheSameMotion) { expect_agreement(equivalent_lagrangians()); }

}  // namespace
}  // namespace dalembert::models::two_formulations_test
