#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/slip_coupling.h>

#include <Eigen/Core>

#include <optional>

namespace DALEMBERT_HIDDEN dalembert {

/// The end of a slip in space, u = rho d, so slow that forces and places no longer change in the time left:
///
///   u' = w(d) = c + S sigma,   sigma = -mu |N_0 + B sigma| d,                                        (1)
///   d(log rho)/ds = w . d,   d(theta)/ds = w . d_perp,   dt/ds = rho,                                (2)
///
/// the direction theta turning ever faster in t as rho -> 0, but not in s. Until rho is at most `least` it
/// takes the time returned; none if the slip passes rest by.
[[nodiscard]] std::optional<double> time_to_rest(const SlipCoupling& its, double mu, const Eigen::Vector2d& u,
                                                 double least);
/// The same if it keeps its direction.
[[nodiscard]] double time_to_rest_ahead(const SlipCoupling& its, double mu, const Eigen::Vector2d& u);

}  // namespace dalembert
