#include <dalembert/constraints/holonomic.h>
#include <dalembert/core/forces/forces.h>
#include <dalembert/core/scene/scene.h>

#include <gtest/gtest.h>

#include <cstdint>
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

TEST(FailedCopies, ElementThatCannotBeCopiedLeavesNoTrace) {
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

TEST(FailedCopies, NoTraceIsLeftWhicheverCopyFails) {
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

/// A parameter that must lie at a multiple of 64 bytes, of which a copy to come fails, and which counts how
/// many there are and how many lie elsewhere.
struct alignas(64) Aligned {
  struct Count {
    int left = 0, alive = 0, astray = 0;  ///< copies until one fails; now; wrongly placed
  };
  std::shared_ptr<Count> count;
  double size;

  Aligned(std::shared_ptr<Count> its, double length) : count(std::move(its)), size(length) { place(); }
  Aligned(const Aligned& other) : count(other.count), size(other.size) {
    if (--count->left == 0) throw std::runtime_error("cannot be copied");
    place();
  }
  Aligned& operator=(const Aligned&) = delete;
  ~Aligned() { --count->alive; }

 private:
  void place() {
    ++count->alive;
    if (reinterpret_cast<std::uintptr_t>(this) % alignof(Aligned) != 0) ++count->astray;
  }
};

TEST(FailedCopies, OverAlignedElementLeavesNoTrace) {
  bool failed = true;
  for (int good = 1; failed; ++good) {
    const auto count = std::make_shared<Aligned::Count>();
    failed = false;
    {
      Scene<2> scene;
      const auto a = scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}}, "a");
      const auto rod = [&](double length) {
        return holonomic(points(a), [its = Aligned(count, length)](auto r) { return r.x() - its.size; });
      };
      auto first = scene.add(rod(1.0));
      std::vector<double> expected{1.0};
      count->left = good;                                            // of all copies from here on one fails
      for (const double length : {0.5, 0.25, 0.125, 0.0625, 3.0}) {  // storage grows twice
        try {
          scene.add(rod(length));
          expected.push_back(2.0 - length);
        } catch (const std::runtime_error&) {
          failed = true;
        }
      }
      try {
        scene.replace(first, rod(4.0));
        expected[0] = -2.0;
      } catch (const std::runtime_error&) {
        failed = true;
      }
      try {
        const Scene<2> other = scene;
      } catch (const std::runtime_error&) {
        failed = true;
      }
      count->left = 0;
      const System system = scene.system();
      auto e = system.evaluation();
      system.evaluate({0.0, scene.initial_positions(), scene.initial_velocities()}, e);
      EXPECT_EQ(e.g, expected) << good;
    }
    EXPECT_EQ(count->alive, 0) << good;
    EXPECT_EQ(count->astray, 0) << good;
    if (!failed) {
      EXPECT_GT(good, 20);  // as many copies, at least, as there are constraints and scenes
    }
  }
}

}  // namespace
}  // namespace dalembert::failed_copies_test
