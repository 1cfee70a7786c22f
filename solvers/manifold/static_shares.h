#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Core>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A force that dependent constraints share under Coulomb's law: normal forces push, friction that sticks is
/// within its bound. Rows of lambda; no friction if `rows` is 0.
struct SharedContact {
  Eigen::Index pressing_row, row = 0, rows = 0;
  double sign = 1.0;  // of the multiplier that pushes; 0: either, and the motion does not determine which
  double mu = 0.0;    // of rest
};

/// Static forces of dependent constraints where those of least norm are beyond what friction can bear: with
/// columns N that change no motion, S_i what pushes and T_i its friction, and d_i > 0,
///
///   lambda = lambda_0 + N z,   |T_i| <= mu_i S_i - m d_i,   m = max                                    (1)
///
/// Static forces exist as long as m > 0 (limit analysis). With z* of (1) and rho the largest |T_i| / mu_i
/// S_i, this goes on from lambda_0 towards z* until rho is no more than the mean of rho(z*) and 1: shares are
/// those of least norm where these are far from their bounds, vary continuously, and reach a bound where
/// m = 0, at the time when something begins to slide.
///
/// What holds both ways presses with either sign, and (1) is one program for each choice of these. It is
/// first that of lambda_0; where that leaves rho(z*) above 1/2, those signs are changed, one by one, that
/// make it smaller: shares jump there, before anything reaches a bound that it need not.
///
/// Where contacts can be wedged, pressing each other without a load, (1) would hold up whatever touches them:
/// there those that carry nothing in lambda_0 stay without a force.
void share_statically(const Eigen::MatrixXd& N, const std::vector<SharedContact>& contacts,
                      Eigen::Ref<Eigen::VectorXd> lambda);

}  // namespace dalembert
