#include <dalembert/tests/extremes/cases/bounds.h>

#include <cmath>
#include <string>

namespace dalembert::extremes {

namespace {

/// Below this part of the scene's length or speed a violation is taken for rounding (docs/messages.md: within
/// 1e-8).
constexpr double start_tolerance = 1e-8;
/// Distances and speeds are printed with six digits.
constexpr double printed = 1e-5;

/// The number after `word of` in a message, NaN without.
double number_after(const std::string& said, const std::string& word) {
  const std::size_t at = said.find(word + " of ");
  if (at == std::string::npos) return std::numeric_limits<double>::quiet_NaN();
  return std::strtod(said.c_str() + at + word.size() + 4, nullptr);
}

/// A refusal that must name `culprit` and, after `word`, the distance or speed d.
Run as_refused(const InconsistentStart& refusal, const std::string& culprit, const std::string& word,
               double d) {
  const std::string said = refusal.what();
  const double named = said.find(culprit) != std::string::npos ? number_after(said, word) : infinite;
  return ended_by(refusal, std::abs(named / d - 1.0));
}

/// A pendulum of 1 m from horizontal, its bob put `apart` beyond the rod's length and moving along it at
/// `speed`.
struct Astray {
  double apart = 0.0, speed = 0.0;
  Scene<2> scene{"astray"};
  Particle<2> bob =
      scene.add_particle({.mass = 1.0, .position = {1.0 + apart, 0.0}, .velocity = {speed, 0.0}});

  Astray(double distance, double velocity) : apart(distance), speed(velocity) {
    scene.add(UniformGravity<2>{{0.0, -9.81}});
    scene.add(Distance{Fixed<2>{}, bob, 1.0}, "rod");
  }
};

/// What is left of a start's violation: a few roundings of 1 m or 1 m/s.
double left_of(const Simulation<2>& simulation, Particle<2> bob) {
  const Vec<2> r = simulation.position(bob);
  return larger(std::abs(r.norm() - 1.0), std::abs(r.normalized().dot(simulation.velocity(bob))));
}
constexpr double few_roundings = 16.0 * epsilon;

/// Accepted as rounding, and then set right; or refused with its name and distance. The scene is 1 m long
/// and, at rest, as fast as a fall of 1 m.
Case refused(const char* name, const char* parameter, const char* word, double scale,
             Astray (*start)(double)) {
  return {
      .name = name,
      .parameter = parameter,
      .sweep = {1e-14, 1e-10, 5e-9, 1e-7, 1e-4, 1e-2, 1.0},
      .brief = {1e-14, 5e-9, 1e-7, 1.0},
      .run =
          [=](double d, Stepper stepper) {
            const Astray astray = start(d);
            try {
              const Simulation<2> simulation(astray.scene, {.t_end = 1.0, .stepper = stepper});
              const double left = left_of(simulation, astray.bob);
              return Run{.error = d <= start_tolerance * scale ? left : infinite};
            } catch (const InconsistentStart& refusal) {
              return as_refused(refusal, "\"rod\"", word, d);
            }
          },
      .limit =
          [=](const Run& run) { return run.parameter <= start_tolerance * scale ? few_roundings : printed; }};
}

/// An elbow of two rods over a gap of 1.8 m, its joint sqrt(1 - 0.81) high, put off by d along x and down:
/// assembled onto both rods, above the gap as it was, and no further away than its start was from there, but
/// for the curvature of the rods, which doubles a gross distance.
Case assembled() {
  return {.name = "assembled",
          .parameter = "distance by which a joint of two rods starts astray [m]",
          .sweep = {0.0, 1e-14, 1e-10, 1e-6, 1e-3, 1e-2, 1e-1, 2e-1, 3e-1},
          .brief = {0.0, 1e-10, 1e-3, 3e-1},
          .run =
              [](double d, Stepper stepper) {
                const Vec<2> right(0.9, std::sqrt(1.0 - 0.81)), given = right + d * Vec<2>(0.6, -0.8);
                Scene<2> scene("elbow");
                const auto joint = scene.add_particle({.mass = 1.0, .position = given});
                scene.add(Distance{Fixed<2>{}, joint, 1.0}, "left");
                scene.add(Distance{Fixed<2>{{1.8, 0.0}}, joint, 1.0}, "right");
                const Simulation<2> simulation(scene, {.t_end = 1.0, .stepper = stepper, .assemble = true});
                return Run{.error = (simulation.position(joint) - right).norm()};
              },
          // The rods meet at an angle whose sine is 0.78; the height is one rounding of 1 over 2 x 0.44.
          .limit = [](const Run&) { return few_roundings; }};
}

/// Two rods hold one bob, the second longer by d: they agree but for rounding, or contradict each other.
Case redundant(const char* name, bool assemble) {
  return {
      .name = name,
      .parameter = "length by which a second rod disagrees with the first [m]",
      .sweep = {0.0, 1e-14, 1e-10, 5e-9, 1e-7, 1e-4, 1e-2, 1.0},
      .brief = {0.0, 1e-10, 1e-4, 1.0},
      .run =
          [=](double d, Stepper stepper) {
            Scene<2> scene("redundant");
            scene.add(UniformGravity<2>{{0.0, -9.81}});
            const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
            scene.add(Distance{Fixed<2>{}, bob, 1.0}, "first");
            scene.add(Distance{Fixed<2>{}, bob, 1.0 + d}, "second");
            try {
              const Simulation<2> simulation(scene, {.t_end = 1.0, .stepper = stepper, .assemble = assemble});
              // Somewhere between the two.
              return Run{.error = d <= start_tolerance
                                      ? std::max(0.0, std::abs(simulation.position(bob).norm() - 1.0) - d)
                                      : infinite};
            } catch (const InconsistentStart& refusal) {
              const std::string said = refusal.what();
              const char* culprit = said.find("\"first\"") != std::string::npos ? "\"first\"" : "\"second\"";
              return as_refused(refusal, culprit, "distance", d);
            }
          },
      .limit = [](const Run& run) { return run.parameter <= start_tolerance ? few_roundings : printed; }};
}

/// A skate held by two blades that differ in the sideways speed they allow: the bob of 1 m/s along x must
/// have 0 and d along y.
Case redundant_velocities() {
  return {.name = "redundant-velocities",
          .parameter = "speed by which a second blade disagrees with the first [m/s]",
          .sweep = {0.0, 1e-14, 1e-10, 5e-9, 1e-7, 1e-4, 1.0},
          .brief = {0.0, 1e-10, 1e-4, 1.0},
          .run =
              [](double d, Stepper stepper) {
                Scene<2> scene("blades");
                const auto skate = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
                scene.add(nonholonomic(points(skate), [](auto, auto v) { return v.y(); }), "first");
                scene.add(nonholonomic(points(skate), [d](auto, auto v) { return v.y() - d; }), "second");
                try {
                  const Simulation<2> simulation(scene, {.t_end = 1.0, .stepper = stepper, .assemble = true});
                  return Run{.error = d <= start_tolerance
                                          ? std::max(0.0, std::abs(simulation.velocity(skate).y()) - d)
                                          : infinite};
                } catch (const InconsistentStart& refusal) {
                  const std::string said = refusal.what();
                  const char* culprit =
                      said.find("\"first\"") != std::string::npos ? "\"first\"" : "\"second\"";
                  return as_refused(refusal, culprit, "speed", d);
                }
              },
          .limit = [](const Run& run) { return run.parameter <= start_tolerance ? few_roundings : printed; }};
}

}  // namespace

std::vector<Case> starts() {
  return {refused("refused-position", "distance of a bob from its rod's length [m]", "distance", 1.0,
                  [](double d) { return Astray(d, 0.0); }),
          refused("refused-velocity", "speed of a bob along its rod [m/s]", "speed", std::sqrt(9.81),
                  [](double d) { return Astray(0.0, d); }),
          assembled(),
          redundant("redundant", false),
          redundant("redundant-assembled", true),
          redundant_velocities()};
}

}  // namespace dalembert::extremes
