#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/minimal_ode.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>
#include <numbers>

namespace dalembert::extremes {

namespace {

using models::Real;
using models::State;

constexpr double pi = std::numbers::pi;
const double omega0 = std::sqrt(9.81);

/// A pendulum of 1 m upside down, 0.01 rad from upright, its pivot shaken at N omega0 with A^2 omega^2 = b g
/// l, over 1,000 periods of the drive.
struct Kapitza {
  double ratio;     ///< N
  double strength;  ///< b: upright is stable above 2

  [[nodiscard]] models::DrivenPivot pendulum() const {
    auto p = models::DrivenPivot::vertical(std::sqrt(strength * 9.81) / (ratio * omega0));
    p.frequency = ratio * omega0;
    p.angle = pi - start;
    return p;
  }
  /// While the exact motion is within 0.5 rad of upright: then it has fallen, and tumbles chaotically. Wrong,
  /// and infinitely so, is a run that stays up, or falls, where the exact one does not.
  [[nodiscard]] Run compared(Stepper stepper) const {
    const models::DrivenPivot p = pendulum();
    const Options options{.t_end = 1000.0 * 2.0 * pi / p.frequency,
                          .samples = 1001,
                          .tolerance = tolerance,
                          .stepper = stepper,
                          .max_steps = 3'000'000};
    const auto exact = p.reference(sample_times(options));
    const models::DrivenPendulum built = p.scene();
    const Trajectory<2> run = simulate(built.scene, options);
    double error = 0.0;
    bool falls = false, fell = false, falling = false;
    for (std::size_t i = 0; i < run.size(); ++i) {
      const Vec<2> seen = run.position(built.bob, i), right = exact[i].positions[0];
      falling = falling || std::abs(right.x()) > std::sin(0.5);
      if (!falling) error = larger(error, (seen - right).norm());
      falls = falls || right.y() < 0.0;
      fell = fell || seen.y() < 0.0;
    }
    return {.error = falls == fell ? error : infinite, .statistics = run.statistics()};
  }
  static constexpr double start = 0.01, tolerance = 1e-8;
};

/// The motion about upright grows, if at all, from 0.01 to 0.5 before it is no longer compared, and errors
/// with it: at the rate omega0 sqrt(1 - b/2), in the time 4.6 (1 - b/2)^(-1/2)/omega0, that part of the 1,000
/// drive periods. The scene's own time is that of the drive's acceleration, sqrt(l/(A omega^2)), so that
/// those have 2,000 pi sqrt(A/l) of them.
Case kapitza(const char* name, double strength) {
  return {.name = name,
          .parameter = "drive frequency over the pendulum's, " +
                       std::string(strength > 2.0 ? "above" : "below") + " the boundary of stability",
          .sweep = {1e1, 1e2, 1e3, 1e4},
          .brief = {1e2},
          .run =
              [strength](double ratio, Stepper stepper) {
                return Kapitza{ratio, strength}.compared(stepper);
              },
          .limit =
              [strength](const Run& run) {
                const double amplitude = Kapitza{run.parameter, strength}.pendulum().amplitude_y;
                const double own_times = 2000.0 * pi * std::sqrt(amplitude);
                if (strength > 2.0) return added_up(run, Kapitza::tolerance, own_times);
                const double grown = 0.5 / Kapitza::start, fall = std::log(2.0 * grown);
                const double radians = 2000.0 * pi / run.parameter;  // omega0 t
                const double part = std::min(1.0, fall / std::sqrt(1.0 - 0.5 * strength) / radians);
                return grown * part * added_up(run, Kapitza::tolerance, part * own_times);
              }};
}

/// A pendulum of 1 m pushed along x by a force +F, -F, ... of half its weight that changes every
/// `half_period`, and a pivot that from a time on moves along x with a constant speed.
struct Switched {
  double half_period;
  [[nodiscard]] Run compared(const Options& options) const {
    Scene<2> scene("switched");
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    const auto bob = scene.add_particle({.mass = 1.0, .position = {0.0, -1.0}}, "bob");
    scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
    scene.add(force_law(points(bob),
                        [half = half_period](const auto& t, const auto& r, const auto& /*v*/) {
                          using S = std::remove_cvref_t<decltype(r.x())>;
                          using std::sin;
                          const bool ahead = sin(pi / half * t) > 0.0;
                          return vec(S(ahead ? push : -push), S(0.0));
                        }),
              "switch");
    const Trajectory<2> run = simulate(scene, options);
    // Sampled at the switching times, between which the force is constant.
    State y{0, 0};
    double error = 0.0;
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const Real force = i % 2 == 0 ? push : -push;
      const double duration[] = {run.times()[i + 1] - run.times()[i]};
      models::integrate(
          [force](const State& s, State& rate) {
            rate = {s[1], -Real(9.81) * std::sin(s[0]) + force * std::cos(s[0])};
          },
          y, duration, [&](const State& end) { y = end; });
      const VecOf<Real, 2> exact = vec(std::sin(y[0]), -std::cos(y[0]));
      error = larger(error, (run.position(bob, i + 1) - exact.cast<double>()).norm());
    }
    return {.error = error, .statistics = run.statistics()};
  }
  static constexpr double push = 0.5 * 9.81;
};

Case discontinuous_force() {
  constexpr double tolerance = 1e-8, t_end = 8.0;
  return {.name = "discontinuous-force",
          .parameter = "switches of a pushing force in 8 s",
          .sweep = {8.0, 64.0, 512.0},
          .brief = {8.0, 64.0},
          .run =
              [](double switches, Stepper stepper) {
                return Switched{t_end / switches}.compared({.t_end = t_end,
                                                            .samples = static_cast<int>(switches) + 1,
                                                            .tolerance = tolerance,
                                                            .stepper = stepper});
              },
          .limit = [](const Run& run) { return added_up(run, tolerance, t_end * omega0); }};
}

/// At t = 1 the pivot of a pendulum at rest at 1 rad takes off along x at the speed u. The rod passes on the
/// part of that along itself: the bob's velocity relative to the pivot is then -u across the rod, times
/// cos(angle). Before and after, it is a free pendulum. An impulse is beyond an equation of motion: to say
/// where it is and stop is right too, and then the error is that of the time.
Run jolted(double u, const Options& options) {
  Scene<2> scene("jolted");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 1.0, .position = {std::sin(1.0), -std::cos(1.0)}}, "bob");
  const auto pivot = driven([u](const auto& t) {
    using S = std::remove_cvref_t<decltype(t)>;
    return vec(t > 1.0 ? S(u * (t - 1.0)) : S(0.0), S(0.0));
  });
  scene.add(Distance{pivot, bob, 1.0}, "rod");
  const auto free = [](const State& s, State& rate) { rate = {s[1], -Real(9.81) * std::sin(s[0])}; };
  State y{1, 0};
  const double until[] = {1.0};
  models::integrate(free, y, until, [&](const State& s) { y = s; });
  y[1] -= u * std::cos(y[0]);
  try {
    const Trajectory<2> run = simulate(scene, options);
    const double after[] = {options.t_end - 1.0};
    models::integrate(free, y, after, [&](const State& s) { y = s; });
    const Vec<2> exact(u * after[0] + static_cast<double>(std::sin(y[0])),
                       -static_cast<double>(std::cos(y[0])));
    return {.error = (run.position(bob, run.size() - 1) - exact).norm(), .statistics = run.statistics()};
  } catch (const IntegrationFailure& failure) {
    return ended_by(failure, std::abs(failure.time() - 1.0));
  }
}

Case jolted_pivot() {
  constexpr double tolerance = 1e-8, t_end = 2.0;
  return {
      .name = "jolted-pivot",
      .parameter = "speed that a pivot takes on in an instant [m/s]",
      .sweep = {1e-3, 1e-1, 1.0, 10.0},
      .brief = {1.0},
      .run =
          [](double u, Stepper stepper) {
            return jolted(u, {.t_end = t_end, .samples = 11, .tolerance = tolerance, .stepper = stepper});
          },
      .limit =
          [](const Run& run) { return added_up(run, tolerance, t_end * std::max(omega0, run.parameter)); }};
}

}  // namespace

std::vector<Case> driving() {
  return {kapitza("kapitza-stable", 4.0), kapitza("kapitza-unstable", 1.0), discontinuous_force(),
          jolted_pivot()};
}

}  // namespace dalembert::extremes
