#include <dalembert/bench/sweeps/examples.h>
#include <dalembert/dalembert.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace dalembert::bench {

namespace {

constexpr double spin = 7.0, gravity = 9.81, sleeve_mass = 2.0;
/// Rods of length 1 about which masses of 1 are at rest: cos = (m1 + m2) g/(m1 L spin^2), see
/// models/governor.h.
constexpr double cosine = 3.0 * gravity / (spin * spin);

struct Made {
  Scene<3> scene{"governor"};
  std::vector<Constraint<1>> grounded;  ///< what acts on the axis
};

/// A mass on its side of the axis, at `upper` from the top and at `lower` from the sleeve.
void hang(Made& made, const Particle<3>& sleeve, double depth, double mass, double upper, double lower,
          double ahead) {
  const double down = (upper * upper - lower * lower + depth * depth) / (2.0 * depth);
  const double out = std::sqrt(upper * upper - down * down) * (ahead == 0.0 ? 1.0 : -1.0);
  const auto here = made.scene.add_particle(
      {.mass = mass, .position = {out, 0.0, -down}, .velocity = {0.0, spin * out, 0.0}});
  made.grounded.push_back(made.scene.add(Distance{Fixed<3>{}, here, upper}));
  made.scene.add(Distance{here, sleeve, lower});
  made.grounded.push_back(
      made.scene.add(RotatingPlane{here, Axis{}, [ahead](const auto& t) { return spin * t + ahead; }}));
}

Made make(const Row& row) {
  Made made;
  constexpr double depth = 2.0 * cosine;
  made.scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  const auto sleeve =
      made.scene.add_particle({.mass = sleeve_mass, .position = {0.0, 0.0, -depth}}, "sleeve");
  for (const Vec<3>& normal : {Vec<3>(Vec<3>::UnitX()), Vec<3>(Vec<3>::UnitY())})
    made.grounded.push_back(made.scene.add(OnSurface{sleeve, Plane<3>{.normal = normal}}));
  hang(made, sleeve, depth, row["mass_a"], row["upper_a"], row["lower_a"], 0.0);
  hang(made, sleeve, depth, row["mass_b"], row["upper_b"], row["lower_b"], std::numbers::pi);
  return made;
}

RowResult bearing(const Row& row) {
  const Made made = make(row);
  double largest = 0.0;
  simulate(made.scene, {.t_end = 1.0, .samples = 51, .tolerance = 1e-8, .stepper = Stepper::erk},
           [&](const Sample<3>& now) {
             Vec<3> force = Vec<3>::Zero();
             for (const auto& constraint : made.grounded) force += now.ground_force(constraint);
             largest = std::max(largest, std::hypot(force.x(), force.y()));
           });
  return {{largest}, {}};
}

}  // namespace

Example governors(std::size_t rows, std::uint64_t seed) {
  std::vector<Range> ranges;
  for (const char* mass : {"mass_a", "mass_b"}) ranges.push_back({mass, "kg", 0.995, 1.005});
  for (const char* rod : {"upper_a", "upper_b", "lower_a", "lower_b"})
    ranges.push_back({rod, "m", 0.998, 1.002});
  return {monte_carlo(ranges, rows, seed),
          {{{"bearing", "N"}}, {}, bearing, "a second of a governor made within tolerances, at 7 rad/s"}};
}

}  // namespace dalembert::bench
