#include "../both_steppers.h"
#include <dalembert/dalembert.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

/// How long dry friction holds a body on legs, against a linear program.
namespace dalembert::static_limits_test {
namespace {

/// Its foot, the angle and mu of the slope below.
struct Leg {
  Vec<2> foot;
  double slope, mu;
  [[nodiscard]] Vec<2> along() const { return {std::cos(slope), std::sin(slope)}; }
  [[nodiscard]] Vec<2> normal() const { return {-std::sin(slope), std::cos(slope)}; }
};

/// Legs between -1 and 1 whose cones of friction hold the vertical: without a pull they bear any weight.
std::vector<Leg> random_legs(unsigned seed) {
  std::mt19937 generator(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  std::vector<Leg> legs;
  const int count = 2 + static_cast<int>(seed % 3);
  for (int i = 0; i < count; ++i) {
    const double x = -1.0 + 2.0 * i / (count - 1);
    legs.push_back({{x, between(-0.8, -0.3)}, between(-0.1, 0.1), between(0.15, 0.35)});
  }
  return legs;
}

/// The largest pull P along x at the centre, with the weight 10: at a corner of the polyhedron of forces,
/// where three of P and the parts of each force along the edges of its cone are not 0.
double largest_pull(const std::vector<Leg>& legs) {
  const auto edges = 2 * static_cast<Eigen::Index>(legs.size());
  Eigen::MatrixXd A(3, edges + 1);
  for (Eigen::Index k = 0; k < edges; ++k) {
    const Leg& leg = legs[static_cast<std::size_t>(k / 2)];
    const Vec<2> f = leg.normal() + (k % 2 == 0 ? leg.mu : -leg.mu) * leg.along();
    A.col(k) << f.x(), f.y(), leg.foot.x() * f.y() - leg.foot.y() * f.x();
  }
  A.col(edges) << 1.0, 0.0, 0.0;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < edges; ++i)
    for (Eigen::Index j = i + 1; j < edges; ++j) {
      const Eigen::Matrix3d corner = A(Eigen::all, {i, j, edges});
      if (std::abs(corner.determinant()) < 1e-9) continue;
      const Eigen::Vector3d parts = corner.inverse() * Eigen::Vector3d(0.0, 10.0, 0.0);
      if (parts.minCoeff() >= 0.0) largest = std::max(largest, parts[2]);
    }
  return largest;
}

/// When something first slides or opens as it is pulled by 5 t, or when what follows is refused.
std::optional<double> first_change(const std::vector<Leg>& legs, Stepper stepper) try {
  Scene<2> scene;
  scene.add(UniformGravity<2>{{0.0, -10.0}});
  const auto body = add_body(scene, BodyState<2>{.mass = 1.0, .inertia = 0.4}, "body");
  for (const Leg& leg : legs) {
    const Plane<2> floor{.point = leg.foot, .normal = leg.normal()};
    const auto foot = body.point_at(leg.foot);
    scene.add(coulomb(scene.add(unilateral(OnCurve{foot, floor})), Slip{foot, floor}, leg.mu));
  }
  scene.add(force_law(points(body.centre()), [](auto t, auto r, auto) {
    const auto zero = 0.0 * r.x();
    return std::make_tuple(vec(5.0 * t + zero, zero));
  }));
  const auto run = simulate(scene, {.t_end = 1.0, .samples = 2, .stepper = stepper});
  if (run.events().empty()) return std::nullopt;
  return run.events().front().time;
} catch (const IntegrationFailure& failure) {
  return failure.time();
}

class StaticLimits : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, StaticLimits, both_steppers, stepper_name);

TEST_P(StaticLimits, LegsHoldAsLongAsAnyForcesDo) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const auto legs = random_legs(seed);
    const auto change = first_change(legs, GetParam());
    ASSERT_TRUE(change) << "seed " << seed;
    // Times are found to roundings; forces of a few solves of a few unknowns leave some hundred of them.
    EXPECT_NEAR(*change, largest_pull(legs) / 5.0, 1e-10) << "seed " << seed;
  }
}

}  // namespace
}  // namespace dalembert::static_limits_test
