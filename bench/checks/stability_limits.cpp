#include "dalembert/bench/checks/stability_limits.h"

#include <dalembert/dalembert.h>
#include <dalembert/models/whipple_bicycle.h>

#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

namespace dalembert::bench {

namespace {

/// The first bifurcation, or flutter, of a branch.
double first_of(const auto& points) {
  return points.empty() ? std::numeric_limits<double>::quiet_NaN() : points.front().parameter;
}

/// Two rotors of unit inertia under -K(p) x - x^3.
Diagram<Equilibrium<2>> follow_linear(const std::function<Eigen::Matrix2d(double)>& stiffness,
                                      const BranchOptions& options) {
  return follow_branches<2>(
      [&](double p) {
        Scene<2> scene("linear");
        const auto a = scene.add_rotor({.inertia = 1.0}), b = scene.add_rotor({.inertia = 1.0});
        const Eigen::Matrix2d K = stiffness(p);
        scene.add(force_law(points(a, b), [K](auto x, auto y, auto, auto) {
          return std::make_tuple(vec(-K(0, 0) * x[0] - K(0, 1) * y[0] - x[0] * x[0] * x[0]),
                                 vec(-K(1, 0) * x[0] - K(1, 1) * y[0] - y[0] * y[0] * y[0]));
        }));
        return Posed<2>{std::move(scene)};
      },
      options);
}

/// Ziegler's column: links and springs of 1, masses 2 and 1, a load along the last link; it flutters from
/// 7/2 - sqrt(2) on.
Diagram<Equilibrium<2>> ziegler() {
  return follow_branches<2>(
      [](double P) {
        Scene<2> scene("Ziegler");
        const auto knee = scene.add_particle({.mass = 2.0, .position = {0.0, 1.0}}),
                   tip = scene.add_particle({.mass = 1.0, .position = {0.0, 2.0}});
        scene.add(Distance{Fixed<2>{}, knee, 1.0});
        scene.add(Distance{knee, tip, 1.0});
        scene.add(potential(points(knee, tip), [](auto a, auto b) {
          const auto first = atan2(a.x(), a.y()), second = atan2(b.x() - a.x(), b.y() - a.y());
          return 0.5 * (first * first + (second - first) * (second - first));
        }));
        scene.add(force_law(points(knee, tip), [P](auto a, auto b, auto, auto) {
          const auto along = ((b - a) / (b - a).norm()).eval();
          return std::make_tuple((0.0 * along).eval(), (-P * along).eval());
        }));
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.5, .to = 3.0});
}

/// A mass on two bars from (+-1, 0), at rest at (0, 3): it moves sideways at l^3 - l0 l^2 + l0 = 0, l < l0.
Diagram<Equilibrium<2>> steep_truss(double to) {
  return follow_branches<2>(
      [](double load) {
        Scene<2> scene("truss");
        scene.add(UniformGravity<2>{{0.0, -load}});
        const auto top = scene.add_particle({.mass = 1.0, .position = {0.0, 3.0}});
        for (const double side : {1.0, -1.0})
          scene.add(Spring{Fixed<2>{{side, 0.0}}, top, 100.0, std::sqrt(10.0)});
        return Posed<2>{std::move(scene)};
      },
      {.from = 0.0, .to = to});
}

/// Beck's column of n links: length, stiffness EI and mass 1, springs between the links of EI/h for h = 1/n,
/// and 2 EI/h at the wall, where half a link bends; masses h at the knees, h/2 at the tip. With a tip load
/// along the last link these are the central differences of the column's equation.
double beck(int links) {
  const double h = 1.0 / links;
  const auto found = follow_branches<2>(
      [&](double P) {
        Scene<2> scene("Beck");
        std::vector<Particle<2>> knees;
        for (int i = 1; i <= links; ++i)
          knees.push_back(scene.add_particle({.mass = i < links ? h : h / 2.0, .position = {i * h, 0.0}}));
        const auto bend = [](const auto& a, const auto& b, double stiffness) {
          const auto turn = atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
          return 0.5 * stiffness * turn * turn;
        };
        scene.add(Distance{Fixed<2>{}, knees[0], h});
        scene.add(potential(points(knees[0]), [=](auto a) { return bend(vec(1.0, 0.0), a, 2.0 / h); }));
        scene.add(potential(points(knees[0], knees[1]),
                            [=](auto a, auto b) { return bend(a, (b - a).eval(), 1.0 / h); }));
        for (std::size_t i = 1; i < knees.size(); ++i) {
          scene.add(Distance{knees[i - 1], knees[i], h});
          if (i + 1 < knees.size())
            scene.add(potential(points(knees[i - 1], knees[i], knees[i + 1]), [=](auto a, auto b, auto c) {
              return bend((b - a).eval(), (c - b).eval(), 1.0 / h);
            }));
        }
        scene.add(force_law(points(knees[knees.size() - 2], knees.back()), [P](auto a, auto b, auto, auto) {
          const auto along = ((b - a) / (b - a).norm()).eval();
          return std::make_tuple((0.0 * along).eval(), (-P * along).eval());
        }));
        return Posed<2>{std::move(scene)};
      },
      {.from = 10.0, .to = 25.0});
  return first_of(found.flutters);
}

/// Its flutter load, extrapolated from 16, 32 and 64 links in powers of h^2; what the last power changed, the
/// error of the one before, is the limit. The column's is the least P for which, in omega,
///
///   P^2 + 2 omega^2 (1 + cosh a cos b) + P omega sinh a sin b = 0,   a^2, b^2 = sqrt(P^2/4 + omega^2) -+ P/2
///
/// has a double root (Beck, Z. angew. Math. Phys. 3, 1952: 20.05).
void becks_column(std::vector<models::Compared>& all) {
  constexpr double load = 20.05095361897376;
  const double p16 = beck(16), p32 = beck(32), p64 = beck(64);
  const double q32 = p32 + (p32 - p16) / 3.0, q64 = p64 + (p64 - p32) / 3.0;
  const double extrapolated = q64 + (q64 - q32) / 15.0;
  all.push_back({"beck", "flutter", extrapolated, load, std::abs(extrapolated - q64) / load});
}

/// The bicycle's weave and capsize speeds, by one call.
void bicycle_speeds(std::vector<models::Compared>& all) {
  const auto diagram = follow_steady<3>(
      [](double v) { return PosedSteady<3>{models::WhippleBicycle{.speed = v}.scene().scene}; },
      {.from = 0.0, .to = 10.0, .step = 0.1});
  constexpr double located = 1e-9;
  all.push_back(
      {"bicycle", "weave speed", first_of(diagram.flutters), models::WhippleBicycle::weave_speed, located});
  all.push_back({"bicycle", "capsize speed", first_of(diagram.bifurcations),
                 models::WhippleBicycle::capsize_speed, located});
}

}  // namespace

void stability_limits(std::vector<models::Compared>& all) {
  constexpr double located = 1e-11;  // singular points are found to some 1e-12
  const auto follower = follow_linear(
      [](double P) {
        return Eigen::Matrix2d{{2.0 - P, P - 1.0}, {-1.0, 1.0}};
      },
      {.from = 0.5, .to = 3.0});
  all.push_back(
      {"follower-load", "bifurcations", static_cast<double>(follower.bifurcations.size()), 0.0, 0.0});
  all.push_back({"follower-load", "flutter", first_of(follower.flutters), 1.0, located});
  const auto sheared = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{2.0, 4.0}, {-2.0, p}};
      },
      {.from = -6.0, .to = 2.0, .step = 0.05});
  all.push_back({"circulatory", "bifurcation", first_of(sheared.bifurcations), -4.0, located});
  all.push_back({"circulatory", "bifurcations", static_cast<double>(sheared.bifurcations.size()), 1.0, 0.0});
  const auto exchange = follow_linear(
      [](double p) {
        return Eigen::Matrix2d{{p - 1.0, 0.0}, {0.0, 1.0 - p}};
      },
      {.from = 0.0, .to = 2.2});
  all.push_back({"exchange", "bifurcation", first_of(exchange.bifurcations), 1.0, located});
  const double l0 = std::sqrt(10.0);
  double l = l0;
  for (int i = 0; i < 60; ++i) l -= (l * l * l - l0 * l * l + l0) / (3.0 * l * l - 2.0 * l0 * l);
  const double load = 200.0 * std::sqrt(l * l - 1.0) * (l0 / l - 1.0);
  all.push_back({"truss", "bifurcation", first_of(steep_truss(1.3 * load).bifurcations), load, located});
  all.push_back({"ziegler", "flutter", first_of(ziegler().flutters), 3.5 - std::sqrt(2.0), located});
  becks_column(all);
  bicycle_speeds(all);
}

}  // namespace dalembert::bench
