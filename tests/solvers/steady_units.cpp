#include <dalembert/dalembert.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace dalembert::steady_units_test {
namespace {

/// Frequencies are roots of squares that are known to some thousand roundings of terms of size 1 to 100.
constexpr double rounding = 1e-9;

/// Units of a scene, and how many of its lengths it is away from the origin.
struct Place {
  double length, time, off;
};
const std::vector<Place> units{{1.0, 1.0, 0.0}, {1e-8, 1.0, 0.0}, {1e-3, 1e3, 0.0},
                               {1e5, 1.0, 0.0}, {1e8, 1e-6, 0.0}, {1e10, 1e7, 0.0}};

/// The positive frequencies of the vibrations that are not free, in radians per unit of time.
template <int D>
std::vector<double> frequencies(const NormalModes<D>& modes, double time) {
  std::vector<double> all;
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (!modes.is_free(k)) all.push_back(modes.frequency(k) * time);
  return all;
}

TEST(Steady, EquilateralMotionHasRouthsEigenvaluesInAnyUnitOfLength) {
  // Routh: s^4 + s^2 + 27/4 (m1 m2 + m2 m3 + m3 m1)/M^2 = 0 in units of the rate; of the centre and of the
  // size +-i three times, and 0 of the angle. Those of the centre are a double one, known to a root.
  const std::array<double, 3> m{20.0, 0.5, 0.1};
  const double M = 20.6, product = 27.0 / 4.0 * (m[0] * m[1] + m[1] * m[2] + m[2] * m[0]) / (M * M);
  const double root = std::sqrt(1.0 - 4.0 * product);
  for (const auto& [L, T, off] : units) {
    const double a = 2.0 * L, G = L * L * L / (T * T), rate = std::sqrt(G * M / (a * a * a));
    const std::array<Vec<2>, 3> r{Vec<2>(0.0, 0.0), Vec<2>(a, 0.0), Vec<2>(0.5 * a, std::sqrt(0.75) * a)};
    const Vec<2> centre = (m[0] * r[0] + m[1] * r[1] + m[2] * r[2]) / M;
    Scene<2> scene("equilateral");
    std::vector<Particle<2>> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec<2> d = r[i] - centre;
      p.push_back(
          scene.add_particle({.mass = m[i], .position = d, .velocity = rate * Vec<2>(-d.y(), d.x())}));
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < i; ++j)
        scene.add(potential(points(p[i], p[j]),
                            [k = G * m[i] * m[j]](auto x, auto y) { return -k / (x - y).norm(); }));
    const auto modes = normal_modes(scene, steady(scene));
    EXPECT_NE(modes.stability(), Stability::unstable) << L;
    const auto all = frequencies(modes, 1.0 / rate);
    ASSERT_EQ(all.size(), 5u) << L;
    EXPECT_NEAR(all[0], std::sqrt(0.5 * (1.0 - root)), rounding) << L;
    EXPECT_NEAR(all[1], std::sqrt(0.5 * (1.0 + root)), rounding) << L;
    for (std::size_t k = 2; k < 5; ++k) EXPECT_NEAR(all[k], 1.0, 1e-6) << L;
  }
}

}  // namespace
}  // namespace dalembert::steady_units_test
