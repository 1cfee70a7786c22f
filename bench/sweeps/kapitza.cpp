#include <dalembert/bench/sweeps/examples.h>
#include <dalembert/dalembert.h>
#include <dalembert/models/driven_pivot.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace dalembert::bench {

namespace {

constexpr double widest = 0.6, highest = 0.12;  ///< of the chart, as in `dalembert-bench diagrams`
constexpr double periods = 100.0;

models::DrivenPivot upright(double amplitude, double gravity, double off) {
  auto pivot = models::DrivenPivot::vertical(amplitude);
  pivot.gravity = gravity * pivot.frequency * pivot.frequency;
  pivot.angle = std::numbers::pi - off;
  return pivot;
}

double period(const models::DrivenPivot& pivot) { return 2.0 * std::numbers::pi / pivot.frequency; }

RowResult leaves(const Row& row) {
  const auto pivot = upright(row["amplitude"], row["gravity"], 1e-3);
  const auto built = pivot.scene();  // the pivot moves along the vertical x = 0
  const auto near = [bob = built.bob](const auto& now) { return 0.1 - std::abs(now.position(bob).x()); };
  const auto run =
      simulate(built.scene,
               {.t_end = periods * period(pivot), .samples = 2, .tolerance = 1e-7, .stepper = Stepper::erk},
               {Event<2>{"leaves", near, Crossing::falling, true}});
  const double never = std::numeric_limits<double>::infinity();
  return {{run.events().empty() ? never : run.events()[0].time / period(pivot)}, {}};
}

double growth(double amplitude, double gravity) {
  const auto pivot = upright(amplitude, gravity, 0.0);
  return floquet(pivot.scene().scene, period(pivot)).growth();
}

/// Stable multipliers have modulus 1, within the accuracy of a double root.
bool stable(double amplitude, double gravity) { return growth(amplitude, gravity) < 1.0 + 1e-5; }

/// Between a stable and an unstable gravity, to a hundredth of the chart's pixels.
double edge(double amplitude, double in, double out) {
  while (std::abs(out - in) > 1e-6) {
    const double middle = 0.5 * (in + out);
    (stable(amplitude, middle) ? in : out) = middle;
  }
  return in;
}

/// The stable interval of gravity, found from a stable value in it.
RowResult boundary(const Row& row) {
  const double A = row["amplitude"];
  constexpr int tries = 96;
  for (int i = 0; i < tries; ++i) {
    const double inside = highest * (i + 0.5) / tries;
    if (!stable(A, inside)) continue;
    const double lower =
        i == 0 && stable(A, 0.0) ? 0.0 : edge(A, inside, i == 0 ? 0.0 : inside - highest / tries);
    double upper = inside;
    while (upper < highest && stable(A, upper + highest / tries)) upper += highest / tries;
    return {{lower, upper < highest ? edge(A, upper, upper + highest / tries) : highest}, {}};
  }
  return {{-1.0, -1.0}, {}};
}

}  // namespace

Example kapitza(std::size_t points) {
  const double half = 0.5 / static_cast<double>(points);
  return {grid({{"amplitude", "l", widest * half, widest * (1.0 - half), points},
                {"gravity", "l omega^2", highest * half, highest * (1.0 - half), points}}),
          {{{"gone", "periods"}}, {}, leaves, "a pendulum upright on a shaken pivot, 100 periods"}};
}

Example kapitza_boundary(std::size_t points) {
  return {grid({{"amplitude", "l", 0.01, widest, points}}),
          {{{"lower", "l omega^2"}, {"upper", "l omega^2"}},
           {},
           boundary,
           "where it is stable, by Floquet multipliers"}};
}

}  // namespace dalembert::bench
