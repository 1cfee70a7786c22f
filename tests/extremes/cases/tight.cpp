#include <dalembert/models/catalogue.h>
#include <dalembert/models/four_bar.h>
#include <dalembert/models/minimal_ode.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dalembert::extremes {

namespace {

using models::Real;
using models::State;

/// When a four-bar's rods first lie in line: p' = sqrt(v^2/L^2 + 2 W^2 (1 - cos p)) from 0 to pi/2.
double time_in_line(const models::FourBar& f) {
  const Real square = Real(f.gravity) / f.length * 3 * (3 * f.loops + 1) / (2 * (4 * f.loops + 1));
  const auto slowness = [&](const State& y, State& rate) {
    rate = {
        1 / std::sqrt(Real(f.speed) * f.speed / (f.length * f.length) + 2 * square * (1 - std::cos(y[1]))),
        1};
  };
  double t = 0.0;
  models::integrate(slowness, State{0, 0}, std::vector{std::numbers::pi / 2.0},
                    [&t](const State& y) { t = static_cast<double>(y[0]); });
  return t;
}

/// Samples closer and closer to the position in which the constraints are dependent. Positions and velocities
/// are right everywhere; forces are, or cannot be read: to the root of the tolerance, which is what a force
/// that can be read is held to.
Case sample_at_singular() {
  const models::FourBar linkage{};
  return {.name = "sample-at-singular",
          .parameter = "tolerance, a four-bar sampled from 1e-2 to 1e-7 s about its singular position",
          .sweep = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12},
          .brief = {1e-6, 1e-10},
          .run =
              [linkage](double tolerance, Stepper stepper) {
                const double singular = time_in_line(linkage);
                std::vector<double> times;
                for (const double d :
                     {-1e-2, -1e-3, -1e-4, -1e-5, -1e-6, -1e-7, 0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2})
                  times.push_back(singular + d);
                const auto exact = linkage.reference(times);
                const models::FourBarScene built = linkage.scene();
                const auto run = simulate(
                    built.scene, {.t_end = 2.0, .times = times, .tolerance = tolerance, .stepper = stepper});
                const double weight = linkage.mass * linkage.gravity * (2.0 * linkage.loops + 1.0);
                double error = 0.0;
                for (std::size_t i = 0; i < run.size(); ++i) {
                  const auto joint = built.uprights[0].end();
                  const Vec<2> p = run.position(joint, i), across(p.y(), -p.x());
                  const double rate = std::sqrt(1.0 + 2.0 * 9.81 * 3.0 * (3 * linkage.loops + 1) /
                                                          (2.0 * (4 * linkage.loops + 1)) *
                                                          (1.0 - exact[i].positions[0].y()));
                  error = larger(error, (p - exact[i].positions[0]).norm());
                  error = larger(error, (run.velocity(joint, i) - rate * across).norm() / rate);
                  Vec<2> ground = Vec<2>::Zero();
                  bool readable = true;
                  for (const auto& pin : built.ground_pins) readable = readable && run.is_determined(pin, i);
                  for (const auto& pin : built.ground_pins)
                    if (readable) ground += run.multiplier(pin, i);
                  if (!readable) continue;
                  const Vec<2> due(exact[i].forces[0], exact[i].forces[1]);
                  error = larger(error, (ground - due).norm() / weight * std::sqrt(tolerance));
                }
                return Run{.error = error, .statistics = run.statistics()};
              },
          // The scene's own time is that of the joints over its 2 m, 0.2 s at the speed there.
          .limit =
              [](const Run& run) {
                return std::max(added_up(run, run.parameter, 0.7 / 0.2), 10.0 * run.statistics.accuracy);
              }};
}

/// How far the errors of a model rise above the best so far, over falling tolerances down to what double
/// precision holds. An error within the tolerance, or what the run says of its accuracy, is no rise above one
/// that happened to be much smaller.
template <int D>
Run rise(const models::Model<D>& model, Stepper stepper) {
  Run result{.error = 0.0};
  double best = infinite;
  for (const double tolerance : {1e-10, 1e-11, 1e-12, 1e-13}) {
    models::Measurement m;
    try {
      m = models::measure<D>(model, {.t_end = model.t_end, .tolerance = tolerance, .stepper = stepper});
    } catch (const IntegrationFailure& stop) {
      // A step of ida may err by a twentieth of that, 22 epsilon. Close to a singular position (four-bar,
      // sine 0.12) its state's round-off is more: to be told so is what is due.
      if (tolerance > 1e-13 ||
          std::string_view(stop.what()).find("more than double precision") == std::string_view::npos)
        throw;
      result.outcome = outcome_of(stop);
      break;
    }
    const double error = std::max(m.error_position, m.error_force);
    // Below this the rounding of sums over the steps decides.
    const double rounding = 10.0 * epsilon * static_cast<double>(m.statistics.steps);
    result.error =
        larger(result.error, error / std::max({best, rounding, 0.1 * tolerance, m.statistics.accuracy}));
    best = std::min(best, error);
    result.statistics = m.statistics;
  }
  return result;
}

/// Errors fall with the tolerance until round-off and then stay within ten times the best.
std::vector<Case> tight() {
  std::vector<Case> cases;
  for (const models::AnyModel& any : models::catalogue()) {
    std::visit(
        [&cases](const auto& model) {
          cases.push_back({.name = "tight-" + model.name,
                           .parameter = "least tolerance, from 1e-10",
                           .sweep = {1e-13},
                           .brief = {},
                           .run = [model](double, Stepper stepper) { return rise(model, stepper); },
                           .limit = [](const Run&) { return 10.0; }});
        },
        any);
  }
  return cases;
}

}  // namespace

std::vector<Case> at_round_off() {
  std::vector<Case> cases = tight();
  cases.insert(cases.begin(), sample_at_singular());
  return cases;
}

}  // namespace dalembert::extremes
