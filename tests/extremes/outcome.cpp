#include <dalembert/dalembert.h>
#include <dalembert/tests/outcome.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace dalembert::outcome_test {
namespace {

struct MethodFailure : Error {
  using Error::Error;
};

TEST(Outcome, NamesTheErrorByItsTypeWithoutNamespaces) {
  EXPECT_EQ(outcome_of(InvalidScene("")).name, "InvalidScene");
  EXPECT_EQ(outcome_of(UndeterminedForce("")).name, "UndeterminedForce");
  EXPECT_EQ(outcome_of(IntegrationFailure("", 0.0, nullptr)).name, "IntegrationFailure");
  EXPECT_EQ(outcome_of(MethodFailure("")).name, "MethodFailure");
  EXPECT_EQ(outcome_of(std::runtime_error("")).name, "runtime_error");
}

TEST(Outcome, KeepsWhatTheErrorSaid) {
  const Outcome refused = outcome_of(InvalidArgument("t_end = 0"));
  EXPECT_EQ(refused.message, "t_end = 0");
  EXPECT_FALSE(refused.ok());
  EXPECT_TRUE(Outcome{}.ok());
}

}  // namespace
}  // namespace dalembert::outcome_test
