#include <dalembert/models/andrews.h>
#include <dalembert/models/bricard.h>
#include <dalembert/models/chaplygin_sleigh.h>
#include <dalembert/models/error.h>
#include <dalembert/models/four_bar.h>
#include <dalembert/models/pursuit.h>
#include <dalembert/models/rigid_atoms.h>
#include <dalembert/models/rolling_disk_on_slope.h>
#include <dalembert/models/slider_crank.h>
#include <dalembert/models/spinning_disk.h>

#include <gtest/gtest.h>

#include <string>

namespace dalembert::models::general_systems_test {
namespace {

// The bounds of the requirements on the library (issue "Every system of the notes"), as fractions of
// length and weight, at the tolerance 1e-8. Energy, where it is conserved, errs by the speeds' local errors,
// of which each step adds at most its tolerance times the energy.
class GeneralSystem : public ::testing::TestWithParam<AnyModel> {};

TEST_P(GeneralSystem, IsAsAccurateAsRequired) {
  std::visit(
      [](const auto& model) {
        constexpr double tolerance = 1e-8;
        const Measurement run = measure(model, {.t_end = model.t_end, .tolerance = tolerance});
        EXPECT_LE(run.error_position, 1e-5);
        EXPECT_LE(run.error_force, 1e-4);
        if (model.scene().conserved) {
          EXPECT_LE(run.energy_drift, static_cast<double>(run.statistics.steps) * tolerance);
        }
      },
      GetParam());
}

std::string name_of(const ::testing::TestParamInfo<AnyModel>& info) {
  std::string name = std::visit([](const auto& model) { return model.name; }, info.param);
  std::erase(name, '-');
  return name;
}

// The four-bar linkage is judged at a tighter tolerance, in its own test.
INSTANTIATE_TEST_SUITE_P(Catalogue, GeneralSystem,
                         ::testing::Values(RollingDisk{}.model(), RollingDiskOnSlope{}.model(),
                                           PursuitCurve{}.model(), RigidAtoms{}.model(), Andrews{}.model(),
                                           Bricard{}.model(), SliderCrank{}.model(),
                                           ChaplyginSleigh{}.model(), SpinningDisk{}.model()),
                         name_of);

}  // namespace
}  // namespace dalembert::models::general_systems_test
