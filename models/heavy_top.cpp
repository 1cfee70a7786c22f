#include "dalembert/models/heavy_top.h"

#include <cmath>
#include <utility>

namespace dalembert::models {

HeavyTopScene HeavyTop::scene() const {
  Scene<3> scene("heavy-top");
  scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  const Vec<3> axis(std::sin(lean), 0.0, std::cos(lean)), y = Vec<3>::UnitY(), x = y.cross(axis);
  const Vec<3> rate = spin * axis - precession * std::sin(lean) * x, centre = arm * axis;
  const double central = across - mass * arm * arm;
  const auto top = add_body(scene,
                            {.mass = mass,
                             .inertia = {central, central, along},
                             .centre = centre,
                             .axes = Mat<3, 3>(x, y, axis),
                             .velocity = rate.cross(centre),
                             .angular_velocity = rate},
                            "top");
  const auto point = scene.add(Coincident{Fixed<3>{}, top.point({0.0, 0.0, -arm})}, "point");
  return {std::move(scene), top, point};
}

double HeavyTop::critical_spin() { return std::sqrt(4.0 * across * mass * gravity * arm) / along; }

std::array<std::complex<double>, 2> HeavyTop::asleep() const {
  const double momentum = along * spin, critical = along * critical_spin();
  const std::complex<double> root =
                                 std::sqrt(std::complex<double>(momentum * momentum - critical * critical)),
                             i(0.0, 1.0);
  return {i * (momentum + root) / (2.0 * across), i * (momentum - root) / (2.0 * across)};
}

std::array<double, 2> HeavyTop::steady_precessions() const {
  const double c = std::cos(lean), weight = mass * gravity * arm, momentum = along * spin;
  const double sum = momentum + std::sqrt(momentum * momentum - 4.0 * across * c * weight);
  return {2.0 * weight / sum, sum / (2.0 * across * c)};
}

double HeavyTop::nutation() const {
  const double c = std::cos(lean), p = precession, h = along * spin / across;
  return std::sqrt(h * h - 4.0 * p * h * c + p * p * (1.0 + 3.0 * c * c));
}

}  // namespace dalembert::models
