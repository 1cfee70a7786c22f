#include "dalembert/core/results/trajectory.h"

#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/core/scene/scene.h>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>

namespace dalembert::trajectory_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A run written by hand: two particles, a rod between them and a pin, two samples.
class TwoSamples : public testing::Test {
 protected:
  Scene<2> scene{"dumbbell"};
  Particle<2> a = scene.add_particle({.mass = 1.0}, "a");
  Particle<2> b = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "b");
  Constraint<1> rod = scene.add(Distance{a, b, 1.0}, "rod");
  Constraint<2> pin = scene.add(Coincident{a, Fixed<2>{}}, "pin");

  Record record() {
    Record r;
    r.layout = scene.system().layout();
    r.stepper = "hand";
    r.tolerance = 1e-8;
    r.statistics.steps = 7;
    // Slots: the rod's force on a and b, the pin's on a.
    const std::vector<double> q{0.1, 0.2, 1.1, 1.2}, v{0.3, 0.4, 1.3, 1.4}, a{0.5, 0.6, 1.5, 1.6},
        lambda{5.0, 6.0, 7.0};
    const std::vector<double> forces{1.0, 2.0, -1.0, -2.0, 6.0, 7.0};
    r.append({0.0, q, v, a, lambda, forces, 42.0});
    const std::vector<double> later{1.0 / 3.0, 0.2, 1.1, 1.2};
    r.append({0.5, later, v, a, lambda, forces, 43.0});
    return r;
  }
  Trajectory<2> run{std::make_shared<const Record>(record())};
};

TEST_F(TwoSamples, CanBeReadByHandleAndSample) {
  EXPECT_EQ(run.size(), 2U);
  EXPECT_THAT(run.times(), testing::ElementsAre(0.0, 0.5));
  EXPECT_EQ(run.position(a, 0), Vec<2>(0.1, 0.2));
  EXPECT_EQ(run.position(a, 1), Vec<2>(1.0 / 3.0, 0.2));
  EXPECT_EQ(run.velocity(b, 1), Vec<2>(1.3, 1.4));
  EXPECT_EQ(run.multiplier(rod, 0), 5.0);
  EXPECT_EQ(run.multiplier(pin, 0), Vec<2>(6.0, 7.0));
  EXPECT_EQ(run.constraint_force(rod, a, 0), Vec<2>(1.0, 2.0));
  EXPECT_EQ(run.constraint_force(rod, b, 0), Vec<2>(-1.0, -2.0));
  EXPECT_EQ(run.constraint_force(pin, a, 0), Vec<2>(6.0, 7.0));
  EXPECT_EQ(run.constraint_force(a, 0), Vec<2>(7.0, 9.0));
  EXPECT_EQ(run.energy(0), 42.0);
  EXPECT_EQ(run.energy(1), 43.0);
  EXPECT_EQ(run.sample(1).time(), 0.5);
  EXPECT_EQ(run.statistics().steps, 7);
}

/// The rod's force and with it the accelerations of b are not determined; those of a, say, are.
TEST_F(TwoSamples, WhatIsNotDeterminedCannotBeRead) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Record r = record();
  r.clear();
  const std::vector<double> q{0.1, 0.2, 1.1, 1.2}, v{0.3, 0.4, 1.3, 1.4}, acceleration{0.5, 0.6, nan, 1.6};
  const std::vector<double> lambda{nan, 6.0, 7.0}, forces{nan, nan, nan, nan, 6.0, 7.0};
  r.append({0.5, q, v, acceleration, lambda, forces, 42.0});
  const Trajectory<2> marked{std::make_shared<const Record>(std::move(r))};
  EXPECT_EQ(marked.acceleration(a, 0), Vec<2>(0.5, 0.6));
  EXPECT_EQ(marked.constraint_force(pin, a, 0), Vec<2>(6.0, 7.0));
  EXPECT_EQ(marked.ground_force(pin, 0), Vec<2>(-6.0, -7.0));
  const auto refused = ThrowsMessage<UndeterminedForce>(
      AllOf(HasSubstr("\"rod\""), HasSubstr("not determined at t = 0.5"), HasSubstr("another time")));
  EXPECT_THAT([&] { (void)marked.constraint_force(b, 0); }, refused);
  EXPECT_THAT([&] { (void)marked.ground_force(rod, 0); }, refused);
  EXPECT_THAT([&] { (void)marked.ground_moment(rod, {0.0, 0.0}, 0); }, refused);
  EXPECT_THAT([&] { (void)marked.acceleration(b, 0); },
              ThrowsMessage<UndeterminedForce>(HasSubstr("not determined at t = 0.5")));
  EXPECT_TRUE(std::isnan(marked.accelerations(b)(0, 0)));
  EXPECT_TRUE(std::isnan(marked.multipliers(rod)[0]));
}

TEST_F(TwoSamples, CanBeIteratedOver) {
  std::vector<double> times;
  for (const auto& now : run) times.push_back(now.time());
  EXPECT_THAT(times, testing::ElementsAre(0.0, 0.5));
  EXPECT_EQ(std::distance(run.begin(), run.end()), 2);
  EXPECT_EQ((*std::next(run.begin())).position(a), run.position(a, 1));
}

TEST_F(TwoSamples, CanBeReadAsMatrices) {
  EXPECT_EQ(Eigen::Matrix2Xd(run.positions(b)), (Eigen::Matrix2d() << 1.1, 1.1, 1.2, 1.2).finished());
  EXPECT_EQ(Eigen::Matrix2Xd(run.velocities(a)), (Eigen::Matrix2d() << 0.3, 0.3, 0.4, 0.4).finished());
  EXPECT_EQ(Eigen::Matrix2Xd(run.accelerations(b)), (Eigen::Matrix2d() << 1.5, 1.5, 1.6, 1.6).finished());
  EXPECT_EQ(Eigen::Matrix2Xd(run.multipliers(pin)), (Eigen::Matrix2d() << 6.0, 6.0, 7.0, 7.0).finished());
  EXPECT_EQ(Eigen::RowVectorXd(run.multipliers(rod)), Eigen::RowVector2d(5.0, 5.0));
}

/// By hand: the pin holds a with (6, 7) at (0.1, 0.2), so the ground feels (-6, -7) there.
TEST_F(TwoSamples, TellTheMomentOnTheGround) {
  const double expected = (0.1 - 1.0) * -7.0 - (0.2 - 2.0) * -6.0;
  EXPECT_DOUBLE_EQ(run.ground_moment(pin, {1.0, 2.0}, 0), expected);
}

TEST_F(TwoSamples, AConstraintExertsNoForceOnAParticleItDoesNotTouch) {
  EXPECT_EQ(run.constraint_force(pin, b, 0), Vec<2>::Zero());
}

TEST_F(TwoSamples, HaveNoThird) {
  EXPECT_THAT([&] { (void)run.position(a, 2); },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("no sample 2"), HasSubstr("has 2"))));
  EXPECT_THAT([&] { (void)run.sample(static_cast<std::size_t>(-1)); },
              ThrowsMessage<InvalidArgument>(HasSubstr("no sample -1:")));
  EXPECT_THAT([&] { (void)run.event_sample(static_cast<std::size_t>(-1)); },
              ThrowsMessage<InvalidArgument>(HasSubstr("no event -1:")));
}

TEST_F(TwoSamples, RefuseAForeignHandle) {
  Scene<2> other;
  const auto foreign = other.add_particle({.mass = 1.0});
  const auto foreign_rod = other.add(Distance{Fixed<2>{}, foreign, 1.0});
  const auto refused =
      ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("\"dumbbell\""), HasSubstr("another scene"),
                                           HasSubstr("use those that this scene returned")));
  EXPECT_THAT([&] { (void)run.position(foreign, 0); }, refused);
  EXPECT_THAT([&] { (void)run.velocity(foreign, 0); }, refused);
  EXPECT_THAT([&] { (void)run.constraint_force(foreign, 0); }, refused);
  EXPECT_THAT([&] { (void)run.constraint_force(rod, foreign, 0); }, refused);
  EXPECT_THAT([&] { (void)run.multiplier(foreign_rod, 0); }, refused);
  EXPECT_THAT([&] { (void)run.constraint_force(foreign_rod, a, 0); }, refused);
}

TEST_F(TwoSamples, RefuseAHandleThatWasNeverAdded) {
  EXPECT_THROW((void)run.position(Particle<2>{}, 0), InvalidArgument);
  EXPECT_THROW((void)run.multiplier(Constraint<1>{}, 0), InvalidArgument);
}

TEST_F(TwoSamples, RefuseAHandleAddedAfterTheRun) {
  const auto late = scene.add_particle({.mass = 1.0});
  const auto late_rod = scene.add(Distance{a, late, 1.0});
  const auto refused = ThrowsMessage<InvalidArgument>(HasSubstr("added after the run was made"));
  EXPECT_THAT([&] { (void)run.position(late, 0); }, refused);
  EXPECT_THAT([&] { (void)run.multiplier(late_rod, 0); }, refused);
}

TEST_F(TwoSamples, CannotBeReadInAnotherDimension) {
  EXPECT_THAT([&] { Trajectory<3>{std::make_shared<const Record>(record())}; },
              ThrowsMessage<InvalidArgument>(AllOf(HasSubstr("\"dumbbell\""), HasSubstr("Trajectory<2>"))));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST_F(TwoSamples, SayInCsvWhatTheyAre) {
  std::ostringstream out;
  run.write_csv(out);
  const auto lines = lines_of(out.str());
  ASSERT_EQ(lines.size(), 3U + 1U + 2U);
  EXPECT_THAT(lines[0], AllOf(HasSubstr("# dalembert "), HasSubstr("scene \"dumbbell\""),
                              HasSubstr("stepper hand"), HasSubstr("tolerance 1e-08")));
  EXPECT_THAT(lines[1], AllOf(HasSubstr("# "), HasSubstr("Z = +W^T lambda")));
  EXPECT_THAT(lines[2], AllOf(HasSubstr("# "), HasSubstr("7 steps")));
  EXPECT_EQ(
      lines[3],
      "t,a.x,a.y,a.vx,a.vy,b.x,b.y,b.vx,b.vy,rod.lambda,rod.on.a.Zx,rod.on.a.Zy,rod.on.b.Zx,rod.on.b.Zy,"
      "pin.lambda1,pin.lambda2,pin.on.a.Zx,pin.on.a.Zy,energy");
}

TEST_F(TwoSamples, KeepEveryDigitInCsv) {
  std::ostringstream out;
  run.write_csv(out);
  const auto lines = lines_of(out.str());
  ASSERT_EQ(lines.size(), 6U);
  const std::vector<double> expected{0.5, 1.0 / 3.0, 0.2,  0.3,  0.4, 1.1, 1.2, 1.3, 1.4, 5.0,
                                     1.0, 2.0,       -1.0, -2.0, 6.0, 7.0, 6.0, 7.0, 43.0};
  const auto cells = cells_of(lines[5]);
  ASSERT_EQ(cells.size(), expected.size());
  ASSERT_EQ(cells_of(lines[3]).size(), expected.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_EQ(std::strtod(cells[i].c_str(), nullptr), expected[i]);
}

TEST_F(TwoSamples, LeaveTheFormatOfTheUsersStreamAlone) {
  std::ostringstream out;
  run.write_csv(out);
  out.str({});
  out << 1.0 / 3.0;
  EXPECT_EQ(out.str(), "0.333333");
}

/// As programs of window systems have it: a comma for the point, and dots between thousands.
TEST_F(TwoSamples, AreWrittenWithPointsWhateverTheStreamsLocale) {
  struct Comma : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
  };
  std::ostringstream plain, other;
  run.write_csv(plain);
  other.imbue(std::locale(std::locale::classic(), new Comma));
  other << std::fixed << std::setprecision(2);
  run.write_csv(other);
  EXPECT_EQ(other.str(), plain.str());
}

TEST_F(TwoSamples, CanBeWrittenToAFile) {
  const auto path = std::filesystem::temp_directory_path() / "dalembert-two-samples.csv";
  run.write_csv(path.string());
  EXPECT_GT(std::filesystem::file_size(path), 100U);
  std::filesystem::remove(path);
}

TEST_F(TwoSamples, SayWhenTheyCannotBeWritten) {
  EXPECT_THAT([&] { run.write_csv("no-such-folder/run.csv"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("\"no-such-folder/run.csv\""), HasSubstr("folder"))));
}

// A comma in a name must not make a column of its own.
/// No view into a run that is gone.
template <class T>
concept GivesViews = requires(T run) {
  std::forward<T>(run).sample(0);
}
|| requires(T run) { std::forward<T>(run).times(); };
static_assert(GivesViews<const Trajectory<2>&> && !GivesViews<Trajectory<2>>);

TEST(Trajectory, NamesWithACommaAreQuotedInCsv) {
  Scene<2> scene;
  scene.add_particle({.mass = 1.0}, "upper, left");
  Record r;
  r.layout = scene.system().layout();
  const std::vector<double> two{0.0, 0.0};
  r.append({0.0, two, two, two, {}, {}, 0.0});
  std::ostringstream out;
  Trajectory<2>(std::make_shared<const Record>(std::move(r))).write_csv(out);
  EXPECT_THAT(out.str(), HasSubstr("t,\"upper, left.x\",\"upper, left.y\","));
}

/// Whatever the scene is called, lines before the header begin with #, by which readers know them.
TEST(Trajectory, LineBreaksInTheSceneStayInTheCommentOfCsv) {
  Scene<2> scene("two\nlines\r");
  scene.add_particle({.mass = 1.0}, "p");
  Record r;
  r.layout = scene.system().layout();
  const std::vector<double> two{0.0, 0.0};
  r.append({0.0, two, two, two, {}, {}, 0.0});
  std::ostringstream out;
  Trajectory<2>(std::make_shared<const Record>(std::move(r))).write_csv(out);
  EXPECT_THAT(out.str(), HasSubstr("scene \"two\\nlines\\r\", stepper"));
  std::istringstream lines(out.str().substr(0, out.str().find("\nt,") + 1));
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(line.substr(0, 2), "# ");
}

TEST(Record, ReservedRoomIsNotLeftWhileAppending) {
  Record r;
  const std::vector<double> q(4), v(4), a(4), lambda(3), forces(6);
  const FlatSample sample{0.0, q, v, a, lambda, forces, 0.0};
  r.reserve(10, sample);
  r.append(sample);
  const double* const first = r.values.data();
  for (int i = 1; i < 10; ++i) r.append(sample);
  EXPECT_EQ(r.values.data(), first);
  EXPECT_EQ(r.values.size(), 10U * (4 + 4 + 4 + 3 + 6 + 1));
}

}  // namespace
}  // namespace dalembert::trajectory_test
