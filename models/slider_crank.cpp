#include "dalembert/models/slider_crank.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace dalembert::models {

namespace {

/// The mechanism at crank angle q and rate w.
struct Linkage {
  Real sq, cq, sp, cp, x;  // sines and cosines, slider
  Real P, X, P_q, X_q;     // dp/dq, dx/dq and their derivatives
  Real Q_q, Q_x, Q_p;      // generalised forces
  Real q2, x2, p2;         // second time derivatives

  Linkage(const SliderCrank& s, const State& y) {
    const Real a = s.crank_radius, w = y[1];
    sq = std::sin(y[0]), cq = std::cos(y[0]);
    sp = -a * sq, cp = std::sqrt(1 - sp * sp);
    x = cp + a * cq;
    P = -a * cq / cp;
    X = -sp * P - a * sq;
    P_q = (a * sq + sp * P * P) / cp;
    X_q = -cp * P * P - sp * P_q - a * cq;
    find_forces(s, a, w);
    const Real inertia = s.crank_inertia + s.slider_mass * X * X + s.rod_inertia * P * P;
    q2 = (Q_q + X * Q_x + P * Q_p - (s.slider_mass * X * X_q + s.rod_inertia * P * P_q) * w * w) / inertia;
    x2 = X * q2 + X_q * w * w;
    p2 = P * q2 + P_q * w * w;
  }

 private:
  void find_forces(const SliderCrank& s, Real a, Real w) {
    const Real sine = sq * cp - cq * sp;  // of q - p
    const Real l = std::sqrt(x * x - x * (cp + a * cq) + (1 + a * a) / 4 + a * (cq * cp + sq * sp) / 2);
    const Real l_q = (x * a * sq - a * sine / 2) / (2 * l);
    const Real l_x = (2 * x - cp - a * cq) / (2 * l);
    const Real l_p = (x * sp + a * sine / 2) / (2 * l);
    const Real f = s.stiffness * (l - s.relaxed_length) + s.damping * w * (l_q + l_x * X + l_p * P);
    Q_q = -f * l_q;
    Q_x = -f * l_x + s.drive;
    Q_p = -f * l_p - s.drive * sp;
  }
};

}  // namespace

SliderCrankScene SliderCrank::scene() const {
  const double p = std::asin(-crank_radius), x = std::cos(p);
  Scene<2> scene("slider-crank");
  // The crank's centre of mass is in its bearing: its mass does not matter.
  const RigidBody<2> crank =
      add_body(scene, {.mass = 1.0, .inertia = crank_inertia, .angle = std::numbers::pi / 2}, "crank");
  const RigidBody<2> rod =
      add_body(scene, {.mass = slider_mass, .inertia = rod_inertia, .centre = {x, 0.0}, .angle = p}, "rod");
  scene.add(Coincident{Fixed<2>{}, crank.centre()}, "bearing");
  const auto pin =
      scene.add(Coincident{crank.point({crank_radius, 0.0}), rod.point({-1.0, 0.0})}, "crank pin");
  const auto guide = scene.add(OnCurve{rod.centre(), Plane<2>{}}, "guide");

  const auto middle_of_crank = crank.point({0.5 * crank_radius, 0.0});
  const auto middle_of_rod = rod.point({-0.5, 0.0});
  scene.add(Spring{middle_of_crank, middle_of_rod, stiffness, relaxed_length});
  scene.add(Damper{middle_of_crank, middle_of_rod, damping});
  scene.add(PointGravity{rod.point({1.0, 0.0}), 1.0, {drive, 0.0}}, "drive");
  return {std::move(scene), crank, rod, pin, guide};
}

std::vector<Observation<2>> SliderCrank::reference(std::span<const double> times) const {
  const auto equations = [&](const State& y, State& y_rate) {  // y = (q, q')
    y_rate[0] = y[1];
    y_rate[1] = Linkage(*this, y).q2;
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{std::numbers::pi_v<Real> / 2, 0}, times, [&](const State& y) {
    const Linkage now(*this, y);
    const Real R_x = slider_mass * now.x2 - now.Q_x;
    const Real R_y = (now.Q_p - rod_inertia * now.p2 + R_x * now.sp) / now.cp;
    const VecOf<Real, 2> pin = crank_radius * vec(now.cq, now.sq), slider = vec(now.x, Real(0));
    seen.push_back(
        {.positions = {pin.cast<double>(), slider.cast<double>()},
         .forces = {static_cast<double>(R_x), static_cast<double>(R_y), static_cast<double>(-R_y)}});
  });
  return seen;
}

Observation<2> SliderCrank::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> SliderCrank::model() const {
  return {.name = "slider-crank",
          .notes = "-",
          .reference = "equation of motion for the crank angle in extended precision, forces by Newton's law",
          .t_end = 10.0,
          .length = 1.0,
          .force = drive,
          .energy = drive,
          .scene =
              [*this] {
                SliderCrankScene built = scene();
                const auto observe = [radius = crank_radius, crank = built.crank, rod = built.rod,
                                      pin = built.pin, guide = built.guide](const Sample<2>& sample) {
                  const Vec<2> R = sample.multiplier(pin);
                  return Observation<2>{.positions = {sample.position(crank.point({radius, 0.0})),
                                                      sample.position(rod.centre())},
                                        .forces = {R.x(), R.y(), sample.multiplier(guide)}};
                };
                return Observed<2>{std::move(built.scene), observe, {}};  // the damper takes energy
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
