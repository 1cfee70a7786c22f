#include "dalembert/models/bead_on_rough_hoop.h"

#include <dalembert/models/event_times.h>
#include <dalembert/models/numbered.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace dalembert::models {

BeadOnRoughHoop::Built BeadOnRoughHoop::scene() const {
  Scene<2> scene("bead-on-rough-hoop");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const auto bead = scene.add_particle(
      {.mass = mass, .position = radius * Vec<2>(std::sin(angle), -std::cos(angle))}, "bead");
  const Sphere<2> hoop{.radius = radius};
  const auto wire = scene.add(OnCurve{bead, hoop}, "wire");
  const auto rough = scene.add(coulomb(wire, Slip{bead, hoop}, friction, sticking), "rough");
  return {.scene = std::move(scene), .bead = bead, .wire = wire, .rough = rough};
}

double BeadOnRoughHoop::gained(double sign, double from, double square, double e) const {
  const double G = gravity / radius, M = 2.0 * friction * sign, over = G / (1.0 + M * M);
  const double A = (2.0 - M * M) * over, B = -3.0 * M * over;
  const double C = square - A * std::cos(from) - B * std::sin(from);
  return 2.0 * std::sin(0.5 * e) * (B * std::cos(from + 0.5 * e) - A * std::sin(from + 0.5 * e)) +
         C * std::expm1(-M * e);
}

BeadOnRoughHoop::Part BeadOnRoughHoop::part(double sign, double from, double square) const {
  // Short against what the last swing goes, 2 (mu_static - mu).
  const double step = 0.1 * (sticking - friction), none = std::numeric_limits<double>::epsilon();
  const auto y = [&](double e) { return square + gained(sign, from, square, e); };
  const auto force = [&](double e) { return sign * (y(e) + gravity / radius * std::cos(from + e)); };
  const auto root = [&](const auto& function, double e) {
    std::uintmax_t most = 100;
    const auto ends = boost::math::tools::toms748_solve(
        function, e - step, e, [=](double a, double b) { return std::abs(b - a) <= none * (1.0 + e); }, most);
    return 0.5 * (ends.first + ends.second);
  };
  // The force turns before the bead comes to rest above the centre.
  for (double e = step;; e += step) {
    if (force(e) < 0.0) {
      const double turn = root(force, e);
      return {sign, from, square, from + turn, y(turn)};
    }
    if (y(e) < 0.0) return {sign, from, square, from + root(y, e), 0.0};
  }
}

double BeadOnRoughHoop::time(const Part& part) const {
  boost::math::quadrature::tanh_sinh<double> integrator;
  return integrator.integrate(
      [&](double, double left) {  // to the nearer end: below 0 from the first
        const bool at_first = left < 0.0;
        const double from = at_first ? part.from : part.to, square = at_first ? part.square : part.square_to;
        return 1.0 / std::sqrt(square + gained(part.sign, from, square, -left));
      },
      part.from, part.to);
}

std::vector<BeadOnRoughHoop::Turn> BeadOnRoughHoop::turns() const {
  std::vector<Turn> all;
  double from = -angle, now = 0.0, side = -1.0;
  do {
    Part swing = part(std::cos(from) < 0.0 ? -1.0 : 1.0, from, 0.0);
    now += time(swing);
    while (swing.square_to > 0.0) {
      swing = part(-swing.sign, swing.to, swing.square_to);
      now += time(swing);
    }
    const double slope = std::abs(std::tan(swing.to));
    all.push_back({side * swing.to, now, std::abs(swing.to) < std::numbers::pi / 2.0 && slope <= sticking});
    from = -swing.to;
    side = -side;
  } while (!all.back().sticks);
  return all;
}

EventModel BeadOnRoughHoop::event_model() const {
  return {.name = "bead-on-rough-hoop", .notes = "", .events = [*this](const EventRun& how) {
            const Built built = scene();
            const auto theory = turns();
            const auto run = how.run(built.scene, {.t_end = 1.1 * theory.back().time, .samples = 2});
            std::vector<Timed> all;
            for (std::size_t k = 0; k < theory.size(); ++k) {
              const auto what = theory[k].sticks ? EventKind::sticks : EventKind::slides;
              all.push_back({theory[k].sticks ? "sticks" : numbered("turns ", k + 1),
                             time_of(run, built.rough, what, theory[k].sticks ? 0 : static_cast<int>(k)),
                             theory[k].time, time_limit(how.tolerance)});
            }
            return all;
          }};
}

}  // namespace dalembert::models
