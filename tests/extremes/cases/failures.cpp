#include <dalembert/models/plane_pendulum.h>
#include <dalembert/models/pursuit.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace dalembert::extremes {

namespace {

bool says(const IntegrationFailure& failure, std::string_view word) {
  return std::string_view(failure.what()).find(word) != std::string_view::npos;
}

/// Relative distance of a failure's time from the one that is due; infinite if it does not name what is at
/// fault or lost a sample before it.
double off(const IntegrationFailure& failure, double due, std::string_view culprit, double sample_interval) {
  const auto run = failure.trajectory<2>();
  const bool kept = run.size() > 0 && failure.time() - run.times().back() <= sample_interval * (1.0 + 1e-9);
  return says(failure, culprit) && kept ? std::abs(failure.time() / due - 1.0) : infinite;
}

Options sampled(double t_end, double tolerance, Stepper stepper) {
  return {.t_end = t_end, .samples = 101, .tolerance = tolerance, .stepper = stepper, .max_steps = 1'000'000};
}

/// A step before the fault, of which the run up to it takes S: a stepper cannot do better, and halves its
/// steps to come closer. Ten of its mean steps.
double within_ten_steps(const Run& run) {
  return 10.0 / static_cast<double>(std::max(1L, run.statistics.steps));
}

/// Where the direction to the prey is lost in the error of position, 1000 tolerance h by the catalogue's
/// bound, the pursuer is that over v - u before its capture, which is h v/(v^2 - u^2): a part of 1000
/// tolerance (v + u)/v.
Case capture() {
  constexpr double tolerance = 1e-6;
  return {.name = "capture",
          .parameter = "speed of a pursuer over its prey's, run beyond capture",
          .sweep = {1.1, 1.5, 2.0, 3.0, 10.0},
          .brief = {1.5, 3.0, 10.0},
          .run =
              [](double ratio, Stepper stepper) {
                const models::PursuitCurve chase{.pursuer_speed = ratio};
                const double due = chase.capture_time();
                const Options options = sampled(1.5 * due, tolerance, stepper);
                return stopped<2>(chase.scene().scene, options, [&](const IntegrationFailure& failure) {
                  return off(failure, due, "Pursuit", 1.5 * due / 100.0);
                });
              },
          .limit =
              [](const Run& run) {
                return std::max(1e3 * tolerance * (1.0 + 1.0 / run.parameter), within_ten_steps(run));
              }};
}

/// Two rods of 1 m, the far end drawn away at the speed u from 1 m: straight at the time 1/u. They straighten
/// like the square root of the time left, faster than any step.
Case out_of_reach() {
  return {
      .name = "out-of-reach",
      .parameter = "speed of a point that draws two rods apart [m/s]",
      .sweep = {0.1, 1.0, 10.0},
      .brief = {1.0},
      .run =
          [](double u, Stepper stepper) {
            Scene<2> scene("out-of-reach");
            const Vec<2> start(0.5, std::sqrt(0.75));
            // On both rods: across the first one, and so that the second keeps its length.
            const Vec<2> across = Vec<2>(start.y(), -start.x()), second = start - Vec<2>(1.0, 0.0);
            const double rate = -u * second.x() / -second.dot(across);
            const auto joint =
                scene.add_particle({.mass = 1.0, .position = start, .velocity = rate * across}, "joint");
            scene.add(Distance{Fixed<2>{}, joint, 1.0}, "near rod");
            scene.add(Distance{joint, driven([u](auto t) { return vec(1.0 + u * t, 0.0); }), 1.0}, "far rod");
            return stopped<2>(scene, sampled(2.0 / u, 1e-6, stepper), [&](const IntegrationFailure& failure) {
              return off(failure, 1.0 / u, "rod\"", 0.02 / u);
            });
          },
      .limit = within_ten_steps};
}

Case no_number() {
  return {.name = "no-number",
          .parameter = "time after which a user's force is NaN [s]",
          .sweep = {0.5, 5.0},
          .brief = {0.5, 5.0},
          .run =
              [](double end, Stepper stepper) {
                models::HangingRods built = models::PlanePendulum{}.scene();
                built.scene.add(force_law(points(built.beads[0]),
                                          [end](const auto& t, const auto&, const auto& v) {
                                            constexpr double nan = std::numeric_limits<double>::quiet_NaN();
                                            return ((t > end ? nan : -0.1) * v).eval();
                                          }),
                                "wind");
                return stopped<2>(built.scene, sampled(2.0 * end, 1e-8, stepper),
                                  [&](const IntegrationFailure& failure) {
                                    return off(failure, end, "\"wind\"", 0.02 * end);
                                  });
              },
          .limit = within_ten_steps};
}

/// A particle falls from 1 m into a centre that attracts it with 1/r^2: it arrives at the time pi/(2 sqrt 2),
/// its force beyond all bounds, with steps that shrink to nothing. To stop is right wherever the fall that is
/// left is shorter than errors of position add up to: at r, (sqrt 2/3) r^(3/2).
Case collision() {
  return {
      .name = "collision",
      .parameter = "tolerance at which a particle falls into a centre of force",
      .sweep = {1e-4, 1e-6, 1e-8, 1e-10},
      .brief = {1e-4, 1e-8},
      .run =
          [](double tolerance, Stepper stepper) {
            Scene<2> scene("collision");
            const auto falling = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
            scene.add(potential(points(Fixed<2>{}, falling),
                                [](const auto& centre, const auto& r) { return -1.0 / (r - centre).norm(); }),
                      "sun");
            const double due = std::numbers::pi / (2.0 * std::numbers::sqrt2);
            return stopped<2>(scene, sampled(2.0, tolerance, stepper),
                              [&](const IntegrationFailure& failure) { return off(failure, due, "", 0.02); });
          },
      .limit = [](const Run& run) { return 1e3 * run.parameter; }};
}

/// A block slides at 1 m/s against friction mu m g, written as a force against the velocity: it stops at
/// v^2/(2 mu g) and from then on the force chatters, with no step that resolves it. To give up then is right,
/// and so is to come through: the block is where it stopped, by the last sample kept.
Case chatter() {
  constexpr double tolerance = 1e-6;
  return {.name = "chatter",
          .parameter = "coefficient of friction written as a force against the velocity",
          .sweep = {0.1, 0.5, 1.0},
          .brief = {0.5},
          .run =
              [](double mu, Stepper stepper) {
                Scene<2> scene("chatter");
                const auto block = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}}, "block");
                scene.add(OnCurve{block, Plane<2>{}}, "table");
                scene.add(force_law(points(block),
                                    [mu](const auto&, const auto& v) {
                                      using S = std::remove_cvref_t<decltype(v.x())>;
                                      return vec(v.x() > 0.0 ? S(-mu * 9.81) : S(mu * 9.81), S(0.0));
                                    }),
                          "friction");
                const double due = 1.0 / (mu * 9.81), distance = 0.5 * due;
                Options options = sampled(2.0 * due, tolerance, stepper);
                options.max_steps = 100'000;
                const auto stands = [&](const Trajectory<2>& run) {
                  return std::abs(run.position(block, run.size() - 1).x() / distance - 1.0);
                };
                try {
                  const Trajectory<2> run = simulate(scene, options);
                  return Run{.error = stands(run), .statistics = run.statistics()};
                } catch (const IntegrationFailure& failure) {
                  const auto run = failure.trajectory<2>();
                  return ended_by(failure, run.size() > 0 ? stands(run) : infinite);
                }
              },
          // The catalogue's bound, or what the block still slides in the last sample interval, a fiftieth of
          // the time and so (1/50)^2 of the way.
          .limit = [](const Run&) { return std::max(1e3 * tolerance, 1.0 / (50.0 * 50.0)); }};
}

/// It stops after exactly this many steps, and what it kept is what a longer run has.
Case step_limit() {
  return {.name = "step-limit",
          .parameter = "max_steps",
          .sweep = {1.0, 10.0, 100.0},
          .brief = {1.0, 10.0},
          .run =
              [](double most, Stepper stepper) {
                const models::HangingRods built = models::PlanePendulum{}.scene();
                Options options = sampled(1e3, 1e-8, stepper);
                options.sample_interval = 0.1;
                const Trajectory<2> whole = [&] {
                  Options shorter = options;
                  shorter.t_end = 30.0;
                  return simulate(built.scene, shorter);
                }();
                options.max_steps = static_cast<long>(most);
                return stopped<2>(built.scene, options, [&](const IntegrationFailure& failure) {
                  const auto run = failure.trajectory<2>();
                  bool same = says(failure, "max_steps") && run.size() > 0;
                  for (std::size_t i = 0; i < std::min(run.size(), whole.size()); ++i)
                    same = same && run.position(built.beads[0], i) == whole.position(built.beads[0], i);
                  return same ? std::abs(static_cast<double>(run.statistics().steps) / most - 1.0) : infinite;
                });
              },
          .limit = [](const Run&) { return 0.0; }};
}

}  // namespace

std::vector<Case> failures() {
  return {capture(), out_of_reach(), no_number(), collision(), chatter(), step_limit()};
}

}  // namespace dalembert::extremes
