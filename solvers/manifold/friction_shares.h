#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Core>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The shares of dry friction that sticks where others constrain the same slip: the motion determines their
/// sum only. With the null space N of MinimumNorm
///
///   lambda = lambda_0 + N z,   max |sigma_i| / (mu_static |N_i|) = min                                (1)
///
/// over what leaves normal forces as they are; what carries nothing has none. So all of it is within its
/// bounds as long as any shares are (limit analysis), and what would begin to slide is at its bound where
/// none is.
class FrictionShares {
 public:
  explicit FrictionShares(const System& system);

  /// Changes lambda, one per row of the system, by columns of N times z.
  void spread(const Eigen::MatrixXd& N, std::span<const char> unique, std::span<double> lambda) const;

 private:
  struct Rough {
    Eigen::Index row, rows, pressing_row;
    double mu_static;
  };
  [[nodiscard]] std::vector<Rough> shared(std::span<const char> unique) const;
  using Forces = Eigen::Map<Eigen::VectorXd>;
  [[nodiscard]] static Eigen::VectorXd bounds(const std::vector<Rough>& of, const Forces& lambda);
  /// Takes from `chosen` what carries nothing, and its friction from lambda; returns what may still change.
  [[nodiscard]] static Eigen::MatrixXd leave_to_others(const Eigen::MatrixXd& N, std::vector<Rough>& chosen,
                                                       Forces lambda);

  std::vector<Rough> all_;  // that stick
};

}  // namespace dalembert
