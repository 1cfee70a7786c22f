#include "dalembert/core/forces/forces.h"

#include "../equations.h"
#include "../finite_differences.h"
#include <dalembert/core/scene/scene.h>

#include <Eigen/Core>
#include <gmock/gmock.h>

namespace dalembert::forces_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two particles, one force of the test's choice, and a state in which nothing is zero.
class Forces : public testing::Test {
 protected:
  Scene<2> scene;
  Particle<2> a = scene.add_particle({.mass = 1.0});
  Particle<2> b = scene.add_particle({.mass = 2.0});
  State state{0.3, Eigen::Vector4d(0.5, -0.2, 1.7, 0.9), Eigen::Vector4d(0.4, 1.1, -0.6, 0.3)};

  [[nodiscard]] Eigen::VectorXd force_at(const State& s) const { return values(scene.system(), s).F; }
  void expect_consistent_force() const { expect_consistent(scene.system(), state, Eigen::VectorXd()); }

  /// F = -dV/dq of the energy that the system reports.
  void expect_force_of_energy() const {
    const auto system = scene.system();
    for (Eigen::Index j = 0; j < 4; ++j) {
      const auto energy = [&](double s) {
        State to = state;
        to.q[j] += s;
        return Eigen::VectorXd::Constant(1, -system.forces().energy(to.instant()));
      };
      expect_slope(slope(energy), force_at(state).segment(j, 1), "F = -dV/dq");
    }
  }
};

// Stretched from 2 to 5 with stiffness 10: tension 30 along (3, 4)/5, energy 10 * 3^2 / 2.
TEST_F(Forces, AStretchedSpringPulls) {
  scene.add(Spring{a, b, 10.0, 2.0});
  const State s{0.0, Eigen::Vector4d(1.0, 1.0, 4.0, 5.0), Eigen::Vector4d::Zero()};
  EXPECT_TRUE(force_at(s).isApprox(Eigen::Vector4d(18.0, 24.0, -18.0, -24.0), 1e-15));
  EXPECT_DOUBLE_EQ(scene.system().forces().energy(s.instant()), 45.0);
}

// Compressed from 7 to 5: it pushes b away with 20.
TEST_F(Forces, ACompressedSpringPushes) {
  scene.add(Spring{a, b, 10.0, 7.0});
  const State s{0.0, Eigen::Vector4d(1.0, 1.0, 4.0, 5.0), Eigen::Vector4d::Zero()};
  EXPECT_TRUE(force_at(s).isApprox(Eigen::Vector4d(-12.0, -16.0, 12.0, 16.0), 1e-15));
}

TEST_F(Forces, ASpringWithoutLengthIsSmoothWhereItsPointsMeet) {
  scene.add(Spring{a, b, 10.0});
  const State s{0.0, Eigen::Vector4d(1.0, 1.0, 1.0, 1.0), Eigen::Vector4d::Zero()};
  EXPECT_EQ(force_at(s), Eigen::Vector4d::Zero());
  const auto d = derivatives(scene.system(), s, Eigen::VectorXd());
  EXPECT_EQ(d.stiffness(0, 0), -10.0);
  EXPECT_EQ(d.stiffness(0, 2), 10.0);
}

TEST_F(Forces, ASpringWithLengthFailsByNameWhereItsPointsMeet) {
  scene.add(Spring{a, b, 10.0, 1.0}, "spiral");
  const State s{0.5, Eigen::Vector4d(1.0, 1.0, 1.0, 1.0), Eigen::Vector4d::Zero()};
  EXPECT_THAT([&] { (void)force_at(s); },
              ThrowsMessage<EquationFault>(AllOf(HasSubstr("Spring \"spiral\""), HasSubstr("t = 0.5"))));
}

TEST_F(Forces, DerivativesOfASpringAreConsistent) {
  scene.add(Spring{a, b, 10.0, 0.7});
  scene.add(Spring{Fixed<2>{{0.1, 0.2}}, b, 3.0});
  scene.add(Spring{driven([](auto t) { return vec(sin(t), t * t); }), a, 2.0, 0.4});
  expect_consistent_force();
  expect_force_of_energy();
}

// Points 5 apart along (3, 4)/5 part with relative velocity (1, 2): rate 11/5, force 2 * 11/5.
TEST_F(Forces, ADamperResistsTheRateOfItsLength) {
  scene.add(Damper{a, b, 2.0});
  const State s{0.0, Eigen::Vector4d(1.0, 1.0, 4.0, 5.0), Eigen::Vector4d(0.0, -1.0, 1.0, 1.0)};
  const Vec<2> on_a = 2.0 * 11.0 / 5.0 * Vec<2>(0.6, 0.8);
  EXPECT_TRUE(force_at(s).isApprox((Eigen::Vector4d() << on_a, -on_a).finished(), 1e-15));
  EXPECT_EQ(scene.system().forces().energy(s.instant()), 0.0);
}

// A velocity across the line of sight does not change the distance.
TEST_F(Forces, ADamperDoesNotResistRotation) {
  scene.add(Damper{a, b, 2.0});
  const State s{0.0, Eigen::Vector4d(0.0, 0.0, 1.0, 0.0), Eigen::Vector4d(0.0, 0.0, 0.0, 3.0)};
  EXPECT_EQ(force_at(s), Eigen::Vector4d::Zero());
}

// The driven end recedes at 3: the damper pulls b after it with 2 * 3.
TEST_F(Forces, ADamperFeelsTheVelocityOfADrivenEnd) {
  scene.add(Damper{driven([](auto t) { return vec(-3.0 * t, 0.0); }), b, 2.0});
  const State s{1.0, Eigen::Vector4d(0.0, 0.0, 1.0, 0.0), Eigen::Vector4d::Zero()};
  EXPECT_TRUE(force_at(s).isApprox(Eigen::Vector4d(0.0, 0.0, -6.0, 0.0), 1e-15));
}

TEST_F(Forces, DerivativesOfADamperAreConsistent) {
  scene.add(Damper{a, b, 10.0});
  scene.add(Damper{Fixed<2>{{0.1, 0.2}}, b, 3.0});
  scene.add(Damper{driven([](auto t) { return vec(sin(t), t * t); }), a, 2.0});
  expect_consistent_force();
}

TEST_F(Forces, DerivativesOfAPotentialAreConsistent) {
  scene.add(potential(points(a, b),
                      [](auto r_a, auto r_b) { return 1.0 / (r_b - r_a).norm() + r_a.x() * r_b.y(); }));
  scene.add(potential(points(b), [](auto t, auto r) { return sin(3.0 * t) * r.x() * r.y(); }));
  expect_consistent_force();
  expect_force_of_energy();
}

TEST_F(Forces, DerivativesOfAForceLawAreConsistent) {
  scene.add(
      force_law(points(a), [](auto r, auto v) { return (-v * v.norm() * (1.0 + r.squaredNorm())).eval(); }));
  scene.add(force_law(points(a, b), [](auto t, auto r_a, auto r_b, auto v_a, auto v_b) {
    const auto f = (sin(t) * (v_b - v_a) * r_a.dot(r_b)).eval();
    return std::tuple{f, (-f).eval()};
  }));
  expect_consistent_force();
}

// A force law of a fixed and a moving point: only the force on the moving one enters.
TEST_F(Forces, AForceLawActsOnItsParticlesOnly) {
  scene.add(force_law(points(Fixed<2>{{1.0, 0.0}}, b), [](auto r_a, auto r_b, auto, auto) {
    const auto f = (r_a - r_b).eval();
    return std::tuple{(-f).eval(), f};
  }));
  EXPECT_EQ(force_at(state), Eigen::Vector4d(0.0, 0.0, 1.0 - 1.7, -0.9));
}

TEST_F(Forces, ASpringRefusesAParameterThatMakesNoSense) {
  for (const double bad : {-1.0, nan, infinity}) {
    EXPECT_THAT(
        [&] {
          scene.add(Spring{a, b, bad}, "spiral");
        },
        ThrowsMessage<InvalidScene>(
            AllOf(HasSubstr("Spring \"spiral\""), HasSubstr("stiffness = "), HasSubstr("finite and >= 0"))));
    EXPECT_THAT(
        [&] {
          scene.add(Spring{a, b, 1.0, bad}, "coil");
        },
        ThrowsMessage<InvalidScene>(AllOf(HasSubstr("Spring \"coil\""), HasSubstr("relaxed_length = "),
                                          HasSubstr("finite and >= 0"))));
  }
}

TEST_F(Forces, ADamperRefusesACoefficientThatMakesNoSense) {
  for (const double bad : {-1.0, nan, infinity}) {
    EXPECT_THAT(
        [&] {
          scene.add(Damper{a, b, bad}, "pot");
        },
        ThrowsMessage<InvalidScene>(
            AllOf(HasSubstr("Damper \"pot\""), HasSubstr("coefficient = "), HasSubstr("finite and >= 0"))));
  }
}

TEST_F(Forces, ABadNumberOrAnExceptionNamesTheForce) {
  scene.add(force_law(points(a), [](auto, auto v) { return (v / 0.0).eval(); }), "wind");
  EXPECT_THAT([&] { (void)force_at(state); },
              ThrowsMessage<EquationFault>(AllOf(HasSubstr("\"wind\""), HasSubstr("not a finite number"))));
  Scene<2> other;
  const auto c = other.add_particle({.mass = 1.0});
  other.add(
      potential(points(c), [](auto r) -> decltype(r.x() * 1.0) { throw std::runtime_error("too far"); }),
      "well");
  const State s{0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  EXPECT_THAT(
      [&] { (void)values(other.system(), s); },
      ThrowsMessage<EquationFault>(AllOf(HasSubstr("Potential \"well\""), HasSubstr("threw \"too far\""))));
}

}  // namespace
}  // namespace dalembert::forces_test
