#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace dalembert::extremes {

namespace {

/// How far a failure's time is from the one that is due, of that; infinite if it does not name the culprit.
double off(const IntegrationFailure& failure, double due, std::string_view culprit) {
  const bool named = std::string_view(failure.what()).find(culprit) != std::string_view::npos;
  return named ? std::abs(failure.time() / due - 1.0) : infinite;
}

/// u = (v/R)^2 over the angle th from the top of a rough hoop, from u0 at th = 0. Where the hoop bears the
/// bead, u < (g/R) cos th, then where it pulls it in,
///
///   u' = 2 (g/R) sin th -+ 2 mu ((g/R) cos th - u)
///
/// with mu and then -mu for k: u = (g/R) (b cos th + c sin th) + C exp(2 k th), c = -6 k/(1 + 4 k^2),
/// b = (4 k^2 - 2)/(1 + 4 k^2).
double square_of_rate(double angle, double mu, double w, double u0) {
  const auto particular = [=](double k, double th) {
    return w * ((4.0 * k * k - 2.0) * std::cos(th) - 6.0 * k * std::sin(th)) / (1.0 + 4.0 * k * k);
  };
  const auto on = [&](double k, double from, double u, double th) {
    return particular(k, th) + (u - particular(k, from)) * std::exp(2.0 * k * (th - from));
  };
  double borne = 0.0, pulled = 0.5 * std::numbers::pi;  // bracket the angle where the force changes its sign
  while (pulled - borne > 1e-16) {
    const double th = 0.5 * (borne + pulled);
    if (th == borne || th == pulled) break;
    (on(mu, 0.0, u0, th) < w * std::cos(th) ? borne : pulled) = th;
  }
  if (angle <= borne) return on(mu, 0.0, u0, angle);
  return on(-mu, borne, w * std::cos(borne), angle);
}

/// A bead slides down a rough hoop from its top, friction mu |N|, through where the hoop's force changes its
/// sign. An error e of position is one of u' e in u, u' <= 2 (1 + mu) g/R + 2 mu u, and one of velocity, e
/// times sqrt(g R), one of 2 v sqrt(g R)/R^2 e. With u <= 20/s^2 both together are 60 times e.
constexpr double mu = 0.2, R = 1.0, rate = 1.0;

Case kink() {
  return {.name = "kink",
          .parameter = "tolerance, of a bead on a rough hoop whose friction takes |N|",
          .sweep = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12},
          .brief = {1e-5, 1e-6, 1e-7, 1e-10},
          .run =
              [](double tolerance, Stepper stepper) {
                Scene<2> scene("kink");
                scene.add(UniformGravity<2>{{0.0, -g}});
                const auto bead = scene.add_particle(
                    {.mass = 1.0, .position = {0.0, R}, .velocity = {R * rate, 0.0}}, "bead");
                const auto hoop = scene.add(OnCurve{bead, Sphere<2>{{0.0, 0.0}, R}}, "hoop");
                scene.add(
                    friction_law(hoop, points(bead),
                                 [](auto N, auto, auto v) { return (-mu * abs(N) * v.normalized()).eval(); }),
                    "rough");
                const Trajectory<2> run =
                    simulate(scene, {.t_end = 1.0, .tolerance = tolerance, .stepper = stepper});
                double error = 0.0;
                for (std::size_t i = 0; i < run.size(); ++i) {
                  const Vec<2> r = run.position(bead, i);
                  const double u = run.velocity(bead, i).squaredNorm() / (R * R);
                  error = larger(
                      error, std::abs(u - square_of_rate(std::atan2(r.x(), r.y()), mu, g / R, rate * rate)));
                }
                return Run{.error = error, .statistics = run.statistics()};
              },
          .limit = [](const Run& run) { return 60.0 * added_up(run, run.parameter, 0.0) + 1e3 * epsilon; }};
}

/// A force that a particle feels from one instant on: its velocity grows by the time left, its position by
/// half the square of that. With nothing else in the scene errors add up and are carried on.
Case jump() {
  constexpr double tolerance = 1e-8, t_end = 1.0;
  return {.name = "jump",
          .parameter = "instant from which a force acts",
          .sweep = {0.01, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99},
          .brief = {0.3, 0.7},
          .run =
              [](double begin, Stepper stepper) {
                Scene<2> scene("jump");
                const auto body = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}}, "body");
                scene.add(force_law(points(body),
                                    [begin](const auto& t, const auto& r, const auto& /*v*/) {
                                      auto force = (0.0 * r).eval();
                                      if (t >= begin) force[0] += 1.0;
                                      return force;
                                    }),
                          "wind");
                const Trajectory<2> run =
                    simulate(scene, {.t_end = t_end, .tolerance = tolerance, .stepper = stepper});
                double error = 0.0;
                for (std::size_t i = 0; i < run.size(); ++i) {
                  const double t = run.times()[i], blown = std::max(0.0, t - begin);
                  error = larger(error, std::abs(run.position(body, i).x() - (t + 0.5 * blown * blown)));
                }
                return Run{.error = error, .statistics = run.statistics()};
              },
          // The length and time of a lone particle with a speed and no force are those of the run.
          .limit = [](const Run& run) { return added_up(run, tolerance, 2.0); }};
}

/// A bead on y = |x|, let go at (1, 1): at a = g/2 each way it is in the corner at sqrt(4/g). There the
/// gradient jumps, and what an impact does no equation says. The steps' errors of position, over the speed
/// there, g t/2 each way, are one of time; the scene is no longer than g t^2.
Case corner_of_a_path() {
  const double due = std::sqrt(4.0 / g);
  return {.name = "corner",
          .parameter = "tolerance, of a bead that slides into the corner of y = |x|",
          .sweep = {1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12},
          .brief = {1e-3, 1e-6, 1e-10},
          .run =
              [due](double tolerance, Stepper stepper) {
                Scene<2> scene("corner");
                scene.add(UniformGravity<2>{{0.0, -g}});
                const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 1.0}}, "bead");
                scene.add(OnCurve{bead, [](auto r) { return r.y() - abs(r.x()); }}, "vee");
                const Options options{
                    .t_end = 2.0, .tolerance = tolerance, .stepper = stepper, .max_steps = 100'000};
                return stopped<2>(scene, options, [&](const IntegrationFailure& f) {
                  return off(f, due, "OnCurve \"vee\"");
                });
              },
          .limit = [](const Run& run) { return 2.0 * added_up(run, run.parameter, 1.0) + 100.0 * epsilon; },
          .steppers = {Stepper::erk}};
}

/// A block pushed up a rough slope at 2 m/s is slowed down by g (sin(alpha) + mu cos(alpha)). Where
/// mu < tan(alpha) it turns back, else it sticks, and no law of sliding says what holds it. What is compared,
/// the position in metres or the time when it stops as a part of that, keeps to the catalogue's bound.
constexpr double alpha = 0.5, push = 2.0;

Case stick() {
  constexpr double tolerance = 1e-8;
  return {
      .name = "stick",
      .parameter = "coefficient of Coulomb's friction under a block pushed up a slope of 0.5 rad",
      .sweep = {0.0, 0.1, 0.3, 0.5, 0.54, 0.55, 0.7, 1.0, 3.0},
      .brief = {0.3, 0.7},
      .run =
          [](double friction, Stepper stepper) {
            constexpr double tolerance = 1e-8, t_end = 1.0;
            Scene<3> scene("stick");
            scene.add(UniformGravity<3>{{g * std::sin(alpha), 0.0, -g * std::cos(alpha)}});
            const auto block = scene.add_particle({.mass = 2.0, .velocity = {-push, 0.0, 0.0}}, "block");
            const auto table = scene.add(OnSurface{block, Plane<3>{}}, "table");
            scene.add(friction_law(table, points(block),
                                   [friction](auto N, auto, auto v) {
                                     return (-friction * abs(N) * v.normalized()).eval();
                                   }),
                      "rub");
            const double up = g * (std::sin(alpha) + friction * std::cos(alpha));
            const double down = g * (std::sin(alpha) - friction * std::cos(alpha)), turns = push / up;
            const Options options{
                .t_end = t_end, .tolerance = tolerance, .stepper = stepper, .max_steps = 100'000};
            if (friction > std::tan(alpha)) {
              return stopped<3>(scene, options, [&](const IntegrationFailure& f) {
                const bool said = std::string_view(f.what()).find("would stick") != std::string_view::npos;
                return said ? off(f, turns, "FrictionLaw \"rub\"") : infinite;
              });
            }
            const Trajectory<3> run = simulate(scene, options);
            double error = 0.0;
            for (std::size_t i = 0; i < run.size(); ++i) {
              const double t = run.times()[i], back = std::max(0.0, t - turns), first = std::min(t, turns);
              const double x = (-push + 0.5 * up * first) * first + 0.5 * down * back * back;
              error = larger(error, std::abs(run.position(block, i).x() - x));
            }
            return Run{.error = error, .statistics = run.statistics()};
          },
      // A part of the time to stop is a part of the push: speeds err by as much.
      .limit = [](const Run&) { return 1e3 * tolerance; }};
}

}  // namespace

std::vector<Case> discontinuities() { return {kink(), jump(), corner_of_a_path(), stick()}; }

}  // namespace dalembert::extremes
