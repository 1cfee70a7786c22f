#pragma once

#include <dalembert/constraints/distance.h>

namespace dalembert {

/// A rod between two particles of a body: part of how the body is built, and nothing that its user stated.
/// Where constraints are redundant its force does not count (see MinimumNorm).
template <int D>
struct BodyRod : Distance<Particle<D>, Particle<D>> {
  static constexpr bool internal = true;
};

}  // namespace dalembert
