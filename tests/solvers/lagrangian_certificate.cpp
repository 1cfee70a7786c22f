#include <dalembert/dalembert.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dalembert::lagrangian_certificate_test {
namespace {

class LagrangianCertificates : public testing::TestWithParam<Stepper> {};
INSTANTIATE_TEST_SUITE_P(Steppers, LagrangianCertificates, both_steppers, stepper_name);

/// In Cartesian coordinates with the rod as a constraint, against sin(phi/2) = k sn(K - omega0 t). An
/// estimate is the difference from a run that is at least five times as accurate.
TEST_P(LagrangianCertificates, ErrorsOfAPendulumAreTrue) {
  const models::PlanePendulum model;
  const auto start = model.reference(0.0);
  LagrangianSystem<2> system({.position = start.positions[0]}, [&](const auto& q, const auto& v) {
    return 0.5 * model.mass * v.squaredNorm() - model.mass * model.gravity * q[1];
  });
  const auto rod = system.constrain([&](const auto& q) { return q.norm() - model.length; });
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const auto certificate = certify(system, {.t_end = 10.0, .tolerance = tolerance, .stepper = GetParam()});
    ASSERT_TRUE(certificate.complete()) << certificate.statement();
    Vec<2> position = Vec<2>::Zero(), position_error = position;
    double tension = 0.0, tension_error = 0.0;
    for (std::size_t i = 0; i < certificate.run().size(); ++i) {
      const auto due = model.reference(certificate.run().times()[i]);
      position = position.cwiseMax((certificate.run().position(i) - due.positions[0]).cwiseAbs());
      tension = std::max(tension, std::abs(-certificate.run().multiplier(rod, i) - due.forces[0]));
      position_error = position_error.cwiseMax(certificate.position_error(i));
      tension_error = std::max(tension_error, certificate.multiplier_error(rod, i));
    }
    for (int k = 0; k < 2; ++k) {
      EXPECT_GE(position_error[k], 0.8 * position[k]);
      EXPECT_LE(position_error[k], 1.25 * position[k]);
    }
    EXPECT_GE(tension_error, 0.8 * tension);
    EXPECT_LE(tension_error, 1.25 * tension);
  }
}

TEST_P(LagrangianCertificates, HandOutTheRunThatWasAskedFor) {
  const LagrangianSystem<1> pendulum({.position = Vec<1>(1.0)}, [](const auto& q, const auto& v) {
    return 0.5 * v[0] * v[0] + 9.81 * cos(q[0]);
  });
  const Options options{.t_end = 1.0, .tolerance = 1e-6, .stepper = GetParam()};
  const auto certificate = certify(pendulum, options);
  const auto motion = simulate(pendulum, options);
  for (std::size_t i = 0; i < motion.size(); ++i)
    EXPECT_EQ(certificate.run().position(i)[0], motion.position(i)[0]);
  EXPECT_THROW((void)certificate.position_error(motion.size()), InvalidArgument);
}

}  // namespace
}  // namespace dalembert::lagrangian_certificate_test
