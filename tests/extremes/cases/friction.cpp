#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>

namespace dalembert::extremes {

namespace {

/// At the edge of the cone. A run errs by some tens of its tolerance (models/event_times.h).
constexpr double error_bound = 100.0 * tolerance;
/// The relative accuracy to which a bound is known, of the forces on either side (DryFriction).
constexpr double told = 1e4 * epsilon;

/// A block of mass 1 on a level table that a force pulls along x.
struct Pulled {
  Scene<2> scene{"pulled"};
  Particle<2> block;
  Constraint<1> rough;

  Pulled(double mu, double mu_static, auto force) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    block = scene.add_particle({.mass = 1.0}, "block");
    const auto table = scene.add(OnCurve{block, Plane<2>{}}, "table");
    rough = scene.add(coulomb(table, Slip{block, Plane<2>{}}, mu, mu_static), "rough");
    scene.add(force_law(points(block), [force](auto t, auto, auto) { return vec(force(t), 0.0 * t); }));
  }
};

/// When it went, and how far off that is; infinite if it did when it must not, or the other way round.
Run went(const Pulled& pulled, const Options& options, bool goes, double due) {
  const Trajectory<2> run = simulate(pulled.scene, options);
  Run result{.error = infinite, .statistics = run.statistics()};
  if (goes && !run.events().empty() && run.events()[0].kind == EventKind::slides)
    result.error = std::abs(run.events()[0].time - due);
  if (!goes && run.events().empty()) result.error = run.velocity(pulled.block, run.size() - 1).norm();
  return result;
}

/// The pull F = mu_static N (1 + e - (t - 1)^2) exceeds its bound by e between 1 -+ sqrt e, and touches it in
/// a double root for e = 0. Told to d = told/mu_static of it, it goes where F exceeds the bound by that, at 1
/// - sqrt(e - d), if it ever does. The state at rest does not err.
constexpr double held = 0.3;  // mu_static

Case tangent() {
  return {.name = "tangent-cone",
          .parameter = "by how much of it a pull exceeds what friction holds, at its turning point",
          .sweep = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 0.0, -1e-12,
                    -1e-6, -1e-2},
          .brief = {1e-1, 1e-6, 1e-11, 1e-12, 0.0, -1e-12},
          .run =
              [](double e, Stepper stepper) {
                const Pulled pulled(0.2, held,
                                    [e](auto t) { return held * g * (1.0 + e - (t - 1.0) * (t - 1.0)); });
                return went(pulled, {.t_end = 2.0, .tolerance = tolerance, .stepper = stepper},
                            e > told / held, 1.0 - std::sqrt(std::max(0.0, e)));
              },
          .limit =
              [](const Run& run) {
                const double e = run.parameter, least = told / held;
                if (e <= least) return error_bound;
                return std::sqrt(e) - std::sqrt(e - least) + 10.0 * least;  // and of the root itself
              }};
}

/// On a slope of tan alpha = mu_static (1 + e), from rest: beyond the edge of the cone it slides down by
/// s = (g sin alpha - mu g cos alpha) t^2/2, on it and within it stays. With mu < mu_static that is a jump in
/// e, and an e below `told` does not count.
Case slope() {
  return {.name = "slope-at-cone",
          .parameter = "by how much of it the slope exceeds the static coefficient",
          .sweep = {1e-1, 1e-3, 1e-6, 1e-9, 1e-11, 1e-12, 0.0, -1e-12, -1e-9, -1e-6, -1e-3, -1e-1},
          .brief = {1e-1, 1e-11, 1e-12, 0.0, -1e-12},
          .run =
              [](double e, Stepper stepper) {
                constexpr double mu = 0.3, mu_static = 0.4, t_end = 1.0;
                const double alpha = std::atan(mu_static * (1.0 + e));
                const Vec<2> down(std::cos(alpha), -std::sin(alpha)), up(std::sin(alpha), std::cos(alpha));
                Scene<2> scene("slope-at-cone");
                scene.add(UniformGravity<2>{{0.0, -g}});
                const auto block = scene.add_particle({.mass = 1.0}, "block");
                const Plane<2> plane{{0.0, 0.0}, up};
                const auto floor = scene.add(OnCurve{block, plane}, "floor");
                scene.add(coulomb(floor, Slip{block, plane}, mu, mu_static), "rough");
                const Trajectory<2> run =
                    simulate(scene, {.t_end = t_end, .tolerance = tolerance, .stepper = stepper});
                const double a = e > told ? g * (std::sin(alpha) - mu * std::cos(alpha)) : 0.0;
                double error = 0.0;
                for (std::size_t i = 0; i < run.size(); ++i) {
                  const double t = run.times()[i];
                  error = larger(error, std::abs(run.position(block, i).dot(down) - 0.5 * a * t * t));
                }
                return Run{.error = error, .statistics = run.statistics()};
              },
          .limit = [](const Run&) { return error_bound; }};
}

/// A pull that grows at the rate r, from below: it goes at mu_static N/r, however slow; what F is told to is
/// as much of that time.
Case slow() {
  return {.name = "slow-pull",
          .parameter = "rate at which a pull grows up to what friction holds [N/s]",
          .sweep = {1e3, 1e2, 1e1, 1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6},
          .brief = {1e3, 1e0, 1e-4},
          .run =
              [](double rate, Stepper stepper) {
                const double due = held * g / rate;
                const Pulled pulled(0.2, held, [rate](auto t) { return rate * t; });
                Run result = went(pulled, {.t_end = 1.001 * due, .tolerance = tolerance, .stepper = stepper},
                                  true, due);
                result.error /= due;
                return result;
              },
          .limit = [](const Run&) { return 2.0 * told / held; }};
}

}  // namespace

std::vector<Case> sticking() { return {tangent(), slope(), slow()}; }

}  // namespace dalembert::extremes
