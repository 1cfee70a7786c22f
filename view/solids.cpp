#include <dalembert/view/glb.h>

#include <array>
#include <cmath>
#include <numbers>

namespace dalembert {

namespace {

constexpr int around = 20, along = 10;  // of a sphere; a cylinder has as many sides

void add_corner(Solid& solid, const Eigen::Vector3f& at, const Eigen::Vector3f& normal) {
  solid.corners.push_back(at);
  solid.normals.push_back(normal);
}

/// A grid of corners, row after row, with `around` + 1 in each.
void add_grid(Solid& solid, int rows, int first) {
  const auto corner = [first](int row, int k) {
    return static_cast<std::uint16_t>(first + row * (around + 1) + k);
  };
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k < around; ++k)
      for (const std::uint16_t c : {corner(row, k), corner(row, k + 1), corner(row + 1, k + 1),
                                    corner(row, k), corner(row + 1, k + 1), corner(row + 1, k)})
        solid.triangles.push_back(c);
  }
}

Eigen::Vector3f on_circle(int k) {
  const double angle = 2.0 * std::numbers::pi * k / around;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F};
}

}  // namespace

Solid unit_sphere() {
  Solid solid;
  for (int row = 0; row <= along; ++row) {
    const double latitude = std::numbers::pi * (static_cast<double>(row) / along - 0.5);
    const auto r = static_cast<float>(std::cos(latitude)), z = static_cast<float>(std::sin(latitude));
    for (int k = 0; k <= around; ++k) {
      const Eigen::Vector3f at = r * on_circle(k) + Eigen::Vector3f(0.0F, 0.0F, z);
      add_corner(solid, at, at.normalized());
    }
  }
  add_grid(solid, along, 0);
  return solid;
}

Solid unit_cylinder() {
  Solid solid;
  for (const float z : {-0.5F, 0.5F})
    for (int k = 0; k <= around; ++k)
      add_corner(solid, on_circle(k) + Eigen::Vector3f(0.0F, 0.0F, z), on_circle(k));
  add_grid(solid, 1, 0);
  for (const float z : {-0.5F, 0.5F}) {  // its ends
    const auto centre = static_cast<std::uint16_t>(solid.corners.size());
    const Eigen::Vector3f normal(0.0F, 0.0F, 2.0F * z);
    add_corner(solid, 0.5F * normal, normal);
    for (int k = 0; k <= around; ++k) add_corner(solid, on_circle(k) + 0.5F * normal, normal);
    for (int k = 0; k < around; ++k) {
      const auto a = static_cast<std::uint16_t>(centre + 1 + k), b = static_cast<std::uint16_t>(a + 1);
      for (const std::uint16_t c : {centre, z > 0.0F ? a : b, z > 0.0F ? b : a}) solid.triangles.push_back(c);
    }
  }
  return solid;
}

Solid unit_cube() {
  Solid solid;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const Eigen::Vector3f n = side * Eigen::Vector3f::Unit(axis), u = Eigen::Vector3f::Unit((axis + 1) % 3),
                            v = n.cross(u);
      const auto first = static_cast<std::uint16_t>(solid.corners.size());
      for (const auto& [a, b] : std::array<std::array<float, 2>, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}})
        add_corner(solid, n + a * u + b * v, n);
      for (const int k : {0, 1, 2, 0, 2, 3}) solid.triangles.push_back(static_cast<std::uint16_t>(first + k));
    }
  }
  return solid;
}

}  // namespace dalembert
