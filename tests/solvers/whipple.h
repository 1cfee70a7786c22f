#pragma once

#include <dalembert/dalembert.h>

#include <Eigen/Core>

#include <cmath>
#include <numbers>

namespace dalembert {

/// The benchmark bicycle of Meijaard, Papadopoulos, Ruina, Schwab, Proc. R. Soc. A 463 (2007) 1955, table 1,
/// upright, with its wheels as they roll. (There z is down: products of inertia change their sign.)
inline Scene<3> whipple(double v) {
  constexpr double g = 9.81, base = 1.02, trail = 0.08, tilt = std::numbers::pi / 10.0, rear_radius = 0.3,
                   front_radius = 0.35;
  Scene<3> scene("bicycle");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto wheel = [&](double x, double mass, double across, double about, double r, const char* name) {
    const auto body = add_body(scene,
                               {.mass = mass,
                                .inertia = {across, about, across},
                                .centre = {x, 0.0, r},
                                .velocity = {v, 0.0, 0.0},
                                .angular_velocity = {0.0, v / r, 0.0}},
                               name);
    const auto a = body.point({r, 0.0, 0.0}), b = body.point({0.0, 0.0, r});
    scene.add(DiskContact{body.centre(), a, b, r});
    scene.add(DiskRolling{body.centre(), a, b, r});
    return body;
  };
  const auto part = [&](double mass, double x, double z, const Eigen::Matrix2d& I, double about_y,
                        const char* name) {
    const double angle = 0.5 * std::atan2(2.0 * I(0, 1), I(0, 0) - I(1, 1));
    Eigen::Matrix2d turned;
    turned << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const Eigen::Matrix2d principal = turned.transpose() * I * turned;
    Eigen::Matrix3d axes;
    axes << turned(0, 0), 0.0, turned(0, 1), 0.0, 1.0, 0.0, turned(1, 0), 0.0, turned(1, 1);
    return add_body(scene,
                    {.mass = mass,
                     .inertia = {principal(0, 0), about_y, principal(1, 1)},
                     .centre = {x, 0.0, z},
                     .axes = axes,
                     .velocity = {v, 0.0, 0.0}},
                    name);
  };
  const auto rear = wheel(0.0, 2.0, 0.0603, 0.12, rear_radius, "rear"),
             front = wheel(base, 3.0, 0.1405, 0.28, front_radius, "front");
  Eigen::Matrix2d of_frame, of_fork;
  of_frame << 9.2, -2.4, -2.4, 2.8;
  of_fork << 0.05892, 0.00756, 0.00756, 0.00708;
  const auto frame = part(85.0, 0.3, 0.9, of_frame, 11.0, "frame"),
             fork = part(4.0, 0.9, 0.7, of_fork, 0.06, "fork");
  const Vec<3> across(0.0, 1.0, 0.0), head(-std::sin(tilt), 0.0, std::cos(tilt));
  add_joint(scene, Revolute{frame, rear, {0.0, 0.0, rear_radius}, across}, "rear hub");
  add_joint(scene, Revolute{fork, front, {base, 0.0, front_radius}, across}, "front hub");
  add_joint(scene, Revolute{frame, fork, Vec<3>(base + trail, 0.0, 0.0) + head * (0.9 / head.z()), head},
            "head");
  return scene;
}

}  // namespace dalembert
