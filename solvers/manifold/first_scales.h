#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/options.h>
#include <dalembert/solvers/manifold/start.h>

#include <span>
#include <vector>

/// The scales of a scene (see Scales), from its start.
namespace DALEMBERT_HIDDEN dalembert {

/// F/m, as if there were no constraints.
[[nodiscard]] std::vector<double> forced_acceleration(const System& system, const System::Evaluation& e);

/// Sets the characteristic length of the scene: the box around its points; for a lone particle on a surface
/// or curve the radius of curvature, unless it does not move that far. What is free or on something nearly
/// flat has no length but that of its path, of which the first instant gives a guess. (On a compliant
/// constraint that guess must do: an explicit step would show the vibration of the spring.) It does not lead
/// through a contact. Of a state that no run begins with, t_end is infinite: a radius of curvature is then
/// the length however slow the motion.
void set_length(const System& system, const Instant& at, const System::Evaluation& e, const Options& options,
                double nearest_contact, Scales& scales);

/// The shortest time in which the scene's speeds, forces or accelerations move a coordinate by its unit, or
/// the duration; where there is none of these any time serves.
[[nodiscard]] double time_scale(const System& system, const System::Evaluation& e, const Start& start,
                                double duration);

/// Of the rows in force that hold both, the least length by which a radian moves what is a length: the radius
/// of a wheel, the arm of a hinge. 0 if there is none.
[[nodiscard]] double least_lever(const System& system, const System::Evaluation& e,
                                 const std::vector<char>& is_angle);

}  // namespace dalembert
