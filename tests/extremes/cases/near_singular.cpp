#include <dalembert/models/cone.h>
#include <dalembert/models/minimal_ode.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dalembert::extremes {

namespace {

using models::Observation;
using models::Real;
using models::State;

/// A pendulum of 1 m released at rest at the angle d from upright. With u from upright u'' = omega0^2 sin u:
/// while u < 1e-4, u = d cosh(omega0 t) to 1e-9 of itself; from there on in extended precision.
std::vector<Vec<2>> falling(double d, std::span<const double> times) {
  const Real omega0 = std::sqrt(Real(9.81)), u1 = std::max(Real(1e-4), Real(d));
  const Real t1 = std::acosh(u1 / d) / omega0;
  std::vector<Vec<2>> seen;
  std::vector<double> later;
  for (const double t : times) {
    if (t >= t1) later.push_back(static_cast<double>(t - t1));
    const Real u = d * std::cosh(omega0 * t);
    if (t < t1) seen.emplace_back(static_cast<double>(std::sin(u)), static_cast<double>(std::cos(u)));
  }
  const auto equations = [=](const State& y, State& rate) {
    rate = {y[1], omega0 * omega0 * std::sin(y[0])};
  };
  models::integrate(
      equations, State{u1, omega0 * std::sqrt(u1 * u1 - Real(d) * d)}, later, [&](const State& y) {
        seen.emplace_back(static_cast<double>(std::sin(y[0])), static_cast<double>(std::cos(y[0])));
      });
  return seen;
}

/// Until it has come down on the other side: ln(2 pi/d) own times to fall and two more. An error e made early
/// counts e/d times when it falls, at the speed 2 length/T; tolerances go down to 1e-13 with d, and the steps
/// that count are those in the time of one growth by e, of which there are at most 100.
Case upright() {
  const auto tolerance = [](double d) { return std::clamp(1e-3 * d, 1e-13, 1e-8); };
  return {
      .name = "upright",
      .parameter = "angle from upright at which a pendulum is let go [rad]",
      .sweep = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12},
      .brief = {1e-4, 1e-12},
      .run =
          [=](double d, Stepper stepper) {
            const double t_end = (std::log(2.0 * std::numbers::pi / d) + 2.0) / std::sqrt(9.81);
            const Options options{.t_end = t_end, .tolerance = tolerance(d), .stepper = stepper};
            Scene<2> scene("upright");
            scene.add(UniformGravity<2>{{0.0, -9.81}});
            const auto bob = scene.add_particle({.mass = 1.0, .position = {std::sin(d), std::cos(d)}}, "bob");
            scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
            const Trajectory<2> run = simulate(scene, options);
            const auto exact = falling(d, run.times());
            double error = 0.0;
            for (std::size_t i = 0; i < run.size(); ++i)
              error = larger(error, (run.position(bob, i) - exact[i]).norm());
            return Run{.error = error, .statistics = run.statistics()};
          },
      .limit =
          [=](const Run& run) {
            Run counted = run;
            counted.statistics.steps = std::min(counted.statistics.steps, 100L);
            return 2.0 / run.parameter * added_up(counted, tolerance(run.parameter), 2.0);
          }};
}

/// A pendulum that turns back at the angle d from upright: its period is (4/omega0) ln(8/d), and an error e
/// of its energy, in units of m g l, changes that by 2 e/(omega0 d^2). Energy errs as the velocities add up,
/// and over P periods the phase as the sum of those changes, P/2 times; the speed is at most 2 length/T.
Case close_to_the_separatrix() {
  constexpr double tolerance = 1e-10, periods = 20.0;
  return {.name = "separatrix",
          .parameter = "angle from upright at which a pendulum turns back, 20 periods [rad]",
          .sweep = {1e-1, 3e-2, 1e-2, 1e-3},
          .brief = {1e-1},
          .run =
              [](double d, Stepper stepper) {
                const models::PlanePendulum pendulum{.amplitude = std::numbers::pi - d};
                return compared_motion<2>(
                    pendulum.model(),
                    {.t_end = periods * pendulum.period(), .tolerance = tolerance, .stepper = stepper});
              },
          .limit =
              [](const Run& run) {
                return 2.0 * (periods / 2.0) * added_up(run, tolerance, 0.0) * 2.0 /
                       (run.parameter * run.parameter);
              }};
}

/// Down a cone once past its apex and up again, with the angular momentum h = r v of the start. The turn
/// there depends on h, so an error e of the velocity counts e/h times in direction; closest is
/// r = h/sqrt(2 g cot(a)) and so it does not more.
Case cone_apex() {
  constexpr double tolerance = 1e-10, t_end = 1.3;
  return {.name = "cone-apex",
          .parameter = "angular momentum at which a cone's apex is passed [m^2/s]",
          .sweep = {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6},
          .brief = {1e-1, 1e-6},
          .run =
              [](double h, Stepper stepper) {
                const models::ConeSlide slide{.speed_ratio = h / std::sqrt(9.81)};
                return compared_motion<3>(slide.model(),
                                          {.t_end = t_end, .tolerance = tolerance, .stepper = stepper});
              },
          .limit =
              [](const Run& run) {
                return added_up(run, tolerance, t_end / 0.3) * std::max(1.0, std::sqrt(9.81) / run.parameter);
              }};
}

/// Errors are relative to the length of the scene, which for a cone of half angle a is not r but r/sin(a).
Case cone_angle() {
  constexpr double tolerance = 1e-8, t_end = 10.0, degree = std::numbers::pi / 180.0;
  return {.name = "cone-angle",
          .parameter = "half angle of a cone [degrees]",
          .sweep = {0.1, 1.0, 30.0, 80.0, 89.0, 89.9},
          .brief = {0.1, 89.9},
          .run =
              [](double angle, Stepper stepper) {
                const models::ConeSlide slide{.half_angle = angle * degree};
                return compared_motion<3>(slide.model(),
                                          {.t_end = t_end, .tolerance = tolerance, .stepper = stepper});
              },
          .limit =
              [](const Run& run) {
                return added_up(run, tolerance, t_end / 0.3) / std::sin(run.parameter * degree);
              }};
}

/// A bead on y = sqrt(x^2 + b^2), two slopes that meet in an arc of curvature 1/b: with y' = x/y,
/// y'' = b^2/y^3,  (1 + y'^2) x'' + y' y'' x'^2 + g y' = 0. Let go at x = 1 it passes the arc five times in
/// 6 s. There an error of velocity is turned, not amplified; one of position is one of time. A lone bead's
/// scene is as long as its weight could carry it, g t^2; the tolerance of that is a tenth of the smallest
/// radius.
Case cusp() {
  constexpr double tolerance = 1e-10, t_end = 6.0;
  return {.name = "cusp",
          .parameter = "curvature at the bottom of a bead's curve [1/m]",
          .sweep = {1e1, 1e2, 1e3, 1e4, 1e5, 1e6},
          .brief = {1e2, 1e6},
          .run =
              [](double curvature, Stepper stepper) {
                const double b = 1.0 / curvature;
                Scene<2> scene("cusp");
                scene.add(UniformGravity<2>{{0.0, -9.81}});
                const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, std::hypot(1.0, b)}});
                scene.add(OnCurve{bead, [b](auto r) {
                                    using std::sqrt;
                                    return r.y() - sqrt(r.x() * r.x() + b * b);
                                  }});
                const Trajectory<2> run =
                    simulate(scene, {.t_end = t_end, .tolerance = tolerance, .stepper = stepper});
                const auto equations = [b = Real(b)](const State& s, State& rate) {
                  const Real y = std::hypot(s[0], b), slope = s[0] / y, bend = b * b / (y * y * y);
                  rate = {s[1], -slope * (bend * s[1] * s[1] + Real(9.81)) / (1 + slope * slope)};
                };
                double error = 0.0;
                std::size_t i = 0;
                models::integrate(equations, State{1, 0}, run.times(), [&](const State& s) {
                  const VecOf<Real, 2> exact = vec(s[0], std::hypot(s[0], Real(b)));
                  error = larger(error, (run.position(bead, i++) - exact.cast<double>()).norm());
                });
                return Run{.error = error, .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return 9.81 * t_end * t_end * added_up(run, tolerance, 1.0); }};
}

}  // namespace

std::vector<Case> near_singular() {
  return {upright(), close_to_the_separatrix(), cone_apex(), cone_angle(), cusp()};
}

}  // namespace dalembert::extremes
