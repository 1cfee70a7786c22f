#include <dalembert/models/cone.h>
#include <dalembert/models/elastic_string_circle.h>
#include <dalembert/models/elastic_string_line.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/parabolic_slide.h>
#include <dalembert/models/sliding_pivot.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

/// Periods of simulated small oscillations against the frequencies that `normal_modes` gives, and these
/// against those of the notes.
///
/// Released at rest at the distance a from the equilibrium, an oscillator has the period
/// T0 (1 + c a^2 + c3 a^3 + ...); where the two sides of the equilibrium differ, the odd terms drop out of
/// the mean over releases at a and -a. So the relative deviation from T0 is c a^2 (1 + O(a^2)): it falls by 4
/// when a is halved, and extrapolated to a = 0 over a^2 it is c. With x'' = -w^2 x - A x^2 - B x^3, c = 5
/// A^2/(12 w^4) - 3 B/(8 w^2) (Lindstedt; Landau and Lifshitz, Mechanics, 28).
namespace dalembert::models::small_oscillations_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

struct Oscillation {
  double distance, rate;  // from the equilibrium
};

constexpr int swings = 4, samples_per_swing = 400;
constexpr double tolerance = 1e-11, most_steps = 10000;

/// The period, from the passages upwards through the equilibrium in a run of `swings` periods. Between two
/// samples the motion is the cubic through both with its rates: off by (w dt)^4/384 = 1.6e-10 of the
/// amplitude.
template <int D>
double period(const Scene<D>& scene, double expected,
              const std::function<Oscillation(const Sample<D>&)>& observe) {
  const double dt = expected / samples_per_swing;
  const Trajectory<D> run =
      simulate(scene, {.t_end = (swings + 0.5) * expected, .sample_interval = dt, .tolerance = tolerance});
  std::vector<double> passages;
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    const Oscillation a = observe(run.sample(i)), b = observe(run.sample(i + 1));
    if (!(a.distance < 0.0 && b.distance >= 0.0)) continue;
    const auto cubic = [&](double s) {
      const double u = 1 - s;
      return u * u * ((1 + 2 * s) * a.distance + s * dt * a.rate) +
             s * s * ((1 + 2 * u) * b.distance - u * dt * b.rate);
    };
    double low = 0.0, high = 1.0;
    while (high - low > 1e-12) (cubic((low + high) / 2) < 0.0 ? low : high) = (low + high) / 2;
    passages.push_back(run.times()[i] + low * dt);
  }
  if (passages.size() < 2) {
    ADD_FAILURE() << "no full period in the run";
    return NAN;
  }
  EXPECT_LE(static_cast<double>(run.statistics().steps), most_steps);
  return (passages.back() - passages.front()) / static_cast<double>(passages.size() - 1);
}

/// The period of the one vibration about the equilibrium near a scene's start. The closed form of its
/// frequency agrees to the rounding of terms of size 1 to 100 over a few rows.
template <int D>
double mode_period(const Scene<D>& scene, double closed_form, const UniformRotation<D>& turning = {}) {
  const auto modes = normal_modes(scene, equilibrium(scene, {.turning = turning}));
  const double omega = modes.size() > 0 ? modes.frequency(modes.size() - 1) : NAN;
  EXPECT_NEAR(omega, closed_form, 1e3 * std::numeric_limits<double>::epsilon() * closed_form);
  return two_pi / omega;
}

/// A measured period is off by what steps of the tolerance, at most `most_steps`, add to the place of the
/// passages, at a speed w a over a run of 2 pi swings/w: relative to the period, most_steps tolerance/(2 pi
/// swings a).
double noise(double amplitude) { return most_steps * tolerance / (two_pi * swings * amplitude); }

/// `period_from(a)` must deviate from `small` by c a^2 to the next order in a/scale, where `scale` is the
/// distance on which the law of force changes: coefficients of a series in a/scale are of order one.
void expect_quadratic_deviation(double small, double amplitude, double scale,
                                const std::function<double(double)>& period_from, double coefficient) {
  const auto deviation = [&](double a) { return (period_from(a) + period_from(-a)) / (2 * small) - 1; };
  const double whole = deviation(amplitude), half = deviation(amplitude / 2);
  const double a2 = amplitude * amplitude, small2 = a2 / (scale * scale),
               next_order = std::abs(4 * half - whole);  // 3/4 c4 a^4
  // Falls by 4: of what is left, 3/4 c4 a^4, the coefficient relative to c is at most 4 in units of the
  // scale.
  EXPECT_LT(next_order, 3 * small2 * std::abs(whole) + 5 * noise(amplitude / 2));
  EXPECT_GT(std::abs(whole), 100 * noise(amplitude / 2));  // the deviation is seen, not the noise
  // (16 half - whole)/3 has no a^4 term: it is c a^2 up to a^6.
  if (std::isfinite(coefficient)) {
    EXPECT_NEAR((16 * half - whole) / 3, coefficient * a2,
                small2 * next_order + 17.0 / 3 * noise(amplitude / 2));
  }
}

TEST(SmallOscillations, PendulumOnASlidingBlockIsFasterByItsMassOverTheBlocks) {
  // mex24: omega^2 = (g/L)(1 + m/M); c = (1 + 4 m/M)/16 from the quadrature of the period.
  const double omega = std::sqrt(9.81 * 1.5);
  const auto period_from = [&](double a) {
    const BlockAndBob built = SlidingPivot{.block_mass = 2.0, .bob_mass = 1.0, .angle = a}.scene();
    return period<2>(built.scene, two_pi / omega, [&](const Sample<2>& s) {
      return Oscillation{s.position(built.bob).x() - s.position(built.block).x(),
                         s.velocity(built.bob).x() - s.velocity(built.block).x()};
    });
  };
  const auto built = SlidingPivot{.block_mass = 2.0, .bob_mass = 1.0, .angle = 0.2}.scene();
  expect_quadratic_deviation(mode_period(built.scene, omega), 0.2, 1.0, period_from, (1 + 4 * 0.5) / 16);
  EXPECT_NEAR(period_from(0.2), (SlidingPivot{.angle = 0.2}.period()), noise(0.2) * two_pi / omega);
}

TEST(SmallOscillations, ParabolaGivesTheRootOfTwiceGravityTimesCurvature) {
  // mex131: omega^2 = 2 g A; c = A^2 from the elliptic integral.
  const double omega = std::sqrt(2 * 9.81 * 0.5);
  const auto period_from = [&](double a) {
    const BeadOnCurve built = ParabolicSlide{.curvature = 0.5, .amplitude = a}.scene();
    return period<2>(built.scene, two_pi / omega, [&](const Sample<2>& s) {
      return Oscillation{s.position(built.bead).x(), s.velocity(built.bead).x()};
    });
  };
  const auto built = ParabolicSlide{.curvature = 0.5, .amplitude = 0.2}.scene();
  expect_quadratic_deviation(mode_period(built.scene, omega), 0.2, 1.0, period_from, 0.25);
  EXPECT_NEAR(period_from(0.2), (ParabolicSlide{.curvature = 0.5, .amplitude = 0.2}.period()),
              noise(0.2) * two_pi / omega);
}

TEST(SmallOscillations, SlowlyTurningHoopHoldsTheBeadAtTheBottom) {
  // mex39, Omega^2 < g/R: omega^2 = g/R - Omega^2. phi'' = -omega^2 phi - (2 Omega^2/3 - g/(6 R)) phi^3.
  const double Omega2 = 4.0, omega2 = 9.81 - Omega2;
  const auto period_from = [&](double a) {
    const HoopAboutDiameter hoop{.spin = 2.0, .angle = a};
    const BeadOnHoop built = hoop.scene();
    return period<3>(built.scene, two_pi / std::sqrt(omega2), [&](const Sample<3>& s) {
      const double turned = hoop.spin * s.time();
      const Vec<3> outwards(std::cos(turned), std::sin(turned), 0.0);  // sideways the bead never is
      return Oscillation{outwards.dot(s.position(built.bead)), outwards.dot(s.velocity(built.bead))};
    });
  };
  const auto hoop = HoopAboutDiameter{.spin = 2.0, .angle = 0.2}.scene();
  const UniformRotation<3> turning{.rate = {0.0, 0.0, 2.0}};
  expect_quadratic_deviation(mode_period(hoop.scene, std::sqrt(omega2), turning), 0.2, 1.0, period_from,
                             -3 * (2 * Omega2 / 3 - 9.81 / 6) / (8 * omega2));
}

TEST(SmallOscillations, FastTurningHoopHoldsTheBeadWhereItIsThrown) {
  // mex39, Omega^2 > g/R: cos phi0 = g/(R Omega^2), omega^2 = Omega^2 sin^2 phi0. From the potential
  // V = -(g/R) cos phi - (Omega^2/2) sin^2 phi: 2 A = V''' and 6 B = V'''' at phi0.
  const HoopAboutDiameter hoop{.spin = 5.0};
  const double phi0 = std::acos(9.81 / 25.0), g = 9.81, Omega2 = 25.0;
  const double omega2 = Omega2 * std::sin(phi0) * std::sin(phi0);
  const double A = (-g * std::sin(phi0) + 2 * Omega2 * std::sin(2 * phi0)) / 2;
  const double B = (-g * std::cos(phi0) + 4 * Omega2 * std::cos(2 * phi0)) / 6;
  const auto period_from = [&](double a) {
    HoopAboutDiameter released = hoop;
    released.angle = phi0 + a;
    const BeadOnHoop built = released.scene();
    return period<3>(built.scene, two_pi / std::sqrt(omega2), [&](const Sample<3>& s) {
      return Oscillation{s.position(built.bead).z() + std::cos(phi0), s.velocity(built.bead).z()};
    });
  };
  const UniformRotation<3> turning{.rate = {0.0, 0.0, hoop.spin}};
  expect_quadratic_deviation(mode_period(hoop.scene().scene, std::sqrt(omega2), turning), 0.1, 1.0,
                             period_from, 5 * A * A / (12 * omega2 * omega2) - 3 * B / (8 * omega2));
}

TEST(SmallOscillations, GovernorOscillatesAboutItsWorkingAngle) {
  // mex23: omega^2 = m1 Omega^2 sin^2 theta0/(m1 + 2 m2 sin^2 theta0).
  const Governor governor{.mass = 1.0, .sleeve_mass = 2.0, .spin = 7.0};
  const double cosine = 3 * 9.81 / 49.0, sine2 = 1 - cosine * cosine;
  const double small = two_pi / std::sqrt(49.0 * sine2 / (1 + 4 * sine2));
  const auto period_from = [&](double a) {
    Governor released = governor;
    released.angle = std::acos(cosine) + a;
    const auto [scene, parts] = released.scene();
    return period<3>(scene, small, [&sleeve = parts.sleeve, cosine](const Sample<3>& s) {
      return Oscillation{s.position(sleeve).z() + 2 * cosine, s.velocity(sleeve).z()};
    });
  };
  const UniformRotation<3> turning{.rate = {0.0, 0.0, governor.spin}};
  expect_quadratic_deviation(mode_period(governor.scene().scene, two_pi / small, turning), 0.1, 1.0,
                             period_from, NAN);
}

TEST(SmallOscillations, BlockOnALineFeelsAThirdOfTheStringsStiffness) {
  // mex251a: omega^2 = k/(3 m) for d = 3 l0/2; c = -(3/16)(l0/d)/(1 - l0/d)/d^2 = -(3/8)/(9/4) = -1/6.
  const double small = two_pi / std::sqrt(30.0 / 3);
  const auto period_from = [&](double a) {
    const BeadOnCurve built = ElasticStringLine{.stiffness = 30.0, .amplitude = a}.scene();
    return period<2>(built.scene, small, [&](const Sample<2>& s) {
      return Oscillation{s.position(built.bead).x(), s.velocity(built.bead).x()};
    });
  };
  const auto built = ElasticStringLine{.stiffness = 30.0, .amplitude = 0.2}.scene();
  expect_quadratic_deviation(mode_period(built.scene, two_pi / small), 0.2, 1.5, period_from, -1.0 / 6);
}

TEST(SmallOscillations, BlockOnACircleOscillatesAsItsStringIsTied) {
  // mex251b: omega^2 = (k/3m)(d/r), d = r + 3 l0/2 outside and r - 3 l0/2 inside, r = 2, l0 = 1;
  // c = [1 - 3 (l0/b) r d/(s b^2)]/16 with b = 3/2, s = 1/3: [1 - (16/3) d]/16.
  for (const auto tied : {ElasticStringCircle::Tied::outside, ElasticStringCircle::Tied::inside}) {
    const double d = tied == ElasticStringCircle::Tied::outside ? 3.5 : 0.5;
    const double small = two_pi / std::sqrt(30.0 / 3 * d / 2);
    const auto period_from = [&](double a) {
      const BeadOnCurve built = ElasticStringCircle{.stiffness = 30.0, .tied = tied, .angle = a}.scene();
      return period<2>(built.scene, small, [&](const Sample<2>& s) {
        return Oscillation{s.position(built.bead).y(), s.velocity(built.bead).y()};
      });
    };
    const auto built = ElasticStringCircle{.stiffness = 30.0, .tied = tied, .angle = 0.1}.scene();
    expect_quadratic_deviation(mode_period(built.scene, two_pi / small), 0.1, 1.5 / std::sqrt(2 * d),
                               period_from, (1 - 16.0 / 3 * d) / 16);
  }
}

TEST(SmallOscillations, ConeGivesThoseOfTheCircularOrbit) {
  // mex133: phi'^2 = g cot(a)/r and omega^2 = 3 phi'^2 sin^2 a. At the angular momentum of the circular orbit
  // of radius 1, released at r = 1 + x: x'' = (omega^2/3)((1 + x)^-3 - 1), so A = -2 omega^2, B = 10
  // omega^2/3, c = 5/12.
  const double half_angle = 0.6, sine = std::sin(half_angle), cotangent = 1 / std::tan(half_angle);
  const double small = two_pi / std::sqrt(3 * 9.81 * cotangent * sine * sine);
  const auto period_from = [&](double a) {
    const double r = 1 + a;
    const ParticleOnCone built =
        ConeSlide{.half_angle = half_angle, .start_radius = r, .speed_ratio = std::sqrt(cotangent / r) / r}
            .scene();
    return period<3>(built.scene, small, [&](const Sample<3>& s) {
      return Oscillation{s.position(built.particle).z() - cotangent, s.velocity(built.particle).z()};
    });
  };
  const auto orbit = ConeSlide{.half_angle = half_angle, .start_radius = 1.05}.scene();
  const UniformRotation<3> turning{.rate = {0.0, 0.0, std::sqrt(9.81 * cotangent)}};
  expect_quadratic_deviation(mode_period(orbit.scene, two_pi / small, turning), 0.1, 1.0, period_from,
                             5.0 / 12);
}

}  // namespace
}  // namespace dalembert::models::small_oscillations_test
