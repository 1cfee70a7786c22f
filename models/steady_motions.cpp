#include "dalembert/models/steady_motions.h"

#include <dalembert/core/linear/dense.h>
#include <dalembert/dalembert.h>
#include <dalembert/models/heavy_top.h>
#include <dalembert/models/spinning_disk.h>
#include <dalembert/models/whipple_bicycle.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

namespace dalembert::models {

namespace {

/// The eigenvalue nearest to one.
std::complex<double> nearest(const NormalModes<3>& modes, std::complex<double> to) {
  std::complex<double> found = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (const auto s = modes.eigenvalue(k); !(std::abs(found - to) <= std::abs(s - to))) found = s;
  return found;
}

/// How fast the fastest mode grows.
double largest_growth(const NormalModes<3>& modes) {
  double growth = 0.0;
  for (std::size_t k = 0; k < modes.size(); ++k) growth = std::max(growth, -modes.damping(k));
  return growth;
}

/// Of a mode with s^2 = -omega2: its frequency, or how it grows.
void add_mode(Rows& rows, const std::string& where, const NormalModes<3>& modes, double omega2) {
  const double root = std::sqrt(std::abs(omega2));
  if (omega2 > 0.0) {
    rows.add("omega " + where, nearest(modes, {0.0, root}).imag(), root);
  } else {
    rows.add("growth " + where, largest_growth(modes), root);
  }
}

/// That none grows.
void add_stable(Rows& rows, const std::string& where, const NormalModes<3>& modes) {
  rows.add("largest growth" + where, largest_growth(modes), 0.0);
}

/// The verdict.
void add_verdict(Rows& rows, const std::string& where, const NormalModes<3>& modes, bool stable) {
  rows.add("stable (1) or not " + where, modes.stability() == Stability::stable ? 1.0 : 0.0,
           stable ? 1.0 : 0.0, 0.0);
}

/// The paper's names, where they are told apart: not at rest.
std::string name_of(std::complex<double> s, double lowest, int speed) {
  if (speed == 0) return "mode";
  if (s.imag() > 0.0) return "weave";
  return s.real() == lowest ? "castering" : "capsize";
}

void bicycle(std::vector<Compared>& all) {
  Rows rows(all, "bicycle");
  for (int v = 0; v <= 10; ++v) {
    const WhippleBicycle p{.speed = static_cast<double>(v)};
    const Scene<3> scene = p.scene().scene;
    const auto modes = normal_modes(scene, steady(scene));
    const Eigen::VectorXcd published = dense::eigenvalues(p.published());
    const std::string where = "at " + std::to_string(v) + " m/s";
    for (const std::complex<double>& s : published) {
      if (s.imag() < 0.0) continue;
      const std::complex<double> found = nearest(modes, s);
      const std::string name = name_of(s, published.real().minCoeff(), v) + ' ' + where;
      rows.add("growth of " + name, found.real(), s.real());
      if (s.imag() > 0.0) rows.add("omega of " + name, found.imag(), s.imag());
    }
    const bool stable = p.weave_speed < v && v < p.capsize_speed;
    add_verdict(rows, where, modes, stable);
  }
}

void rolling(std::vector<Compared>& all) {
  Rows rows(all, "spinning-disk");
  SpinningDisk straight{.lean = std::numbers::pi / 2.0, .precession = 0.0};
  const double critical = std::sqrt(straight.gravity / (3.0 * straight.radius));
  for (const double times : {0.5, 0.99, 1.01, 2.0}) {
    straight.spin = times * critical;
    const Scene<3> scene = straight.scene().scene;
    const auto modes = normal_modes(scene, steady(scene));
    const std::string where = "at " + std::to_string(times).substr(0, 4) + " of the critical spin";
    add_mode(rows, where, modes, straight.frequency_squared());
    if (times > 1.0) add_stable(rows, ' ' + where, modes);
    add_verdict(rows, where, modes, times > 1.0);
  }
  SpinningDisk leaning;
  leaning.spin = leaning.steady_spin();
  const Scene<3> scene = leaning.scene().scene;
  const auto modes = normal_modes(scene, steady(scene));
  add_mode(rows, "leaning", modes, leaning.frequency_squared());
  add_stable(rows, " leaning", modes);
  add_verdict(rows, "leaning", modes, true);
}

void precessing_top(std::vector<Compared>& all) {
  Rows rows(all, "heavy-top");
  HeavyTop top{.lean = 0.5, .spin = 300.0};
  for (const bool fast : {false, true}) {
    const std::string which = fast ? "fast " : "slow ";
    const double p = top.steady_precessions()[fast ? 1 : 0];
    top.precession = 1.03 * p;  // a guess
    const auto built = top.scene();
    const auto axis = [body = built.top](const auto& at) { return Vec<3>(body.axes(at).col(2)); };
    const auto found = steady(built.scene, {.keep = {{"lean", [=](const auto& at) { return axis(at).z(); }},
                                                     {"spin", [axis, body = built.top](const auto& at) {
                                                        return angular_velocity(at, body).dot(axis(at));
                                                      }}}});
    top.precession = p;
    const Vec<3> force = found.sample().multiplier(built.point);
    const double across = (angular_velocity(found.sample(), built.top).cross(axis(found.sample()))).norm();
    rows.add(which + "precession", across / std::sin(top.lean), p);
    rows.add(which + "precession, force across", force.head<2>().norm(),
             top.mass * top.arm * p * p * std::sin(top.lean));
    const auto modes = normal_modes(built.scene, found);
    add_mode(rows, "of nutation, " + which + "precession", modes, top.nutation() * top.nutation());
    add_stable(rows, " in " + which + "precession", modes);
  }
}

void sleeping_top(std::vector<Compared>& all) {
  Rows rows(all, "heavy-top-asleep");
  for (const double times : {0.8, 0.99, 1.01, 1.25, 5.0}) {
    const HeavyTop top{.spin = times * HeavyTop::critical_spin()};
    const Scene<3> scene = top.scene().scene;
    const auto modes = normal_modes(scene, steady(scene));
    const std::string where = "at " + std::to_string(times).substr(0, 4) + " of the critical spin";
    const auto [plus, minus] = top.asleep();
    if (times > 1.0) rows.add("slow omega " + where, nearest(modes, minus).imag(), minus.imag());
    rows.add((times > 1.0 ? "fast omega " : "omega ") + where, nearest(modes, plus).imag(), plus.imag());
    rows.add("growth " + where, largest_growth(modes), std::max(plus.real(), minus.real()));
    add_verdict(rows, where, modes, times > 1.0);
  }
}

void rotor(std::vector<Compared>& all) {
  Rows rows(all, "rotor-in-bearings");
  constexpr double g = 9.81, m = 2.0, A = 0.1, C = 0.15, a = 0.4, n = 50.0;
  const Vec<3> k(1500.0, 3000.0, 5000.0);
  Scene<3> scene("rotor");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto body =
      add_body(scene, {.mass = m, .inertia = {C, A, A}, .angular_velocity = {n, 0.0, 0.0}}, "rotor");
  for (const double x : {-a, a}) {
    scene.add(potential(points(body.point({x, 0.0, 0.0})), [k, x](auto r) {
      const auto d = (r - vec(x, 0.0, 0.0)).eval();
      return 0.5 * (k.x() * d.x() * d.x() + k.y() * d.y() * d.y() + k.z() * d.z() * d.z());
    }));
  }
  const auto found = steady(scene);
  const auto modes = normal_modes(scene, found);
  rows.add("sag", -found.sample().position(body.centre()).z(), m * g / (2.0 * k.z()));
  for (int i = 0; i < 3; ++i) add_mode(rows, std::string("along ") + "xyz"[i], modes, 2.0 * k[i] / m);
  const double b = 2.0 * a * a * A * (k.y() + k.z()) + C * C * n * n, c = 4.0 * a * a * a * a * k.y() * k.z();
  const double root = b + std::sqrt(b * b - 4.0 * A * A * c);
  add_mode(rows, "of backward whirl", modes, 2.0 * c / root);
  add_mode(rows, "of forward whirl", modes, root / (2.0 * A * A));
  add_stable(rows, "", modes);
}

void gyrostat(std::vector<Compared>& all) {
  Rows rows(all, "gyrostat");
  constexpr double p = 2.0, along = 0.1, across = 0.06;
  const Vec<3> carrier(0.94, 1.94, 1.4), J = carrier + Vec<3>(across, across, along);
  for (const double h : {0.0, 2.0}) {
    Scene<3> scene("gyrostat");
    const auto body = add_body(scene, {.mass = 5.0, .inertia = carrier, .angular_velocity = {0.0, 0.0, p}},
                               "carrier"),
               wheel = add_body(scene,
                                {.mass = 1.0,
                                 .inertia = {across, across, along},
                                 .angular_velocity = {0.0, 0.0, p + h / along}},
                                "rotor");
    add_joint(scene, Revolute{body, wheel, Vec<3>::Zero(), Vec<3>::UnitZ()}, "bearing");
    const auto modes = normal_modes(scene, steady(scene));
    const std::string where = h == 0.0 ? "without momentum of the rotor" : "stabilised by the rotor";
    add_mode(rows, where, modes, ((J.z() - J.x()) * p + h) * ((J.z() - J.y()) * p + h) / (J.x() * J.y()));
  }
}

}  // namespace

std::vector<Appending> steady_motions() {
  return {{"bicycle", bicycle},          {"spinning-disk", rolling},
          {"heavy-top", precessing_top}, {"heavy-top-asleep", sleeping_top},
          {"rotor-in-bearings", rotor},  {"gyrostat", gyrostat}};
}

}  // namespace dalembert::models
