#include <dalembert/core/forces/forces.h>
#include <dalembert/core/scene/scene.h>

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dalembert::failed_copies_test {
namespace {

/// A parameter whose copies fail on demand.
struct Fragile {
  std::shared_ptr<bool> broken;

  explicit Fragile(std::shared_ptr<bool> its) : broken(std::move(its)) {}
  Fragile(const Fragile& other) : broken(other.broken) {
    if (*broken) throw std::runtime_error("cannot be copied");
  }
  Fragile(Fragile&& other) noexcept(false) : Fragile(static_cast<const Fragile&>(other)) {}
  Fragile& operator=(const Fragile&) = delete;
  Fragile& operator=(Fragile&&) = delete;
  ~Fragile() = default;
};

TEST(FailedCopies, OfAnElementLeaveNoTrace) {
  const auto broken = std::make_shared<bool>(false);
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0}, "a"), b = scene.add_particle({.mass = 1.0}, "b");
  const auto pull = [](const Particle<2>& on, double size, const Fragile& fragile) {
    return force_law(points(on), [size, fragile](auto, auto) { return Vec<2>{size, 0.0}; });
  };
  const Fragile fragile(broken);
  const auto first = scene.add(pull(a, 1.0, fragile));
  auto second = pull(b, 2.0, fragile), other = pull(b, 3.0, fragile);
  *broken = true;
  EXPECT_THROW(scene.add(second), std::runtime_error);
  EXPECT_THROW(scene.replace(first, other), std::runtime_error);
  *broken = false;
  scene.add(second);
  const System system = scene.system();
  auto e = system.evaluation();
  system.evaluate({0.0, scene.initial_positions(), scene.initial_velocities()}, e);
  EXPECT_EQ(e.force, (std::vector<double>{1.0, 0.0, 2.0, 0.0}));
}

/// A parameter of which a copy to come fails.
struct Late {
  std::shared_ptr<int> copies;

  explicit Late(std::shared_ptr<int> its) : copies(std::move(its)) {}
  Late(const Late& other) : copies(other.copies) {
    if (--*copies == 0) throw std::runtime_error("cannot be copied");
  }
  Late& operator=(const Late&) = delete;
  ~Late() = default;
};

TEST(FailedCopies, WhicheverItIsLeavesNoTrace) {
  for (int good = 1;; ++good) {
    const auto copies = std::make_shared<int>(0);
    Scene<2> scene;
    const auto a = scene.add_particle({.mass = 1.0}, "a");
    const auto pull = [late = Late(copies)](auto, auto) { return Vec<2>{1.0, 0.0}; };
    scene.add(force_law(points(a), pull));
    *copies = good;
    bool failed = false;
    try {
      scene.add(force_law(points(a), pull));
    } catch (const std::runtime_error&) {
      failed = true;
    }
    *copies = 0;
    const System system = scene.system();
    auto e = system.evaluation();
    system.evaluate({0.0, scene.initial_positions(), scene.initial_velocities()}, e);
    EXPECT_EQ(e.force[0], failed ? 1.0 : 2.0) << good;
    if (!failed) {
      EXPECT_GT(good, 2);  // one to state it, one at least to keep it
      break;
    }
  }
}

}  // namespace
}  // namespace dalembert::failed_copies_test
