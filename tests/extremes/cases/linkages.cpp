#include <dalembert/models/andrews.h>
#include <dalembert/models/four_bar.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/minimal_ode.h>
#include <dalembert/models/slider_crank.h>
#include <dalembert/models/sliding_rod.h>
#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>

namespace dalembert::extremes {

namespace {

using models::Observation;
using models::Real;
using models::State;

/// Largest distance of B_0 from the exact branch.
Run of_first_joint(int loops, const Options& options) {
  const models::FourBar linkage{.loops = loops};
  const auto reference = linkage.reference(sample_times(options));
  const models::FourBarScene built = linkage.scene();
  const Trajectory<2> run = simulate(built.scene, options);
  double error = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i)
    error = larger(error, (run.position(built.uprights[0].end(), i) - reference[i].positions[0]).norm());
  return {.error = error, .statistics = run.statistics()};
}

/// A row of N is hypot(N, 1) m long; its joints need 0.2 s for 1 m at their full speed.
Case four_bar() {
  return {
      .name = "four-bar",
      .parameter = "loops, over 20 s at tolerance 1e-8",
      .sweep = {1.0, 2.0, 10.0, 40.0},
      .brief = {1.0, 2.0, 10.0, 40.0},
      .run =
          [](double loops, Stepper stepper) {
            return of_first_joint(static_cast<int>(loops),
                                  {.t_end = 20.0, .tolerance = 1e-8, .stepper = stepper});
          },
      .limit =
          [](const Run& run) { return std::hypot(run.parameter, 1.0) * added_up(run, 1e-8, 20.0 / 0.2); }};
}

/// Required of N = 2 at 1e-10.
Case four_bar_tight() {
  return {.name = "four-bar-tight",
          .parameter = "loops, over 10 s at tolerance 1e-10",
          .sweep = {1.0, 2.0, 10.0},
          .brief = {2.0, 10.0},
          .run =
              [](double loops, Stepper stepper) {
                return of_first_joint(static_cast<int>(loops),
                                      {.t_end = 10.0,
                                       .tolerance = 1e-10,
                                       .stepper = stepper,
                                       .max_steps = 50'000});  // ten times what it takes
              },
          .limit = [](const Run&) { return 1e-6; }};
}

const std::vector<double> every_tolerance = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};

/// How often the rods of a linkage lie in line: the height of B_0 changes its sign.
int times_in_line(const models::FourBar& linkage, const Options& options) {
  const auto reference = linkage.reference(sample_times(options));
  int changes = 0;
  for (std::size_t i = 1; i < reference.size(); ++i)
    changes += reference[i - 1].positions[0].y() * reference[i].positions[0].y() < 0.0 ? 1 : 0;
  return changes;
}

Case crossings() {
  return {
      .name = "crossings",
      .parameter = "tolerance; singular positions of a four-bar in 20 s, against the reference's",
      .sweep = every_tolerance,
      .brief = {1e-4, 1e-8, 1e-11},
      .run =
          [](double tolerance, Stepper stepper) {
            const models::FourBar linkage{.loops = 2};
            const Options options{.t_end = 20.0, .samples = 2001, .tolerance = tolerance, .stepper = stepper};
            const auto run = simulate(linkage.scene().scene, options);
            const int expected = times_in_line(linkage, options);
            return Run{.error = static_cast<double>(std::abs(run.statistics().singular_positions - expected)),
                       .statistics = run.statistics()};
          },
      .limit = [](const Run&) { return 0.0; }};
}

/// Constraints that come nowhere close to dependent, though Newton's iteration may fail at tight tolerances.
Case no_crossings() {
  return {
      .name = "no-crossings",
      .parameter = "tolerance; singular positions of scenes without any",
      .sweep = every_tolerance,
      .brief = every_tolerance,
      .run =
          [](double tolerance, Stepper stepper) {
            Run result{.error = 0.0};
            const auto add = [&](const auto& scene, double t_end) {
              result.statistics =
                  simulate(scene, {.t_end = t_end, .tolerance = tolerance, .stepper = stepper}).statistics();
              result.error += result.statistics.singular_positions;
            };
            add(models::Andrews{}.model().scene().scene, 0.03);
            add(models::Governor{}.model().scene().scene, 2.0);
            add(models::SlidingRod{}.model().scene().scene, 1.0);
            Scene<2> rod("compliant-rod");
            rod.add(UniformGravity<2>{{0.0, -9.81}});
            const auto bob = rod.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
            rod.add(compliant(Distance{Fixed<2>{}, bob, 1.0}, 1.0 / 8e5), "rod");
            add(rod, 1.0);
            return result;
          },
      .limit = [](const Run&) { return 0.0; }};
}

/// A crank shorter than the rod by d: with the crank upright the slider lies below its bearing, and the rod
/// stands at cos p = sqrt(2 d), so that errors of position and velocity count 1/cos p times in the slider
/// and once more in the forces.
Case toggle() {
  constexpr double tolerance = 1e-8;
  return {.name = "toggle",
          .parameter = "1 - crank radius over the rod of a slider crank",
          .sweep = {1e-1, 1e-2, 1e-3, 1e-4},
          .brief = {1e-1, 1e-3},
          .run =
              [](double shorter, Stepper stepper) {
                const models::SliderCrank linkage{.crank_radius = 1.0 - shorter};
                return compared<2>(linkage.model(),
                                   {.t_end = 10.0, .tolerance = tolerance, .stepper = stepper});
              },
          .limit = [](const Run& run) { return added_up(run, tolerance, 10.0) / (2.0 * run.parameter); }};
}

/// Crank and rod of 1 m with beads of 1 kg: q the crank's angle from the x axis, the slider at x = 2 cos q.
/// With the crank upright the slider is at the bearing: the constraints are dependent for an instant and it
/// could stay there. Straight on, by Lagrange,
///
///   (1 + 4 sin^2 q) q'' + 4 sin q cos q q'^2 + g cos q = 0.
struct DeadPoint {
  double speed;  ///< q' at q = 0.3
  [[nodiscard]] std::vector<std::pair<Vec<2>, Vec<2>>> reference(std::span<const double> times) const {
    std::vector<std::pair<Vec<2>, Vec<2>>> seen;
    const auto equations = [](const State& y, State& rate) {
      const Real sine = std::sin(y[0]), cosine = std::cos(y[0]);
      rate = {y[1], -cosine * (4 * sine * y[1] * y[1] + Real(9.81)) / (1 + 4 * sine * sine)};
    };
    models::integrate(equations, State{Real(0.3), speed}, times, [&](const State& y) {
      const VecOf<Real, 2> pin = vec(std::cos(y[0]), std::sin(y[0]));
      seen.emplace_back(pin.cast<double>(), Vec<2>(static_cast<double>(2 * pin.x()), 0.0));
    });
    return seen;
  }
  [[nodiscard]] Run compared(const Options& options) const {
    Scene<2> scene("dead-point");
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    const double sine = std::sin(0.3), cosine = std::cos(0.3);
    const auto pin = scene.add_particle(
        {.mass = 1.0, .position = {cosine, sine}, .velocity = speed * Vec<2>(-sine, cosine)}, "pin");
    const auto slider = scene.add_particle(
        {.mass = 1.0, .position = {2.0 * cosine, 0.0}, .velocity = {-2.0 * speed * sine, 0.0}}, "slider");
    scene.add(Distance{Fixed<2>{}, pin, 1.0}, "crank");
    scene.add(Distance{pin, slider, 1.0}, "rod");
    scene.add(OnCurve{slider, Plane<2>{}}, "guide");
    const Trajectory<2> run = simulate(scene, options);
    const auto exact = reference(run.times());
    double error = 0.0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      error = larger(error, (run.position(pin, i) - exact[i].first).norm());
      error = larger(error, (run.position(slider, i) - exact[i].second).norm());
    }
    return {.error = error, .statistics = run.statistics()};
  }
};

/// The crank must have the speed to come over the top, q'^2 > 2 g (1 - sin 0.3)/(1 + 4 sin^2 0.3) = 10.3. The
/// scene is 2 m long; its own time is that of a fall of 1 m, 0.3 s, or what the crank needs for 2 m.
Case dead_point() {
  constexpr double tolerance = 1e-8;
  return {.name = "dead-point",
          .parameter = "initial speed of a crank as long as its rod [rad/s]",
          .sweep = {5.0, 6.0, 8.0, 12.0},
          .brief = {6.0},
          .run =
              [](double speed, Stepper stepper) {
                return DeadPoint{speed}.compared({.t_end = 5.0, .tolerance = tolerance, .stepper = stepper});
              },
          .limit =
              [](const Run& run) {
                return 2.0 * added_up(run, tolerance, 5.0 / std::min(0.3, 2.0 / run.parameter));
              }};
}

}  // namespace

std::vector<Case> linkages() {
  return {four_bar(), four_bar_tight(), crossings(), no_crossings(), toggle(), dead_point()};
}

}  // namespace dalembert::extremes
