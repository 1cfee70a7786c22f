#include "dalembert/models/whipple_bicycle.h"

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <string>

namespace dalembert::models {

namespace {

constexpr double wheel_base = 1.02, trail = 0.08, tilt = std::numbers::pi / 10.0;

/// Adds the parts of a bicycle, upright and in motion as a whole.
class Builder {
 public:
  Builder(Scene<3>& scene, const WhippleBicycle& bicycle) : scene_(scene), bicycle_(bicycle) {}

  /// A wheel that rolls, with moments of inertia across and about its axle.
  RigidBody<3> wheel(double x, double mass, double across, double about, double radius,
                     const std::string& name) {
    const auto body = add_body(scene_,
                               {.mass = mass,
                                .inertia = {across, about, across},
                                .centre = {x, 0.0, radius},
                                .velocity = velocity(radius),
                                .angular_velocity = {bicycle_.lean_rate, bicycle_.speed / radius, 0.0}},
                               name);
    const auto a = body.point({radius, 0.0, 0.0}), b = body.point({0.0, 0.0, radius});
    scene_.add(DiskContact{body.centre(), a, b, radius});
    scene_.add(DiskRolling{body.centre(), a, b, radius});
    return body;
  }

  /// A part with the inertia `in_plane` about x and z, and `across` about y.
  RigidBody<3> part(double mass, double x, double z, const Eigen::Matrix2d& in_plane, double across,
                    const std::string& name) {
    const double angle = 0.5 * std::atan2(2.0 * in_plane(0, 1), in_plane(0, 0) - in_plane(1, 1));
    const double c = std::cos(angle), s = std::sin(angle);
    const Eigen::Matrix2d turned{{c, -s}, {s, c}}, principal = turned.transpose() * in_plane * turned;
    return add_body(scene_,
                    {.mass = mass,
                     .inertia = {principal(0, 0), across, principal(1, 1)},
                     .centre = {x, 0.0, z},
                     .axes = Eigen::Matrix3d{{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}},
                     .velocity = velocity(z),
                     .angular_velocity = {bicycle_.lean_rate, 0.0, 0.0}},
                    name);
  }

 private:
  [[nodiscard]] Vec<3> velocity(double z) const { return {bicycle_.speed, -bicycle_.lean_rate * z, 0.0}; }

  Scene<3>& scene_;
  const WhippleBicycle& bicycle_;
};

}  // namespace

double WhippleScene::lean(const Sample<3>& at) const { return std::asin(frame.axes(at).col(1).z()); }
double WhippleScene::steer(const Sample<3>& at) const { return -angle(at, head); }

WhippleScene WhippleBicycle::scene() const {
  constexpr double rear_radius = 0.3, front_radius = 0.35;
  Scene<3> scene("bicycle");
  scene.add(UniformGravity<3>{{0.0, 0.0, -gravity}});
  Builder add(scene, *this);
  const auto rear = add.wheel(0.0, 2.0, 0.0603, 0.12, rear_radius, "rear wheel"),
             front = add.wheel(wheel_base, 3.0, 0.1405, 0.28, front_radius, "front wheel");
  const auto frame =
      add.part(85.0, 0.3, 0.9, Eigen::Matrix2d{{9.2, -2.4}, {-2.4, 2.8}}, 11.0, "frame and rider");
  const auto fork =
      add.part(4.0, 0.9, 0.7, Eigen::Matrix2d{{0.05892, 0.00756}, {0.00756, 0.00708}}, 0.06, "fork");
  const Vec<3> across(0.0, 1.0, 0.0), up(-std::sin(tilt), 0.0, std::cos(tilt));
  add_joint(scene, Revolute{frame, rear, {0.0, 0.0, rear_radius}, across}, "rear hub");
  add_joint(scene, Revolute{fork, front, {wheel_base, 0.0, front_radius}, across}, "front hub");
  const Vec<3> on_axis = Vec<3>(wheel_base + trail, 0.0, 0.0) + 0.9 / up.z() * up;
  const auto head = add_joint(scene, Revolute{frame, fork, on_axis, up}, "head");
  return {std::move(scene), frame, head};
}

Eigen::Matrix4d WhippleBicycle::published() const {
  const Eigen::Matrix2d M{{80.81722, 2.31941332208709}, {2.31941332208709, 0.29784188199686}},
      C1{{0.0, 33.86641391492494}, {-0.85035641456978, 1.68540397397560}},
      K0{{-80.95, -2.59951685249872}, {-2.59951685249872, -0.80329488458618}},
      K2{{0.0, 76.59734589573222}, {0.0, 2.65431523794604}};
  const Eigen::Matrix2d inverse = M.inverse();
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A.topRightCorner<2, 2>().setIdentity();
  A.bottomLeftCorner<2, 2>() = -inverse * (gravity * K0 + speed * speed * K2);
  A.bottomRightCorner<2, 2>() = -inverse * (speed * C1);
  return A;
}

}  // namespace dalembert::models
