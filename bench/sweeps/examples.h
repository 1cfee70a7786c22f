#pragma once

#include <dalembert/sweep/sweep.h>

#include <cstddef>
#include <string>

namespace dalembert::bench {

/// A sweep of the benchmark: what its rows are and what they give. The run time of each is that of its rows.
struct Example {
  Parameters parameters;
  RowFunction row;
};

/// Plane pendulums from rest at angles between 0.1 and 3, a second each at tolerance 1e-8 by `erk`: the
/// largest tension and where the bob ends. Every `bad`-th row fails in mid-run; 0: none.
[[nodiscard]] Example pendulums(std::size_t rows, std::size_t bad);

/// Double pendulums from rest at all pairs of angles: when the first of the rods turns over its top, in units
/// of sqrt(l/g), or infinity if none does until 50. Where 3 cos(angle1) + cos(angle2) > 2 energy forbids it.
[[nodiscard]] Example flips(std::size_t points);

/// The pendulum upright on a shaken pivot (Kapitza), 0.001 rad off, over amplitude/l and g/(l omega^2): the
/// periods of the drive after which it is 0.1 off, or infinity if it is not within 100. (Not when it falls:
/// past the lower boundary its swing grows to a period of two and stays there.)
[[nodiscard]] Example kapitza(std::size_t points);
/// Where its linear motion is stable, by `floquet`: for each amplitude the lowest and the highest
/// g/(l omega^2), -1 where it is stable nowhere.
[[nodiscard]] Example kapitza_boundary(std::size_t points);

/// A governor made within tolerances: two masses (0.5 %) and four rods (0.2 %) of their own. The largest
/// horizontal force on the axis in a second; 0 if it were made exactly.
[[nodiscard]] Example governors(std::size_t rows, std::uint64_t seed);

}  // namespace dalembert::bench
