#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/view/json.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A surface of triangles, with the normals of its corners.
struct Solid {
  std::vector<Eigen::Vector3f> corners{}, normals{};
  std::vector<std::uint16_t> triangles{};  ///< three corners each, counterclockwise from outside
};

/// Of radius 1; along z from -1/2 to 1/2 with radius 1; with edges of length 2. All about the origin.
[[nodiscard]] Solid unit_sphere();
[[nodiscard]] Solid unit_cylinder();
[[nodiscard]] Solid unit_cube();

/// A solid that moves: where it is, how it is turned and how large, at every time.
struct MovingSolid {
  std::string name;
  std::size_t solid;  ///< its number
  std::vector<Eigen::Vector3d> place{};
  std::vector<Eigen::Quaterniond> turned{};  ///< none: never
  std::vector<Eigen::Vector3d> size{};
};

/// What an animation shows.
struct Animation {
  std::string name;
  std::vector<float> times{};  ///< increasing, not negative
  std::vector<Solid> solids{};
  std::vector<Eigen::Vector3f> colours{};  ///< of each
  std::vector<MovingSolid> moving{};
  Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();  ///< all of it, to have y upwards
};

/// Writes it as glTF 2.0 in the binary form (Khronos, glTF 2.0 specification, section 4).
void write_glb(std::ostream& out, const Animation& animation);

}  // namespace dalembert
