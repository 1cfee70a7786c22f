#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/slip_coupling.h>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A friction at rest: its bounds over the normal force, and the part of the first by which one that has
/// reached it is exceeded an instant later.
struct AtRest {
  SlipRows rows;
  double mu, mu_static;
  bool reached = false;
};

/// Which of several frictions at rest begin to slide, and in which direction. With u' and N of SlipCoupling
///
///   |sigma_i| <= mu_i |N_i|;   u'_i = 0,  or  sigma_i = -mu_i |N_i| u'_i/|u'_i|                        (1)
///
/// For given N and S = S_0 these are the conditions of maximum dissipation (Moreau),
///
///   sigma^T S_0 sigma / 2 + c^T sigma = min,   |sigma_i| <= mu_i |N_i|,                              (2)
///
/// which is convex: u' is unique, and so is what slides, also where sigma is not. N and what S exceeds S_0 by
/// are those of the last solution: of (1) with the modes and directions that (2) found there. Where they do
/// not depend on sigma the first is the last. What slides from mu_static has mu from then on.
struct Onset {
  struct Part {
    bool slides = false;
    Eigen::VectorXd direction{};  ///< of u'
  };
  std::vector<Part> parts;

  /// None where that does not converge.
  [[nodiscard]] static std::optional<Onset> find(const SlipCoupling& coupling, const std::vector<AtRest>& of);
};

}  // namespace dalembert
