#include <dalembert/models/small_motions.h>

#include <gtest/gtest.h>

namespace dalembert::models::small_motions_test {
namespace {

TEST(SmallMotions, MatchTheClosedForms) {
  const auto all = small_motions();
  EXPECT_GT(all.size(), 60U);
  for (const Compared& row : all)
    EXPECT_LE(row.error(), row.limit)
        << row.model << ", " << row.quantity << ": " << row.value << " instead of " << row.reference;
}

TEST(LaguerreZeros, MatchThePublishedOnes) {
  // 2 -+ sqrt 2, and the lowest and highest of five, to the digits given there.
  const auto two = laguerre_zeros(2), five = laguerre_zeros(5);
  ASSERT_EQ(two.size(), 2U);
  ASSERT_EQ(five.size(), 5U);
  EXPECT_NEAR(two[0], 2.0 - 1.4142135623730951, 1e-15);
  EXPECT_NEAR(two[1], 2.0 + 1.4142135623730951, 1e-15);
  EXPECT_NEAR(five[0], 0.26356031971814091, 1e-16);
  EXPECT_NEAR(five[4], 12.640800844275783, 1e-14);
  EXPECT_EQ(laguerre_zeros(20).size(), 20U);
}

}  // namespace
}  // namespace dalembert::models::small_motions_test
