#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>

namespace dalembert::extremes {

namespace {

constexpr double t_end = 10.0;

/// A lone particle and its closed form; it has no length but that of its path.
template <int D>
struct Lone {
  Scene<D> scene{"lone"};
  Particle<D> particle{};
  std::function<Vec<D>(double t)> exact{};
};

/// A charge in crossed fields, v' = (B v_y, -g - B v_x), starts at or near the cusp of a cycloid: with
/// w = v_x + g/B, (w, v_y) turns at the rate B.
Lone<2> cycloid(double v) {
  constexpr double g = 9.81, B = 3.0;
  Lone<2> s;
  s.scene.add(UniformGravity<2>{{0.0, -g}});
  s.particle = s.scene.add_particle({.mass = 1.0, .velocity = {v, 0.0}}, "charge");
  s.scene.add(force_law(points(s.particle), [](auto, auto u) { return vec(B * u.y(), -B * u.x()); }));
  s.exact = [v](double t) {
    const double radius = (v + g / B) / B;
    return Vec<2>(radius * std::sin(B * t) - g / B * t, -radius * (1.0 - std::cos(B * t)));
  };
  return s;
}

/// v' = (0, -g) - k v.
Lone<2> dragged(double v) {
  constexpr double g = 9.81, k = 0.5;
  Lone<2> s;
  s.scene.add(UniformGravity<2>{{0.0, -g}});
  s.particle = s.scene.add_particle({.mass = 1.0, .velocity = {v, v}}, "projectile");
  s.scene.add(LinearDrag{s.particle, k});
  s.exact = [v](double t) {
    const Vec<2> last(0.0, -g / k), lost = Vec<2>(v, v) - last;
    return Vec<2>(last * t - lost * (std::expm1(-k * t) / k));
  };
  return s;
}

/// A block slides up a smooth plane and down again.
Lone<3> block(double v) {
  constexpr double a = 3.0;
  Lone<3> s;
  s.scene.add(UniformGravity<3>{{a, 0.0, -9.0}});
  s.particle = s.scene.add_particle({.mass = 1.0, .velocity = {-v, 0.0, 0.0}}, "block");
  s.scene.add(OnSurface{s.particle, Plane<3>{}});
  s.exact = [v](double t) { return Vec<3>(-v * t + 0.5 * a * t * t, 0.0, 0.0); };
  return s;
}

/// A knife edge on a slope turns at the rate w: its speed along itself has s' = g cos(w t).
Lone<2> knife_edge(double v) {
  constexpr double g = 3.82, w = 1.3;
  Lone<2> s;
  s.scene.add(UniformGravity<2>{{g, 0.0}});
  s.particle = s.scene.add_particle({.mass = 2.0, .velocity = {v, 0.0}}, "edge");
  const Rotor heading = s.scene.add_rotor({.inertia = 0.3, .angular_velocity = w});
  s.scene.add(nonholonomic(points(s.particle, heading), [](auto, auto phi, auto u, auto) {
    return cos(phi[0]) * u.y() - sin(phi[0]) * u.x();
  }));
  s.exact = [v](double t) {
    const double sine = std::sin(w * t), half = std::sin(0.5 * w * t);
    return Vec<2>(v * sine / w + 0.5 * g * sine * sine / (w * w),
                  2.0 * v * half * half / w + g / w * (0.5 * t - 0.25 * std::sin(2.0 * w * t) / w));
  };
  return s;
}

/// The largest error over the largest coordinate.
template <int D>
Run compared_alone(const Lone<D>& s, Stepper stepper) {
  const Trajectory<D> run = simulate(s.scene, {.t_end = t_end, .tolerance = tolerance, .stepper = stepper});
  double error = 0.0, way = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Vec<D> exact = s.exact(run.times()[i]);
    error = larger(error, (run.position(s.particle, i) - exact).norm());
    way = std::max(way, exact.cwiseAbs().maxCoeff());
  }
  return {.error = error / way, .statistics = run.statistics()};
}

/// None of these motions amplifies errors (the heading of the knife edge turns evenly, which every step gets
/// right), and a coordinate is allowed the error of the way and of how far it has come: twice that of the way
/// at the end.
template <int D>
Case free(const char* name, Lone<D> (*start)(double)) {
  return {
      .name = name,
      .parameter = "speed at the start [m/s]",
      .sweep = {0.0, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0},
      .brief = {0.0, 1e-6},
      .run = [start](double speed, Stepper stepper) { return compared_alone(start(speed), stepper); },
      .limit = [](const Run& run) { return 2.0 * added_up(run, tolerance, t_end / run.statistics.time); }};
}

}  // namespace

std::vector<Case> paths() {
  return {free("free-cusp", cycloid), free("free-drag", dragged), free("free-block", block),
          free("free-edge", knife_edge)};
}

}  // namespace dalembert::extremes
