#include "dalembert/tests/sweep/files.h"
#include "dalembert/tests/sweep/swing.h"
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/unilateral.h>
#include <dalembert/core/results/columns.h>
#include <dalembert/sweep/write_hdf5.h>

#include <gmock/gmock.h>
#include <hdf5.h>

#include <cmath>
#include <vector>

namespace dalembert::sweeps {
namespace {

using namespace testing_sweeps;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The numbers of a dataset, read by HDF5 alone.
std::vector<double> numbers(const std::string& path, const std::string& name,
                            hid_t type = H5T_NATIVE_DOUBLE) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t data = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(data);
  std::vector<double> all(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  const herr_t read = H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
  EXPECT_GE(read, 0) << name;
  H5Sclose(space);
  H5Dclose(data);
  H5Fclose(file);
  return all;
}

/// Of a table one field.
std::vector<double> field(const std::string& path, const std::string& table, const std::string& name) {
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(double));
  H5Tinsert(type, name.c_str(), 0, H5T_NATIVE_DOUBLE);
  const auto all = numbers(path, table, type);
  H5Tclose(type);
  return all;
}

/// A ball that falls from 1 m onto a floor.
struct Ball {
  Scene<2> scene{"ball"};
  Particle<2> ball;

  explicit Ball(const std::string& name = "ball") {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    ball = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}}, name);
    scene.add(unilateral(holonomic(points(ball), [](auto r) { return r.y(); }), {.restitution = 0.5}),
              "floor");
  }
};

TEST(WriteHdf5, KeepsEveryNumberOfARun) {
  const Folder folder;
  const Swing swing(0.5);
  const auto run = simulate(swing.scene, swing_run);
  write_hdf5(run, folder / "run.h5");
  const auto all = columns(*run.record());
  ASSERT_EQ(all.size(), 1U + 4U + 3U + 1U);  // t; bob; rod's multiplier and force; energy
  for (const Column& column : all) {
    const auto written = numbers(folder / "run.h5", "samples/" + column.name);
    ASSERT_EQ(written.size(), run.size());
    for (std::size_t i = 0; i < run.size(); ++i) EXPECT_EQ(written[i], column.read(run.record()->sample(i)));
  }
  EXPECT_EQ(numbers(folder / "run.h5", "samples/rod.lambda")[3], run.multiplier(swing.rod, 3));
  EXPECT_EQ(numbers(folder / "run.h5", "samples/bob.vy")[3], run.velocity(swing.bob, 3).y());
}

TEST(WriteHdf5, ErrorsAreThoseOfTheCertificate) {
  const Folder folder;
  const Swing swing(0.5);
  const auto certificate = certify(swing.scene, swing_run);
  write_hdf5(certificate, folder / "run.h5");
  const auto position = numbers(folder / "run.h5", "samples/bob.position.error"),
             velocity = numbers(folder / "run.h5", "samples/bob.velocity.error"),
             force = numbers(folder / "run.h5", "samples/rod.lambda.error");
  for (std::size_t i = 0; i < certificate.run().size(); ++i) {
    EXPECT_EQ(position[i], certificate.position_error(swing.bob, i));
    EXPECT_EQ(velocity[i], certificate.velocity_error(swing.bob, i));
    EXPECT_EQ(force[i], certificate.multiplier_error(swing.rod, i));
  }
}

TEST(WriteHdf5, ListsImpactsWithTheErrorsOfTheirTimes) {
  const Folder folder;
  const auto certificate = certify(Ball().scene, {.t_end = 0.8, .samples = 3, .tolerance = 1e-8});
  write_hdf5(certificate, folder / "ball.h5");
  const auto times = field(folder / "ball.h5", "events", "time"),
             errors = field(folder / "ball.h5", "events", "time_error");
  ASSERT_EQ(times.size(), 1U);  // the second impact is at 2 sqrt(2 h/g) = 0.903 s
  EXPECT_EQ(times.front(), certificate.run().events()[0].time);
  EXPECT_EQ(errors.front(), certificate.event_time_error(0));
  EXPECT_NEAR(times.front(), std::sqrt(2.0 / 9.81), 100.0 * 1e-8);  // as in the benchmark of events
}

TEST(WriteHdf5, GivesTheSameBytesTwice) {
  const Folder folder;
  const auto run = simulate(Swing(0.5).scene, swing_run);
  write_hdf5(run, folder / "a.h5");
  write_hdf5(run, folder / "b.h5");
  auto a = bytes_of(folder / "a.h5"), b = bytes_of(folder / "b.h5");
  EXPECT_TRUE(a == b);
}

TEST(WriteHdf5, RefusesANameThatHdf5DoesNotHave) {
  const Folder folder;
  const auto run = simulate(Ball("left/right").scene, {.t_end = 0.1, .samples = 2});
  EXPECT_THAT([&] { write_hdf5(run, folder / "run.h5"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("\"left/right.x\""), HasSubstr("rename"))));
}

TEST(WriteHdf5, SaysWhichFileCannotBeWritten) {
  const auto run = simulate(Swing(0.5).scene, swing_run);
  EXPECT_THAT([&] { write_hdf5(run, "no-such-folder/run.h5"); },
              ThrowsMessage<Error>(HasSubstr("\"no-such-folder/run.h5\"")));
}

}  // namespace
}  // namespace dalembert::sweeps
