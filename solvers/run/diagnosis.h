#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/start.h>

#include <span>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

// For the message of a run that stopped; empty if there is nothing to report.

/// The constraint whose force far exceeds what the scene's masses, speed and time explain, and has grown as
/// much since the start, with its multiplier and its hint on singularity.
[[nodiscard]] std::string unbounded_multiplier(const System& system, const Scales& scales,
                                               std::span<const double> w, std::span<const double> lambda,
                                               std::span<const double> lambda_at_start);

/// The force that far exceeds what the scene's masses, speed and time explain, and where it does; else the
/// equation whose gradient turns around within far less than the scene's length: a centre of force, the apex
/// of a cone. Both are singular at that place, or nearly so.
[[nodiscard]] std::string singular_here(const System& system, const Scales& scales, const Instant& at);

/// The force that drives a coordinate back by a jump on both sides of where its velocity comes to in a step
/// of this length: dry friction whose comparisons are not seen.
[[nodiscard]] std::string chattering_force(const System& system, const Scales& scales, const Instant& at,
                                           double step, double tolerance);

/// The force that jumps from driving a coordinate forward to driving it backward at a position no farther
/// away than this, its label: there is no balance between both.
[[nodiscard]] std::string force_that_jumps(const System& system, const Instant& at, std::size_t coordinate,
                                           double distance);

/// That times so far from 0 are too coarse for the scene.
[[nodiscard]] std::string coarse_time(const Scales& scales, double time);
/// That the errors of steps add up to a part of the scene's length that leaves nothing of a result.
[[nodiscard]] std::string coarse_steps(double accuracy);
/// Whether times there tell the scene's own time from 0.
[[nodiscard]] bool resolves_motion(const Scales& scales, double time);

}  // namespace dalembert
