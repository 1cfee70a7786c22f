#include "dalembert/tests/sweep/files.h"
#include <dalembert/core/errors.h>
#include <dalembert/sweep/parameters.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dalembert::sweep_parameters {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing_sweeps::Folder;
using testing_sweeps::write;

std::vector<double> row(const Parameters& parameters, std::size_t i) {
  std::vector<double> values(parameters.columns().size());
  parameters.fill(i, values);
  return values;
}

std::string error_of(const std::string& csv) {
  try {
    (void)read_csv(csv);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Grid, IsAllCombinationsTheLastAxisFastest) {
  const auto parameters = grid({{"a", "m", 1.0, 2.0, 2}, {"b", "", 0.0, 1.0, 3}});
  ASSERT_EQ(parameters.rows(), 6U);
  EXPECT_THAT(row(parameters, 0), ElementsAre(1.0, 0.0));
  EXPECT_THAT(row(parameters, 1), ElementsAre(1.0, 0.5));
  EXPECT_THAT(row(parameters, 5), ElementsAre(2.0, 1.0));
}

TEST(LatinHypercube, HasOneValueInEachPartOfEachRange) {
  for (const std::size_t rows : {1U, 2U, 3U, 10U, 1000U}) {
    const auto parameters = latin_hypercube({{"a", "", 0.0, 1.0}, {"b", "", -1.0, 1.0}}, rows, 7);
    std::vector<int> a(rows), b(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      const auto values = row(parameters, i);
      const auto count = static_cast<double>(rows);
      ++a.at(static_cast<std::size_t>(values[0] * count));
      ++b.at(static_cast<std::size_t>((values[1] + 1.0) / 2.0 * count));
    }
    EXPECT_THAT(a, testing::Each(1));
    EXPECT_THAT(b, testing::Each(1));
  }
}

/// All 6 orders of three rows, over 6000 seeds: each 1000 times, to five standard deviations (29).
TEST(LatinHypercube, HasEveryOrderEquallyOften) {
  std::map<std::array<int, 3>, int> orders;
  for (std::uint64_t seed = 1; seed <= 6000; ++seed) {
    const auto parameters = latin_hypercube({{"a", "", 0.0, 3.0}}, 3, seed);
    std::array<int, 3> order{};
    for (std::size_t i = 0; i < 3; ++i) order[i] = static_cast<int>(row(parameters, i)[0]);
    ++orders[order];
  }
  ASSERT_EQ(orders.size(), 6U);
  for (const auto& [order, count] : orders) EXPECT_NEAR(count, 1000, 145);
}

/// The first points of two dimensions, as Joe and Kuo (2008) and every implementation have them.
TEST(Sobol, BeginsAsItsSequenceDoes) {
  const auto parameters = sobol({{"a", "", 0.0, 1.0}, {"b", "", 0.0, 1.0}}, 8);
  EXPECT_THAT(row(parameters, 0), ElementsAre(0.0, 0.0));
  EXPECT_THAT(row(parameters, 1), ElementsAre(0.5, 0.5));
  EXPECT_THAT(row(parameters, 2), ElementsAre(0.75, 0.25));
  EXPECT_THAT(row(parameters, 3), ElementsAre(0.25, 0.75));
}

/// A (0, m, 2)-net in base 2: one of 16 points in each of the 4 x 4 squares, shifted or not.
TEST(Sobol, IsBalancedAlsoWithAShift) {
  for (const std::uint64_t seed : {0U, 5U}) {
    const auto parameters = sobol({{"a", "", 0.0, 1.0}, {"b", "", 0.0, 1.0}}, 16, seed);
    std::vector<int> squares(16);
    for (std::size_t i = 0; i < 16; ++i) {
      const auto values = row(parameters, i);
      ++squares.at(static_cast<std::size_t>(4.0 * values[0]) * 4 + static_cast<std::size_t>(4.0 * values[1]));
    }
    EXPECT_THAT(squares, testing::Each(1));
  }
}

/// Mean 1/2 and variance 1/12 of 1e5 numbers, to five standard deviations: sqrt(1/12/1e5), sqrt(1/180/1e5).
TEST(MonteCarlo, IsUniform) {
  constexpr std::size_t rows = 100'000;
  const auto parameters = monte_carlo({{"a", "", 0.0, 1.0}}, rows, 3);
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double u = row(parameters, i)[0] - 0.5;
    sum += u;
    squares += u * u;
  }
  EXPECT_NEAR(sum / rows, 0.0, 5 * 9.2e-4);
  EXPECT_NEAR(squares / rows, 1.0 / 12.0, 5 * 2.4e-4);
}

TEST(ReadCsv, TakesNamesUnitsAndNumbers) {
  const Folder folder;
  write(folder / "a.csv", "# measured\n\"length, upper [m]\",mass\r\n0.1,2e3\n\n-1, 7\n");
  const auto parameters = read_csv(folder / "a.csv");
  ASSERT_EQ(parameters.rows(), 2U);
  EXPECT_EQ(parameters.columns()[0].name, "length, upper");
  EXPECT_EQ(parameters.columns()[0].unit, "m");
  EXPECT_THAT(row(parameters, 0), ElementsAre(0.1, 2000.0));
  EXPECT_THAT(row(parameters, 1), ElementsAre(-1.0, 7.0));
}

TEST(ReadCsv, NamesLineAndColumnOfWhatIsNoNumber) {
  const Folder folder;
  const std::string file = folder / "a.csv";
  write(file, "a,b\n1,2\n3,x\n");
  EXPECT_THAT(error_of(file), HasSubstr("line 3: \"b\" is \"x\""));
  write(file, "a,b\n1,nan\n");
  EXPECT_THAT(error_of(file), HasSubstr("must be a finite number"));
  write(file, "a,b\n1\n");
  EXPECT_THAT(error_of(file), HasSubstr("line 2: 1 cells under 2 names"));
  write(file, "a,b\n");
  EXPECT_THAT(error_of(file), HasSubstr("empty table"));
  write(file, "a,a\n1,2\n");
  EXPECT_THAT(error_of(file), HasSubstr("two columns are called \"a\""));
  EXPECT_THAT(error_of(folder / "b.csv"), HasSubstr("does it exist"));
}

TEST(Row, NamesAColumnThatIsNotThere) {
  const std::vector<Quantity> columns{{"a", "m"}};
  const std::vector<double> values{1.0};
  const Row one(0, columns, values);
  EXPECT_EQ(one["a"], 1.0);
  try {
    (void)one["b"];
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_THAT(error.what(), HasSubstr("no column \"b\" among a [m]"));
  }
}

}  // namespace
}  // namespace dalembert::sweep_parameters
