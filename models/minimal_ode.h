#pragma once

#include <functional>
#include <span>
#include <vector>

namespace dalembert::models {

/// References are computed in extended precision (64 bits of mantissa where the machine has them).
using Real = long double;

/// Minimal coordinates and their rates.
using State = std::vector<Real>;

/// Writes y' for y into a vector of the same size.
using Equations = std::function<void(const State& y, State& y_rate)>;

/// Error allowed to one step of a reference, relative to each component and its change in the step:
/// 100 times the round-off of Real, 1/10 of that of double. Over the thousands of steps of a
/// reference, and amplified tenfold by its motion, it stays below 1e-13 in the result.
inline constexpr Real reference_tolerance = 1e-17L;

/// Integrates y' = f(y) from y(0) = `start` once through increasing times >= 0, calling `observe(y)`
/// at each, by Boost.odeint's Runge-Kutta-Fehlberg 7(8) with step control.
void integrate(const Equations& equations, State start, std::span<const double> times,
               const std::function<void(const State& y)>& observe, Real tolerance = reference_tolerance);

}  // namespace dalembert::models
