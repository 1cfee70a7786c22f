#include "dalembert/models/bead_on_rough_hoop.h"

#include <dalembert/models/event_times.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <numbers>

namespace dalembert::models {

std::vector<BeadOnRoughHoop::Swing> BeadOnRoughHoop::swings() const {
  const double G = gravity / radius;
  std::vector<Swing> all;
  for (double from = angle, time = 0.0; std::abs(std::tan(from)) > mu_static; from = all.back().angle) {
    const double m = from > 0.0 ? -2.0 * mu : 2.0 * mu;  // it goes towards the lowest point
    const double A = G * (2.0 - m * m) / (1.0 + m * m), B = -3.0 * m * G / (1.0 + m * m);
    const double C = -(A * std::cos(from) + B * std::sin(from));
    const auto y = [=](double theta) {
      return A * std::cos(theta) + B * std::sin(theta) + C * std::exp(-m * (theta - from));
    };
    // Where the slope of what drives it is that of friction y is largest: the end lies beyond.
    const double top = from > 0.0 ? std::atan(mu) : -std::atan(mu);
    std::uintmax_t most = 100;
    const auto bracket = boost::math::tools::toms748_solve(y, std::min(top, -from), std::max(top, -from),
                                                           boost::math::tools::eps_tolerance<double>(), most);
    const double to = 0.5 * (bracket.first + bracket.second);
    // theta = middle + half sin psi takes the roots at both ends out of dtheta/sqrt(y).
    const double middle = 0.5 * (from + to), half = 0.5 * (from - to);
    time += boost::math::quadrature::gauss<double, 40>::integrate(
        [&](double psi) {
          return std::abs(half) * std::cos(psi) / std::sqrt(y(middle + half * std::sin(psi)));
        },
        -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
    all.push_back({to, time});
  }
  return all;
}

EventModel BeadOnRoughHoop::event_model() const {
  return {
      "bead-on-rough-hoop", "-", [model = *this](Stepper stepper, double tolerance) {
        const auto swings = model.swings();
        Scene<2> scene("bead on rough hoop");
        scene.add(UniformGravity<2>{{0.0, -model.gravity}});
        const Vec<2> start(std::sin(model.angle), -std::cos(model.angle));
        const auto bead = scene.add_particle({.mass = 1.0, .position = model.radius * start});
        const Sphere<2> hoop{.radius = model.radius};
        const auto wire = scene.add(OnCurve{bead, hoop});
        const auto rough = scene.add(coulomb(wire, Slip{bead, hoop}, model.mu, model.mu_static));
        const auto run = simulate(
            scene,
            {.t_end = swings.back().time + 1.0, .samples = 2, .tolerance = tolerance, .stepper = stepper});
        std::vector<Timed> all;
        for (std::size_t k = 0; k + 1 < swings.size(); ++k)
          all.push_back({"turns " + std::to_string(k + 1),
                         time_of(run, rough, Happened::slides, static_cast<int>(k)), swings[k].time,
                         time_limit(tolerance)});
        all.push_back(
            {"sticks", time_of(run, rough, Happened::sticks), swings.back().time, time_limit(tolerance)});
        return all;
      }};
}

}  // namespace dalembert::models
