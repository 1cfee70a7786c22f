#include "dalembert/models/andrews.h"

#include <dalembert/tests/models/newton.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace dalembert::models::andrews_test {
namespace {

/// Angles of the links, counted on through full turns from sample to sample of a run.
class Angles {
 public:
  explicit Angles(const Andrews& mechanism) {
    for (std::size_t k = 0; k < 7; ++k) theta[k] = mechanism.links[k].angle;
  }
  void follow(const AndrewsScene& built, const Sample<2>& sample) {
    for (std::size_t k = 0; k < 7; ++k) {
      const Vec<2> axis = built.links[k].axes(sample).col(0);
      theta[k] += std::remainder(std::atan2(axis.y(), axis.x()) - theta[k], 2.0 * std::numbers::pi);
    }
  }
  [[nodiscard]] double beta() const { return theta[0]; }
  /// beta, Theta, gamma, phi, delta, Omega, epsilon.
  [[nodiscard]] std::array<double, 7> published() const {
    return {theta[0], theta[1] - theta[0], theta[2], theta[3] - theta[4],
            theta[4], theta[5] - theta[6], theta[6]};
  }

 private:
  std::array<double, 7> theta{};
};

// Published values at t = 0.03 (IVP test set, IFToMM A03).
constexpr std::array published = {15.810771195153707,   -15.756371058411839, 0.040822240119645805,
                                  -0.53473011634207959, 0.52440996587995407, 0.53473011634207959,
                                  1.0480807410419379};

TEST(AndrewsReference, JointsAreWhereThePublishedAnglesPutThem) {
  const Andrews mechanism;
  const double beta = published[0], gamma = published[2], delta = published[4], epsilon = published[6];
  const Observation<2> seen = mechanism.reference(0.03);
  const Vec<2> F = 0.007 * Vec<2>(std::cos(beta), std::sin(beta));
  const Vec<2> E = mechanism.B + 0.035 * Vec<2>(std::sin(gamma), -std::cos(gamma));
  const Vec<2> G = mechanism.A + 0.04 * Vec<2>(std::cos(delta), std::sin(delta));
  const Vec<2> H = mechanism.A + 0.04 * Vec<2>(std::sin(epsilon), -std::cos(epsilon));
  // The published values agree with a second computation to about 1e-9.
  EXPECT_LT((seen.positions[0] - F).norm(), 1e-9 * 15.8 * 0.007);
  for (const std::size_t way : {1U, 2U, 3U, 5U}) EXPECT_LT((seen.positions[way] - E).norm(), 1e-9 * 0.035);
  EXPECT_LT((seen.positions[4] - G).norm(), 1e-9 * 0.04);
  EXPECT_LT((seen.positions[6] - H).norm(), 1e-9 * 0.04);
}

TEST(Andrews, AnglesAreThePublishedOnes) {
  const Andrews mechanism;
  const AndrewsScene built = mechanism.scene();
  Angles angles(mechanism);
  simulate(built.scene, {.t_end = 0.03, .samples = 301, .tolerance = 1e-10},
           [&](const Sample<2>& sample) { angles.follow(built, sample); });
  for (std::size_t k = 0; k < published.size(); ++k)
    EXPECT_NEAR(angles.published()[k], published[k], 1e-5 * std::abs(published[k])) << k;
}

// T + V - torque beta; the couple's work is not in the library's energy.
TEST(Andrews, WorkOfTheDriveIsTheChangeOfEnergy) {
  const Andrews mechanism;
  const AndrewsScene built = mechanism.scene();
  Angles angles(mechanism);
  constexpr double published_constant = 1.4378329575327399;
  const double tolerance = 1e-10;
  simulate(built.scene, {.t_end = 0.03, .samples = 301, .tolerance = tolerance},
           [&](const Sample<2>& sample) {
             angles.follow(built, sample);
             // The energy reached is torque beta = 0.5; its relative error is that of the speeds, a few
             // thousand steps' worth of the tolerance.
             EXPECT_NEAR(sample.energy() - mechanism.torque * angles.beta(), published_constant,
                         1e4 * tolerance * 0.5);
           });
}

}  // namespace
}  // namespace dalembert::models::andrews_test
