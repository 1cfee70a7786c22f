#include "dalembert/models/spinning_disk.h"

#include <dalembert/models/minimal_ode.h>

#include <array>
#include <cmath>
#include <utility>

namespace dalembert::models {

namespace {

using Vector = VecOf<Real, 3>;

/// The disk at one instant; the state is theta, theta', Omega, w3, the direction psi of h, the angle
/// chi of the mark from t towards rho, and x and y of the centre.
struct RollingState {
  Real theta1, Omega, w3, sine, cosine;
  Vector n, rho, t;
  Real theta2, Omega1, w3_rate;

  RollingState(const SpinningDisk& d, const State& y)
      : theta1(y[1]), Omega(y[2]), w3(y[3]), sine(std::sin(y[0])), cosine(std::cos(y[0])) {
    const Vector h(std::cos(y[4]), std::sin(y[4]), 0), z(0, 0, 1);
    n = sine * h + cosine * z;
    rho = -cosine * h + sine * z;
    t = Vector(-h.y(), h.x(), 0);
    const Real r = d.radius, m = d.mass, A = m * r * r / 4, C = 2 * A, mr2 = m * r * r;
    w3_rate = mr2 * Omega * theta1 * sine / (C + mr2);
    Omega1 = (C * w3 - 2 * A * Omega * cosine) * theta1 / (A * sine);
    theta2 =
        (A * Omega * Omega * sine * cosine - (C + mr2) * Omega * w3 * sine - m * d.gravity * r * cosine) /
        (A + mr2);
  }
  [[nodiscard]] Vector velocity(Real r) const { return r * (theta1 * n - w3 * t); }
  [[nodiscard]] Vector acceleration(Real r) const {
    return r * ((theta2 + Omega * w3 * sine) * n - (theta1 * theta1 + Omega * w3 * cosine) * rho +
                (Omega * theta1 * sine - w3_rate) * t);
  }
};

}  // namespace

SpinningDiskScene SpinningDisk::scene() const {
  const double s = std::sin(lean), c = std::cos(lean);
  const Vec<3> n(s, 0.0, c), rho(-c, 0.0, s), t = Vec<3>::UnitY();
  Scene<3> scene("spinning-disk");
  scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  const double across = mass * radius * radius / 4.0;
  const Lamina disk = add_lamina(scene,
                                 {.mass = mass,
                                  .inertia = {across, across},
                                  .centre = {0.0, 0.0, radius * s},
                                  .axes = Mat<3, 3>(t, rho, n),
                                  .velocity = radius * (lean_rate * n - spin * t),
                                  .angular_velocity = spin * n + precession * s * rho + lean_rate * t},
                                 "disk");
  const std::array marks = {disk.point({radius, 0.0}), disk.point({0.0, radius})};
  const auto contact = scene.add(DiskContact{disk.centre(), marks[0], marks[1], radius});
  const auto rolling = scene.add(DiskRolling{disk.centre(), marks[0], marks[1], radius});
  return {std::move(scene), disk, marks, contact, rolling};
}

std::vector<Observation<3>> SpinningDisk::reference(std::span<const double> times) const {
  const Real r = radius;
  const auto equations = [&](const State& y, State& y_rate) {
    const RollingState now(*this, y);
    const Vector v = now.velocity(r);
    y_rate = {now.theta1, now.theta2, now.Omega1, now.w3_rate, now.Omega, now.w3 - now.Omega * now.cosine,
              v.x(),      v.y()};
  };
  std::vector<Observation<3>> seen;
  integrate(equations, State{lean, lean_rate, precession, spin, 0, 0, 0, 0}, times, [&](const State& y) {
    const RollingState now(*this, y);
    const Vector centre(y[6], y[7], r * now.sine);
    const Vector mark = centre + r * (std::cos(y[5]) * now.t + std::sin(y[5]) * now.rho);
    const Vector further = centre + r * (std::cos(y[5]) * now.rho - std::sin(y[5]) * now.t);
    const Vector F = Real(mass) * (now.acceleration(r) + Real(gravity) * Vector::UnitZ());
    const Vector h(now.t.y(), -now.t.x(), 0);
    seen.push_back({.positions = {centre.cast<double>(), mark.cast<double>(), further.cast<double>()},
                    .forces = {static_cast<double>(F.z()), static_cast<double>(F.dot(now.t)),
                               static_cast<double>(F.dot(h))}});
  });
  return seen;
}

Observation<3> SpinningDisk::reference(double t) const { return reference(std::array{t}).front(); }

double SpinningDisk::steady_spin() const {
  const double s = std::sin(lean), c = std::cos(lean);
  // C + m r^2 and A in units of m r^2
  return (0.25 * precession * precession * s - gravity / radius) * c / (1.5 * precession * s);
}

double SpinningDisk::frequency_squared() const {
  const double s = std::sin(lean), c = std::cos(lean), p = precession, w = spin;
  constexpr double A = 0.25, C = 0.5;  // as above, in units of m r^2
  const double by_lean = A * p * p * (c * c - s * s) - (C + 1.0) * p * w * c + gravity / radius * s,
               by_precession = 2.0 * A * p * s * c - (C + 1.0) * w * s, by_spin = -(C + 1.0) * p * s;
  return -(by_lean + by_precession * (C * w - 2.0 * A * p * c) / (A * s) + by_spin * p * s / (C + 1.0)) /
         (A + 1.0);
}

Model<3> SpinningDisk::model() const {
  return {.name = "spinning-disk",
          .notes = "mln37",
          .reference = "lean, precession and spin in extended precision, forces by Newton's law",
          .t_end = 5.0,
          .length = radius,
          .force = mass * gravity,
          .energy = mass * gravity * radius,
          .scene =
              [*this] {
                SpinningDiskScene built = scene();
                return Observed<3>{
                    std::move(built.scene),
                    [centre = built.disk.centre(), marks = built.marks, contact = built.contact,
                     rolling = built.rolling](const Sample<3>& sample) {
                      const Vec<2> friction = sample.multiplier(rolling);
                      return Observation<3>{.positions = {sample.position(centre), sample.position(marks[0]),
                                                          sample.position(marks[1])},
                                            .forces = {sample.multiplier(contact), friction[0], friction[1]}};
                    }};
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
