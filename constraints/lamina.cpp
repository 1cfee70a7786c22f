#include "dalembert/constraints/lamina.h"

#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace dalembert {

namespace {

/// (cos u, sin u) of the three particles; columns.
Eigen::Matrix<double, 2, 3> corners() {
  constexpr double half_sqrt3 = 0.5 * std::numbers::sqrt3;
  Eigen::Matrix<double, 2, 3> c;
  c << 1.0, -0.5, -0.5,  //
      0.0, half_sqrt3, -half_sqrt3;
  return c;
}

void check(const LaminaState& s, const std::string& name) {
  const auto require = [&name](bool good, const char* what) {
    if (!good) throw InvalidScene("Lamina \"" + name + "\": " + what);
  };
  constexpr double rounding_of_the_user = 1e-8;
  require(std::isfinite(s.mass) && s.mass > 0.0, "mass must be finite and > 0");
  require(s.inertia.allFinite() && s.inertia.minCoeff() > 0.0,
          "each moment of inertia in the plane must be finite and > 0; a thin rod is a ThinRod");
  require((s.axes.transpose() * s.axes - Eigen::Matrix3d::Identity()).norm() < rounding_of_the_user &&
              s.axes.determinant() > 0.0,
          "axes must be right-handed and of unit length");
}

}  // namespace

BodyPoint<3, 3> Lamina::point(const Vec<2>& local) const {
  // sum of w_i p_i with sum of w_i = 1, w_i = (1 + sqrt 2 corner_i . local/arms)/3
  const Vec<2> relative = std::numbers::sqrt2 * local.cwiseQuotient(arms);
  const auto c = corners();
  BodyPoint<3, 3> p{particles, {}};
  for (int i = 0; i < 3; ++i) {
    p.L.middleCols<3>(3 * i) = (1.0 + c.col(i).dot(relative)) / 3.0 * Eigen::Matrix3d::Identity();
  }
  return p;
}

Lamina add_lamina(Scene<3>& scene, const LaminaState& s, const std::string& name) {
  check(s, name);
  Lamina lamina{.particles = {},
                .rods = {},
                .arms = {std::sqrt(s.inertia.y() / s.mass), std::sqrt(s.inertia.x() / s.mass)}};
  const auto c = corners();
  std::array<Vec<3>, 3> arm;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec<2> local = std::numbers::sqrt2 * c.col(static_cast<int>(i)).cwiseProduct(lamina.arms);
    arm[i] = s.axes.leftCols<2>() * local;
    lamina.particles[i] = scene.add_particle({.mass = s.mass / 3.0,
                                              .position = s.centre + arm[i],
                                              .velocity = s.velocity + s.angular_velocity.cross(arm[i])},
                                             name + ".p" + std::to_string(i + 1));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    lamina.rods[i] =
        scene.add(BodyRod<3>{{lamina.particles[i], lamina.particles[j], (arm[j] - arm[i]).norm()}},
                  name + ".rod" + std::to_string(i + 1) + std::to_string(j + 1));
  }
  return lamina;
}

}  // namespace dalembert
