#include "../equations.h"
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/linear/whole.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace dalembert::whole_matrix_test {
namespace {

/// A rod, a blade, a spring and a damper on two particles.
System system_with_everything() {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0});
  const auto b = scene.add_particle({.mass = 3.0});
  scene.add(Distance{a, b, 1.5});
  scene.add(nonholonomic(points(b), [](auto r, auto v) { return v.y() - r.x() * v.x(); }));
  scene.add(Spring{a, b, 7.0, 1.0});
  scene.add(Damper{a, b, 0.5});
  return scene.system();
}

class WholeMatrixTest : public testing::Test {
 protected:
  System system = system_with_everything();
  std::vector<std::size_t> both{0, 1}, coordinates{0, 1, 2, 3};
  State state{0.4, Eigen::Vector4d(0.8, -0.5, 0.4, 1.4), Eigen::Vector4d(-0.3, 1.2, 0.7, 0.9)};
  System::Evaluation e = system.evaluation();
  System::Linearisation d = system.linearisation();
  Eigen::VectorXd b = (Eigen::VectorXd(6) << 1.0, -2.0, 3.0, 0.5, -1.5, 2.5).finished();

  void SetUp() override {
    system.evaluate(state.instant(), e);
    system.linearise(state.instant(), std::vector<double>{2.0, -3.0}, d);
  }
  Eigen::VectorXd solution(WholeMatrix& matrix) const {
    Eigen::VectorXd x = b;
    matrix.solve({x.data(), 6});
    return x;
  }
  /// Backward stability: |K x - b| <= c n eps |K| |x|.
  void expect_solved(const Eigen::MatrixXd& upper, const Eigen::MatrixXd& lower,
                     const Eigen::VectorXd& x) const {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6);
    K.topLeftCorner(4, 4) = upper;
    K.topRightCorner(4, 2) = -by_rows(system, e.w).transpose();
    K.bottomLeftCorner(2, 4) = lower;
    EXPECT_LE((K * x - b).norm(), 4.0 * 6.0 * std::numeric_limits<double>::epsilon() * K.norm() * x.norm());
  }
};

TEST_F(WholeMatrixTest, HoldsMassesAndConstraints) {
  const WholePattern pattern(system, both, coordinates, SaddleValues::Blocks::symmetric);
  WholeMatrix matrix(pattern);
  ASSERT_TRUE(matrix.factorise({.w = e.w}));
  expect_solved(masses(system), by_rows(system, e.w), solution(matrix));
}

TEST_F(WholeMatrixTest, HoldsStiffnessAndDampingWithTheirFactors) {
  const WholePattern pattern(system, both, coordinates, SaddleValues::Blocks::all);
  WholeMatrix matrix(pattern);
  constexpr double h = 0.3, c = 0.7;
  std::vector<double> lower(e.w);
  for (std::size_t k = 0; k < lower.size(); ++k) lower[k] += h * d.psi_q[k];
  ASSERT_TRUE(matrix.factorise({.w = e.w, .lower = lower, .forces = &d, .h = h, .d = c}));
  const Eigen::MatrixXd H = -by_entries(4, system.stiffness_pattern(), d.stiffness);
  const Eigen::MatrixXd D = -by_entries(4, system.forces().damping_pattern(), d.damping);
  expect_solved(masses(system) + h * H + c * D, by_rows(system, lower), solution(matrix));
}

TEST_F(WholeMatrixTest, LeavesOutRowsThatAreNotActive) {
  const WholePattern pattern(system, std::vector<std::size_t>{1}, coordinates,
                             SaddleValues::Blocks::symmetric);
  WholeMatrix matrix(pattern);
  ASSERT_TRUE(matrix.factorise({.w = e.w}));
  Eigen::VectorXd x = b.head(5);
  matrix.solve({x.data(), 5});
  const Eigen::RowVectorXd blade = by_rows(system, e.w).row(1);
  const double round_off = 100.0 * std::numeric_limits<double>::epsilon();
  EXPECT_LE((masses(system) * x.head(4) - blade.transpose() * x[4] - b.head(4)).norm(), round_off * x.norm());
  EXPECT_NEAR(blade * x.head(4), b[4], round_off * x.norm());
}

TEST_F(WholeMatrixTest, IsSingularForTwoEqualRows) {
  const WholePattern pattern(system, std::vector<std::size_t>{0, 0}, coordinates,
                             SaddleValues::Blocks::symmetric);
  EXPECT_FALSE(WholeMatrix(pattern).factorise({.w = e.w}));
}

}  // namespace
}  // namespace dalembert::whole_matrix_test
