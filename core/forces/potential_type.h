#pragma once

#include <dalembert/core/forces/force.h>
#include <dalembert/core/forces/potential_batch.h>

namespace dalembert::detail {

template <class E>
inline constexpr bool energy_takes_time = applicable_with_time<EnergyOf<E>, Probe<E>, ProbePositions<E>>;

/// What the potential of a force returns.
template <class E>
using EnergyResult = Result<energy_takes_time<E>, EnergyOf<E>, Probe<E>, ProbePositions<E>>;

template <class E>
inline constexpr PotentialType potential_type{
    .energy = equation_type_of<Equation<E, EnergyOf<E>, energy_takes_time<E>, false,
                                        energy_takes_time<E> || PointFacts<E>::driven, 1>,
                               false>({}),
    .shape = {.kind = kind_of<E>("Potential"),
              .width = PointFacts<E>::coordinates,
              .rows = 0,
              .dissipative = false,
              .conservative = true,
              .timed = energy_takes_time<E> || PointFacts<E>::driven}};

}  // namespace dalembert::detail
