#include "dalembert/core/points/points.h"

#include <dalembert/core/equations/arguments.h>
#include <dalembert/core/equations/elements.h>

#include <gtest/gtest.h>

#include <array>

namespace dalembert::points_test {
namespace {

/// Holds two points and does nothing else.
template <class A, class B>
struct Pair {
  A a;
  B b;
  auto points() const { return std::tie(a, b); }
};

TEST(Points, AParticleGathersItsOwnCoordinates) {
  const std::array<double, 6> q{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  EXPECT_EQ((Particle<2>{1, 2, 1}.gather(q)), Vec<2>(3.0, 4.0));
  EXPECT_EQ((Particle<3>{1, 3, 1}.gather(q)), Vec<3>(4.0, 5.0, 6.0));
}

TEST(Points, OnlyParticlesAreInputs) {
  const auto moving = driven([](auto t) { return vec(t, 2.0 * t); });
  using Moving = std::remove_const_t<decltype(moving)>;
  using Facts = PointsOf<std::tuple<Fixed<2>, Particle<2>, Moving, Particle<2>>>;
  EXPECT_EQ(Facts::inputs, 4);
  EXPECT_TRUE(Facts::driven);
  EXPECT_EQ(Facts::first_input, (std::array<int, 4>{0, 0, 2, 2}));
  using Still = PointsOf<std::tuple<Fixed<3>, Particle<3>>>;
  EXPECT_EQ(Still::inputs, 3);
  EXPECT_FALSE(Still::driven);
}

TEST(Points, TheCoordinatesReadAreThoseOfTheParticlesInOrder) {
  std::array<int, 4> coordinates{};
  const Pair<Particle<2>, Particle<2>> pair{{1, 2, 1}, {0, 0, 1}};
  detail::read_places<Pair<Particle<2>, Particle<2>>>(&pair, coordinates.data());
  EXPECT_EQ(coordinates, (std::array<int, 4>{2, 3, 0, 1}));
}

TEST(Driven, PathTakesItsDimensionFromWhatItReturns) {
  const auto planar = driven([](auto t) { return vec(t, 0.0); });
  const auto spatial = driven([](auto t) { return vec(t, 0.0, 1.0); });
  EXPECT_EQ(planar.dimension, 2);
  EXPECT_EQ(spatial.dimension, 3);
  EXPECT_EQ(planar.inputs, 0);
}

// r = (sin 2t, t^3): r' = (2 cos 2t, 3 t^2), r'' = (-4 sin 2t, 6 t). sin and cos are the same calls
// here and there; products differ by a rounding or two.
TEST(Driven, VelocityAndAccelerationAreDerivativesOfThePath) {
  const auto point = driven([](auto t) { return vec(sin(2.0 * t), t * t * t); });
  const double t = 0.6;
  const Vec<2> v = detail::driven_velocity<double>(point, t);
  EXPECT_DOUBLE_EQ(v.x(), 2.0 * std::cos(2.0 * t));
  EXPECT_DOUBLE_EQ(v.y(), 3.0 * t * t);
  using S = Jet<1>;
  const auto with_rate = detail::driven_velocity<S>(point, S::input(t, 0, 1.0));
  EXPECT_DOUBLE_EQ(with_rate.x().value, v.x());
  EXPECT_DOUBLE_EQ(with_rate.x().s, -4.0 * std::sin(2.0 * t));
  EXPECT_DOUBLE_EQ(with_rate.y().s, 6.0 * t);
}

TEST(Driven, APointThatStandsStillHasNoVelocity) {
  const auto point = driven([](auto) { return vec(1.0, 2.0); });
  EXPECT_EQ(detail::driven_velocity<double>(point, 3.0), Vec<2>::Zero());
}

}  // namespace
}  // namespace dalembert::points_test
