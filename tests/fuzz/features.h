#pragma once

#include <array>

namespace dalembert::fuzz {

/// What the scenes of the family `products` draw from, and how they are run.
enum class Feature {
  holonomic,
  nonholonomic,
  compliant,
  redundant,
  driven,
  joint,
  one_sided,
  rough,
  friction_law,
  kink,
  force,
  change,   ///< an event that releases a constraint or states a force anew
  restart,  ///< from a sample in the middle
  stepwise,
  dense,
  ida,
  erk,
  loose,  ///< a tolerance above 1e-6
  tight   ///< below 1e-9
};
inline constexpr std::array features{
    Feature::holonomic, Feature::nonholonomic, Feature::compliant, Feature::redundant,    Feature::driven,
    Feature::joint,     Feature::one_sided,    Feature::rough,     Feature::friction_law, Feature::kink,
    Feature::force,     Feature::change,       Feature::restart,   Feature::stepwise,     Feature::dense,
    Feature::ida,       Feature::erk,          Feature::loose,     Feature::tight};
/// Those that are drawn; the others follow from the options.
inline constexpr int drawn_features = 15;

[[nodiscard]] const char* name(Feature feature);

}  // namespace dalembert::fuzz
