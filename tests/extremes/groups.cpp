#include <dalembert/tests/extremes/cases/case.h>

#include <gtest/gtest.h>

namespace dalembert::extremes::groups_test {
namespace {

/// Every case of a group over the short part of its sweep: within its limit, or rejected as it should be.
void expect_right(const std::vector<Case>& cases) {
  for (const Case& extreme : cases) {
    for (const Stepper stepper : extreme.steppers) {
      for (const double parameter : extreme.brief) {
        const Run run = judge(extreme, parameter, stepper);
        EXPECT_TRUE(run.right()) << extreme.name << ", " << extreme.parameter << " = " << parameter << ", "
                                 << name(stepper) << ": " << run.outcome.name << ", error " << run.error
                                 << ", limit " << run.limit << ' ' << run.outcome.message;
      }
    }
  }
}

TEST(Extremes, StiffScenesAreRightOrToldToBeTooStiff) { expect_right(stiffness()); }
TEST(Extremes, LargeRatiosOfMassAndLengthAreRight) { expect_right(ratios()); }
TEST(Extremes, MotionsCloseToSingularOnesAreRight) { expect_right(near_singular()); }
TEST(Extremes, LinkagesPassTheirSingularPositions) { expect_right(linkages()); }
TEST(Extremes, FastAndBrokenDrivesAreFollowed) { expect_right(driving()); }
TEST(Extremes, LongRunsAndLargeScenesAreRight) { expect_right(length()); }
TEST(Extremes, FreeParticlesHaveTheLengthOfTheirPath) { expect_right(paths()); }
TEST(Extremes, ResultIsIndependentOfUnitsAndTimeOrigin) { expect_right(units()); }
TEST(Extremes, StartsAreAssembledOrRefusedByName) { expect_right(starts()); }
TEST(Extremes, RedundantConstraintsAreAsAccurateAsIndependentOnes) { expect_right(redundancy()); }
TEST(Extremes, ForcesAtRoundOffAndAtSingularPositionsAreRightOrNotRead) { expect_right(at_round_off()); }
TEST(Extremes, KinksJumpsAndStickingAreFollowedOrNamed) { expect_right(discontinuities()); }
TEST(Extremes, FrictionHoldsUpToTheEdgeOfItsCone) { expect_right(sticking()); }
TEST(Extremes, ContactsAreRightGrazedStruckAtOnceOrWithoutEnd) { expect_right(contacts()); }
TEST(Extremes, FailuresInMidRunSayWhenAndWhat) { expect_right(failures()); }

}  // namespace
}  // namespace dalembert::extremes::groups_test
