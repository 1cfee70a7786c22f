#include "dalembert/models/bricard.h"

#include <dalembert/models/minimal_ode.h>
#include <dalembert/models/numbered.h>

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace dalembert::models {

namespace {

using SpaceVector = VecOf<Real, 3>;

/// A joint and its derivatives with respect to a.
struct Joint {
  SpaceVector P, P1, P2;
};

/// P_1 ... P_6.
std::array<Joint, 6> joints(Real a) {
  const Real s = std::sin(a), c = std::cos(a), w = 1 + s, w2 = w * w, q2 = 1 + 2 * s, q = std::sqrt(q2);
  // Each component f with f' and f''; w' = c, q' = c/q, c^2 = (1 - s) w.
  const SpaceVector C(c, -s, -c), S(s, c, -s), one(1, 0, 0), zero(0, 0, 0);
  const SpaceVector c_w(c / w, -1 / w, c / w2);
  const SpaceVector s_w(s / w, c / w2, (s - 2) / w2);
  const SpaceVector one_w(1 / w, -c / w2, (2 - s) / w2);
  const SpaceVector Q(q, c / q, -(s * q2 + c * c) / (q * q2));
  const SpaceVector q_w(q / w, -c * s / (q * w2),
                        (s * s - c * c + s * c * c / q2 + 2 * s * (1 - s)) / (q * w2));
  const auto joint = [](const SpaceVector& x, const SpaceVector& y, const SpaceVector& z) {
    return Joint{{x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]}};
  };
  return {joint(zero, zero, zero), joint(C, zero, -S),       joint(c_w, -q_w, -s_w),
          joint(C, -Q, one - S),   joint(zero, -q_w, one_w), joint(zero, zero, one)};
}

/// The equation of motion at a and a', and what the ground carries.
struct Motion {
  std::array<Joint, 6> P;
  Real a2;  // a''
  SpaceVector ground = SpaceVector::Zero();

  Motion(const Bricard& b, Real a, Real a1) : P(joints(a)) {
    const SpaceVector g(0, -Real(b.gravity), 0);
    Real M = 0, C = 0, pull = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      const Joint &p = P[i], &r = P[i + 1];
      M += (p.P1.dot(p.P1) + p.P1.dot(r.P1) + r.P1.dot(r.P1)) / 3;
      C += (2 * p.P1.dot(p.P2) + p.P1.dot(r.P2) + p.P2.dot(r.P1) + 2 * r.P1.dot(r.P2)) / 6;
      pull += g.dot(p.P1 + r.P1) / 2;
    }
    a2 = (pull - C * a1 * a1) / M;
    for (std::size_t i = 0; i < 5; ++i) {
      const SpaceVector slope = (P[i].P1 + P[i + 1].P1) / 2, bend = (P[i].P2 + P[i + 1].P2) / 2;
      ground += b.mass * (slope * a2 + bend * a1 * a1 - g);
    }
  }
};

// The axes of the joints from either end of the ring; w_1 = y, w_6 = x.
constexpr auto w2 = [](const auto& P2) { return vec(-P2.z(), 0.0, P2.x()); };
constexpr auto w3 = [](const auto& P2, const auto& P3) { return (P3 - P2).cross(w2(P2)).eval(); };
constexpr auto w5 = [](const auto& P5) { return vec(0.0, 1.0 - P5.z(), P5.y()); };
constexpr auto w4 = [](const auto& P4, const auto& P5) { return (P5 - P4).cross(w5(P5)).eval(); };

void add_axes(Scene<3>& scene, const std::array<ThinRod<3>, 5>& rods) {
  const auto P2 = rods[0].end(), P3 = rods[1].end(), P4 = rods[2].end(), P5 = rods[3].end();
  scene.add(holonomic(points(P2), [](const auto& p2) { return p2.y(); }), "r1 w1");
  scene.add(holonomic(points(P2, P3), [](const auto& p2, const auto& p3) { return (p3 - p2).dot(w2(p2)); }),
            "r2 w2");
  scene.add(holonomic(points(P2, P3, P4), [](const auto& p2, const auto& p3,
                                             const auto& p4) { return (p4 - p3).dot(w3(p2, p3)); }),
            "r3 w3");
  scene.add(holonomic(points(P2, P3, P4, P5), [](const auto& p2, const auto& p3, const auto& p4,
                                                 const auto& p5) { return w3(p2, p3).dot(w4(p4, p5)); }),
            "w3 w4");
  scene.add(holonomic(points(P3, P4, P5), [](const auto& p3, const auto& p4,
                                             const auto& p5) { return (p4 - p3).dot(w4(p4, p5)); }),
            "r3 w4");
  scene.add(holonomic(points(P4, P5), [](const auto& p4, const auto& p5) { return (p5 - p4).dot(w5(p5)); }),
            "r4 w5");
  scene.add(holonomic(points(P5), [](const auto& p5) { return -p5.x(); }), "r5 w6");
}

}  // namespace

BricardScene Bricard::scene() const {
  BricardScene built{.scene = Scene<3>("bricard"), .rods = {}};
  Scene<3>& scene = built.scene;
  auto& rods = built.rods;
  scene.add(UniformGravity<3>{{0.0, -gravity, 0.0}});
  const auto P = joints(0);
  const auto at = [&P](std::size_t i) { return Vec<3>(P[i].P.cast<double>()); };
  for (std::size_t i = 0; i < 5; ++i)
    rods[i] =
        add_thin_rod<3>(scene, {.mass = mass, .start = at(i), .end = at(i + 1)}, numbered("rod", i + 1));
  const Fixed<3> P1{at(0)}, P6{at(5)};
  scene.add(Coincident{P1, rods[0].start()}, "P1");
  for (std::size_t i = 0; i + 1 < 5; ++i)
    scene.add(Coincident{rods[i].end(), rods[i + 1].start()}, numbered("P", i + 2));
  scene.add(Coincident{rods[4].end(), P6}, "P6");
  add_axes(scene, rods);
  return built;
}

std::vector<Observation<3>> Bricard::reference(std::span<const double> times) const {
  const auto equations = [this](const State& y, State& y_rate) {  // y = (a, a')
    y_rate[0] = y[1];
    y_rate[1] = Motion(*this, y[0], y[1]).a2;
  };
  std::vector<Observation<3>> seen;
  integrate(equations, State{0, 0}, times, [&](const State& y) {
    const Motion now(*this, y[0], y[1]);
    Observation<3> at;
    for (std::size_t i = 1; i < 5; ++i) at.positions.push_back(now.P[i].P.cast<double>());
    for (int i = 0; i < 3; ++i) at.forces.push_back(static_cast<double>(now.ground[i]));
    seen.push_back(std::move(at));
  });
  return seen;
}

Observation<3> Bricard::reference(double t) const { return reference(std::array{t}).front(); }

Model<3> Bricard::model() const {
  const double weight = 5.0 * mass * gravity;
  return {.name = "bricard",
          .notes = "-",
          .reference = "equation of motion for the turn of the first rod in extended precision",
          .t_end = 10.0,
          .length = 1.0,
          .force = weight,
          .energy = weight,
          .scene =
              [*this] {
                BricardScene built = scene();
                return Observed<3>{std::move(built.scene), [rods = built.rods](const Sample<3>& sample) {
                                     Observation<3> seen;
                                     Vec<3> ground = Vec<3>::Zero();  // forces between rods cancel
                                     for (const auto& rod : rods)
                                       for (const auto& p : rod.particles)
                                         ground += sample.constraint_force(p);
                                     for (std::size_t i = 0; i < 4; ++i)
                                       seen.positions.push_back(sample.position(rods[i].end()));
                                     seen.forces = {ground.x(), ground.y(), ground.z()};
                                     return seen;
                                   }};
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
