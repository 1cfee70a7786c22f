#include <dalembert/tests/extremes/cases/bounds.h>
#include <dalembert/tests/extremes/cases/stiff_scenes.h>

namespace dalembert::extremes {

namespace {

/// The foot of the right spring: on the road, at the distance 1 from the origin.
auto right_foot(const auto& t) {
  using std::sin;
  using std::sqrt;
  const auto y = 0.1 * sin(10.0 * t);
  return vec(sqrt(1.0 - y * y), y);
}

}  // namespace

// Of its units: eps = 0.01, M = 10, so each wheel's mass is eps^2 M/2 = 5e-4 and weighs as much; springs of
// stiffness 1 relaxed at 1/2. The left foot's rod to the wheel stays upright on the base between the feet:
// x_l x_b + y_l y_b = 0.
Run car_axis_at_3(const Options& options) {
  constexpr double mass = 5e-4;
  Scene<2> scene("car-axis");
  scene.add(UniformGravity<2>{{0.0, -1.0}});
  const auto left = scene.add_particle({.mass = mass, .position = {0.0, 0.5}, .velocity = {-0.5, 0.0}});
  const auto right = scene.add_particle({.mass = mass, .position = {1.0, 0.5}, .velocity = {-0.5, 0.0}});
  const auto foot = driven([](const auto& t) { return right_foot(t); });
  scene.add(Spring{Fixed<2>{}, left, 1.0, 0.5});
  scene.add(Spring{foot, right, 1.0, 0.5});
  scene.add(Distance{left, right, 1.0});
  scene.add(holonomic(points(left, foot), [](const auto& r, const auto& base) { return r.dot(base); }));

  const Vec<2> published_left(0.0493455784275402809122, 0.496989460230171153861);
  const Vec<2> published_right(1.04174252488542151681, 0.373911027265361256927);
  const Trajectory<2> run = simulate(scene, options);
  const std::size_t end = run.size() - 1;
  return {.error = std::max((run.position(left, end) - published_left).norm(),
                            (run.position(right, end) - published_right).norm()),
          .statistics = run.statistics()};
}

}  // namespace dalembert::extremes
