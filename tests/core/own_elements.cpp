#include <dalembert/dalembert.h>

#include <gtest/gtest.h>

/// What users write stands in their namespace, where no name of the library is found by itself.
namespace someone {

using dalembert::Constraint, dalembert::Particle;

struct Well {
  Particle<2> p;
  auto points() const { return std::tuple{p}; }
  auto energy(const auto& r) const { return r.dot(r); }
};
struct Drag {
  Particle<2> p;
  auto points() const { return std::tuple{p}; }
  auto force(const auto&, const auto& v) const { return (-0.5 * v).eval(); }
};
struct Brake {
  Particle<2> p;
  Constraint<1> of;
  auto points() const { return std::tuple{p}; }
  const Constraint<1>& constraint() const { return of; }
  auto friction(const auto& lambda, const auto&, const auto& v) const { return (0.25 * lambda * v).eval(); }
};
struct Rod {
  Particle<2> p;
  auto points() const { return std::tuple{p}; }
  auto operator()(const auto& r) const { return r.norm() - 1.0; }
};
struct Blade {
  static constexpr bool velocity_level = true;
  Particle<2> p;
  auto points() const { return std::tuple{p}; }
  auto operator()(const auto&, const auto& v) const { return v.y() - 0.5 * v.x(); }
};
struct Circle {
  auto operator()(const auto& r) const { return r.norm() - 1.0; }
};

}  // namespace someone

/// And where a using-directive has them all found.
namespace someone_with_all_names {

using namespace dalembert;

auto wedge(Particle<2> p) {
  return potential(points(p), [](auto r) { return 3.0 * abs(r.x()) + max(r.y(), 0.0); });
}

}  // namespace someone_with_all_names

namespace dalembert::own_elements_test {
namespace {

/// Energies are asked of an equation with plain numbers, slopes with those that carry derivatives.
TEST(OwnElements, CallAbsAndMaxOfPlainNumbersToo) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .position = {-0.5, 0.25}});
  const auto wedge = scene.add(someone_with_all_names::wedge(p));
  const Simulation<2> at_start(scene, {.t_end = 1.0});
  EXPECT_EQ(at_start.energy(), 1.75);
  EXPECT_EQ(at_start.force(wedge, p), Vec<2>(3.0, -1.0));
}

/// On a unit circle at (1, 0) with v = (0, 2): F = -2 r - v/2 + lambda v/4, and lambda = -v^2 + 2.
TEST(OwnElements, MayBeOfAnotherNamespace) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 2.0}});
  const auto rod = scene.add(someone::Rod{p});
  scene.add(someone::Well{p});
  scene.add(someone::Drag{p});
  scene.add(someone::Brake{p, rod});
  const auto q = scene.add_particle({.mass = 1.0, .position = {3.0, 0.0}, .velocity = {2.0, 1.0}});
  scene.add(someone::Blade{q});
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}, .velocity = {3.0, 0.0}});
  const auto ring = scene.add(OnCurve{bead, someone::Circle{}});
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const Simulation<2> at_start(scene, {.t_end = 1.0, .stepper = stepper});
    // Round-off of a few operations on numbers below 10.
    const double bound = 1e2 * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(at_start.multiplier(rod), -2.0, bound);
    EXPECT_NEAR(at_start.acceleration(p).y(), -2.0, bound);
    EXPECT_NEAR(at_start.acceleration(q).norm(), 0.0, bound);
    EXPECT_NEAR(at_start.multiplier(ring), -9.0, bound);
  }
  (void)simulate(scene, {.t_end = 0.1, .samples = 2});
}

}  // namespace
}  // namespace dalembert::own_elements_test
