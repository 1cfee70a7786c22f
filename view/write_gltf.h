#pragma once

#include <dalembert/core/results/trajectory.h>

#include <filesystem>

namespace dalembert {

namespace detail {
void write_gltf(const Record& run, const std::filesystem::path& path);
}

/// Writes a run as an animation for Blender, slides and other programs: glTF 2.0 in its binary form, .glb.
/// Particles are spheres; bodies the uniform boxes of their mass and inertia; rods, springs, strings, dampers
/// and a user's own equations of several points cylinders between their points. Curves, surfaces and forces
/// are not in it: see write_html. Times count from the start of the run, lengths are in the scene's own unit;
/// the z axis of a scene in space, and y of one in the plane, is glTF's upward y.
///
/// Numbers are single precision. A sample whose time single precision does not tell from the one before is
/// left out. Throws InvalidArgument for a run without samples or with another ending than .glb, Error if the
/// file cannot be written.
template <int D>
void write_gltf(const Trajectory<D>& run, const std::filesystem::path& path) {
  detail::write_gltf(*run.record(), path);
}

}  // namespace dalembert
