#pragma once

#include <dalembert/constraints/distance.h>
#include <dalembert/core/points/points.h>
#include <dalembert/sweep/sweep.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace dalembert::testing_sweeps {

/// A pendulum from rest at an angle, and how it is observed: largest tension, and the bob at the end.
struct Swing {
  Scene<2> scene{"swing"};
  Particle<2> bob;
  Constraint<1> rod;

  explicit Swing(double angle, double length = 1.0) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    bob = scene.add_particle({.mass = 1.0, .position = {length * std::sin(angle), -length * std::cos(angle)}},
                             "bob");
    rod = scene.add(Distance{Fixed<2>{}, bob, length}, "rod");
  }
};

inline const Options swing_run{.t_end = 1.0, .samples = 11, .tolerance = 1e-8, .stepper = Stepper::erk};

/// Every `bad`-th row fails in mid-run; 0: none does.
inline auto make_swing(std::size_t bad = 0) {
  return [bad](const Row& row) {
    Swing swing(row["angle"]);
    if (bad > 0 && row.index() % bad == bad - 1)
      swing.scene.add(force_law(points(swing.bob), [](auto t, auto, auto v) {
        if (t > 0.5) throw std::runtime_error("a gale");
        return (-0.1 * v).eval();
      }));
    return swing;
  };
}

inline std::array<double, 2> seen(const Swing& swing, const Trajectory<2>& run) {
  return {-run.multipliers(swing.rod).minCoeff(), run.position(swing.bob, run.size() - 1).x()};
}

inline auto observe_swing() { return observing({{"tension", "N"}, {"x", "m"}}, seen); }

inline Parameters angles(std::size_t rows) { return grid({{"angle", "rad", 0.1, 3.0, rows}}); }

}  // namespace dalembert::testing_sweeps
