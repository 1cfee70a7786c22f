#include <dalembert/tests/extremes/cases/bounds.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>

namespace dalembert::extremes {

namespace {

/// A redundant statement is to be as accurate as an independent one: within 100 tolerances at 1,000 samples,
/// and 1e-12 of round-off.
double as_good(const Run& run) { return std::max(100.0 * run.parameter, 1e-12); }

const std::vector<double> tolerances = {1e-3, 1e-4, 1e-6, 1e-8, 1e-10};

/// A rod of 1 m and a pin that carries its end around, (cos t, sin t): each implies the other, and at every
/// quarter of a turn others of their three equations are independent. With g the force on 1 kg is
/// (-cos t, g - sin t).
Case redundant_pin() {
  return {.name = "redundant-pin",
          .parameter = "tolerance, a rod and a driven pin that imply each other, 2 turns",
          .sweep = tolerances,
          .brief = {1e-4, 1e-6, 1e-10},
          .run =
              [](double tolerance, Stepper stepper) {
                constexpr double g = 9.81;
                Scene<2> scene("redundant-pin");
                scene.add(UniformGravity<2>{{0.0, -g}});
                const auto p =
                    scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 1.0}}, "p");
                scene.add(Distance{Fixed<2>{}, p, 1.0}, "rod");
                scene.add(Coincident{driven([](auto t) { return vec(cos(t), sin(t)); }), p}, "pin");
                const auto run = simulate(scene, {.t_end = 4.0 * std::numbers::pi,
                                                  .samples = 1001,
                                                  .tolerance = tolerance,
                                                  .stepper = stepper});
                double error = 0.0;
                for (std::size_t i = 0; i < run.size(); ++i) {
                  const double t = run.times()[i], c = std::cos(t), s = std::sin(t);
                  error = larger(error, (run.position(p, i) - Vec<2>(c, s)).norm());
                  error = larger(error, (run.velocity(p, i) - Vec<2>(-s, c)).norm());
                  error = larger(error, (run.constraint_force(p, i) - Vec<2>(-c, g - s)).norm() / g);
                }
                return Run{.error = error, .statistics = run.statistics()};
              },
          .limit = as_good};
}

/// Motion of a body's points and the force of all constraints on it.
struct Seen {
  std::vector<Vec<3>> positions;
  Vec<3> force;
};

/// Largest difference of two runs of one mechanism, of positions and of forces over `weight`.
double difference(const std::vector<Seen>& a, const std::vector<Seen>& b, double weight) {
  double error = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].positions.size(); ++k)
      error = larger(error, (a[i].positions[k] - b[i].positions[k]).norm());
    error = larger(error, (a[i].force - b[i].force).norm() / weight);
  }
  return error;
}

/// A mechanism of bodies, stated with or without redundancy.
struct Mechanism {
  Scene<3> scene;
  std::vector<RigidBody<3>> bodies;

  [[nodiscard]] std::vector<Seen> run(const Options& options, Statistics& statistics) const {
    std::vector<Seen> seen;
    statistics = simulate(scene, options, [&](const Sample<3>& sample) {
      Seen now{{}, Vec<3>::Zero()};
      for (const auto& body : bodies) {
        now.positions.push_back(sample.position(body.centre()));
        for (const auto& particle : body.particles) now.force += sample.constraint_force(particle);
      }
      seen.push_back(std::move(now));
    });
    return seen;
  }
};

/// By how much the redundant statement of a mechanism errs more than the other, both at a tolerance against
/// the other at a hundredth of it.
Run compared_statements(const Mechanism& repeated, const Mechanism& once, double weight, double t_end,
                        double tolerance, Stepper stepper) {
  Options options{.t_end = t_end, .samples = 1001, .tolerance = tolerance, .stepper = stepper};
  Run result;
  Statistics unused;
  const auto seen = repeated.run(options, result.statistics), seen_once = once.run(options, unused);
  options.tolerance = std::max(0.01 * tolerance, 1e-12);
  options.stepper = Stepper::erk;
  const auto exact = once.run(options, unused);
  result.error = difference(seen, exact, weight) - difference(seen_once, exact, weight);
  return result;
}

/// A door on a horizontal axis that turns about the vertical one, x = r (cos t, sin t), held by balls on that
/// axis; or by one of them and two equations for the direction to the next.
Mechanism door(int balls) {
  Mechanism m{.scene = Scene<3>("door"), .bodies = {}};
  const Vec<3> spin(0.0, 0.0, 1.0), centre(0.0, 0.3, 0.0);
  m.scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto body = add_body<3>(m.scene,
                                {.mass = 1.0,
                                 .inertia = {0.02, 0.03, 0.04},
                                 .centre = centre,
                                 .velocity = spin.cross(centre),
                                 .angular_velocity = spin},
                                "door");
  m.bodies.push_back(body);
  const auto on_axis = [](double r) {
    return driven([r](auto t) { return vec(r * cos(t), r * sin(t), 0.0 * t); });
  };
  m.scene.add(Coincident{on_axis(0.2), body.point({0.2, -0.3, 0.0})}, "hinge 1");
  const auto second = body.point({-0.2, -0.3, 0.0});
  if (balls == 1) {
    m.scene.add(holonomic(points(second), [](auto t, auto p) { return p.y() * cos(t) - p.x() * sin(t); }));
    m.scene.add(holonomic(points(second), [](auto p) { return p.z(); }));
  }
  if (balls >= 2) m.scene.add(Coincident{on_axis(-0.2), second}, "hinge 2");
  if (balls >= 3) m.scene.add(Coincident{on_axis(0.0), body.point({0.0, -0.3, 0.0})}, "hinge 3");
  return m;
}

/// Of all constraints on the door, in that turn [N].
constexpr double largest_force_of_door = 26.0;

Case redundant_hinge(int balls) {
  const std::string number = std::to_string(balls);
  return {.name = "redundant-hinge-" + number,
          .parameter = "tolerance, a door on " + number + " balls, a turn of its axis",
          .sweep = tolerances,
          .brief = {1e-6, 1e-8},
          .run =
              [balls](double tolerance, Stepper stepper) {
                return compared_statements(door(balls), door(1), largest_force_of_door,
                                           2.0 * std::numbers::pi, tolerance, stepper);
              },
          .limit = as_good};
}

/// Bricard's ring (see models::Bricard) of five bodies and the ground, at a = 0: joints and their axes.
struct Hinge {
  Vec<3> at, axis;
};
const std::array<Hinge, 6> hinges = {{{{0, 0, 0}, {0, 1, 0}},
                                      {{1, 0, 0}, {0, 0, 1}},
                                      {{1, -1, 0}, {-1, 0, 0}},
                                      {{1, -1, 1}, {0, -1, 0}},
                                      {{0, -1, 1}, {0, 0, -1}},
                                      {{0, 0, 1}, {1, 0, 0}}}};

/// Either two balls on each axis, or one and the directions of the axis in both bodies: two equations, its
/// products with two directions at right angles to it in the other body.
template <class A, class B>
void add_hinge(Scene<3>& scene, const Hinge& hinge, bool balls, const A& in_a, const B& in_b) {
  constexpr double reach = 0.2;
  const Vec<3> beyond = hinge.at + reach * hinge.axis, side = hinge.axis.unitOrthogonal();
  scene.add(Coincident{in_a(hinge.at), in_b(hinge.at)});
  if (balls) {
    scene.add(Coincident{in_a(beyond), in_b(beyond)});
    return;
  }
  for (const Vec<3>& direction : {side, Vec<3>(hinge.axis.cross(side))}) {
    const Vec<3> aside = hinge.at + direction;
    scene.add(holonomic(points(in_a(beyond), in_b(hinge.at), in_b(aside)),
                        [](const auto& a, const auto& b, const auto& c) { return (a - b).dot(c - b); }));
  }
}

Mechanism ring(bool balls) {
  Mechanism m{.scene = Scene<3>("bricard"), .bodies = {}};
  m.scene.add(UniformGravity<3>{{0.0, -9.81, 0.0}});
  std::vector<Eigen::Isometry3d> frames;
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec<3> along = hinges[i + 1].at - hinges[i].at, side = hinges[i].axis;
    const Mat<3, 3> axes(along, side, along.cross(side));
    const Vec<3> centre = 0.5 * (hinges[i].at + hinges[i + 1].at);
    m.bodies.push_back(
        add_body<3>(m.scene, {.mass = 1.0, .inertia = {0.04, 0.09, 0.1}, .centre = centre, .axes = axes},
                    "body " + std::to_string(i + 1)));
    frames.push_back(Eigen::Translation3d(centre) * Eigen::AngleAxisd(Eigen::Matrix3d(axes)));
  }
  const auto in = [&](std::size_t i) {
    return [&, i](const Vec<3>& p) { return m.bodies[i].point(frames[i].inverse() * p); };
  };
  const auto ground = [](const Vec<3>& p) { return Fixed<3>{p}; };
  add_hinge(m.scene, hinges[0], balls, ground, in(0));
  for (std::size_t i = 1; i < 5; ++i) add_hinge(m.scene, hinges[i], balls, in(i - 1), in(i));
  add_hinge(m.scene, hinges[5], balls, ground, in(4));
  return m;
}

/// Overconstrained by one in either statement, by seven with balls.
Case bricard_balls() {
  return {.name = "bricard-balls",
          .parameter = "tolerance, Bricard's ring on two balls a hinge, 5 s",
          .sweep = tolerances,
          .brief = {1e-6},
          .run =
              [](double tolerance, Stepper stepper) {
                return compared_statements(ring(true), ring(false), 5.0 * 9.81, 5.0, tolerance, stepper);
              },
          .limit = as_good};
}

}  // namespace

std::vector<Case> redundancy() {
  return {redundant_pin(), redundant_hinge(2), redundant_hinge(3), bricard_balls()};
}

}  // namespace dalembert::extremes
