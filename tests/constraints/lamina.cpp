#include "dalembert/constraints/bodies/lamina.h"

#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace dalembert::lamina_test {
namespace {

constexpr double round_off = 50.0 * std::numeric_limits<double>::epsilon();  // some ten operations

LaminaState general() {
  return {.mass = 3.0,
          .inertia = {0.4, 1.1},
          .centre = {0.3, -0.2, 0.7},
          .axes = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix(),
          .velocity = {1.0, 0.5, -2.0},
          .angular_velocity = {0.6, -1.3, 0.9}};
}

TEST(Lamina, HasTheMassCentreAndInertiaOfItsState) {
  Scene<3> scene;
  const LaminaState s = general();
  const Lamina lamina = add_lamina(scene, s, "plate");
  Vec<3> centre = Vec<3>::Zero();
  Mat<3, 3> inertia = Mat<3, 3>::Zero();
  for (const auto& p : lamina.particles) {
    const double mass = scene.system().masses()[static_cast<std::size_t>(p.coordinate)];
    const Vec<3> arm = s.axes.transpose() * (p.gather(scene.initial_positions()) - s.centre);
    centre += mass / s.mass * arm;
    inertia += mass * (arm.squaredNorm() * Mat<3, 3>::Identity() - arm * arm.transpose());
  }
  EXPECT_LT(centre.norm(), round_off);
  const Vec<3> principal(s.inertia.x(), s.inertia.y(), s.inertia.sum());
  EXPECT_LT((inertia - Eigen::Matrix3d(eigen(principal).asDiagonal())).norm(), round_off);
}

TEST(Lamina, EveryPointOfItMovesAsARigidBodyDoes) {
  Scene<3> scene;
  const LaminaState s = general();
  const Lamina lamina = add_lamina(scene, s, "plate");
  const Vec<2> local(0.7, -1.2);
  const Vec<3> arm = eigen(s.axes).leftCols<2>() * local;
  const auto point = lamina.point(local);
  EXPECT_LT((point.gather(scene.initial_positions()) - (s.centre + arm)).norm(), round_off);
  EXPECT_LT((point.gather(scene.initial_velocities()) - (s.velocity + s.angular_velocity.cross(arm))).norm(),
            round_off);
}

TEST(Lamina, SaysWhatIsWrong) {
  const auto fault = [](auto spoil) -> std::string {
    Scene<3> scene;
    LaminaState state = general();
    spoil(state);
    try {
      (void)add_lamina(scene, state, "plate");
    } catch (const InvalidScene& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(fault([](LaminaState& s) { s.mass = -1.0; }).find("mass"), std::string::npos);
  EXPECT_NE(fault([](LaminaState& s) { s.inertia.x() = 0.0; }).find("thin rod"), std::string::npos);
  EXPECT_NE(fault([](LaminaState& s) { s.axes.set_col(0, 2.0 * s.axes.col(0)); }).find("axes"),
            std::string::npos);
  EXPECT_NE(fault([](LaminaState& s) { s.axes.set_col(0, -s.axes.col(0)); }).find("axes"), std::string::npos);
}

}  // namespace
}  // namespace dalembert::lamina_test
