#pragma once

#include <dalembert/constraints/distance.h>
#include <dalembert/core/scene/scene.h>

#include <string>

namespace dalembert {

/// A rod between two particles of a body: part of how the body is built, and nothing that its user stated.
/// Where constraints are redundant its force does not count (see MinimumNorm).
template <int D>
struct BodyRod : Distance<Particle<D>, Particle<D>> {
  static constexpr bool internal = true;
};

/// The name of a body's particle, counted from 0,
inline std::string particle_of(const std::string& body, int i) { return body + ".p" + std::to_string(i + 1); }
/// and of the rod between two of them.
inline std::string rod_of(const std::string& body, int i, int j) {
  return body + ".rod" + std::to_string(i + 1) + std::to_string(j + 1);
}

/// Throws InvalidScene if one of the names of a body's particles, and of the rods between each two of them,
/// is taken: nothing of the body has been added then.
template <int D>
void require_free_names(const Scene<D>& scene, const std::string& body, int particles) {
  const std::string its = "body \"" + body + "\": its ";
  for (int i = 0; i < particles; ++i) scene.require_free(its + "particle", particle_of(body, i));
  for (int i = 0; i < particles; ++i)
    for (int j = i + 1; j < particles; ++j) scene.require_free(its + "Distance", rod_of(body, i, j));
}

}  // namespace dalembert
