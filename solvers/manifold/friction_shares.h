#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/static_shares.h>

#include <Eigen/Core>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The shares of dry friction that sticks where others constrain the same slip: the motion determines their
/// sum only. With the null space N of MinimumNorm
///
///   lambda = lambda_0 + N z,   max |sigma_i| / (mu_static |N_i|) = min                                (1)
///
/// over what leaves normal forces as they are; what carries nothing has none. Each uncoupled part of the
/// scene has a maximum of its own. Where that is not enough normal forces are shared anew with it, see
/// `share_statically`. So all of it is within its bounds as long as any shares are (limit analysis), and what
/// would begin to slide is at its bound where none is.
class FrictionShares {
 public:
  explicit FrictionShares(const System& system);

  /// Changes lambda, one per row of the system, by columns of N times z. `pushing` are the one-sided
  /// constraints that share.
  void spread(const Eigen::MatrixXd& N, std::span<const char> unique,
              const std::vector<SharedContact>& pushing, std::span<double> lambda) const;

 private:
  struct Rough {
    Eigen::Index row, rows, pressing_row;
    double mu_static;
  };
  [[nodiscard]] static std::vector<Rough> shared(const std::vector<Rough>& all, std::span<const char> unique);
  using Forces = Eigen::Map<Eigen::VectorXd>;
  static void share_friction(const Eigen::MatrixXd& basis, std::vector<Rough> chosen,
                             const std::vector<SharedContact>& pushing, Forces lambda);
  /// All contacts that share: those of friction, and the others that push.
  [[nodiscard]] static std::vector<SharedContact> contacts(const std::vector<Rough>& all,
                                                           std::span<const char> unique,
                                                           std::vector<SharedContact> pushing,
                                                           const Forces& lambda);
  [[nodiscard]] static Eigen::VectorXd bounds(const std::vector<Rough>& of, const Forces& lambda);
  /// Takes from `chosen` what carries nothing, and its friction from lambda; returns what may still change.
  [[nodiscard]] static Eigen::MatrixXd leave_to_others(const Eigen::MatrixXd& N, std::vector<Rough>& chosen,
                                                       Forces lambda);

  std::vector<std::vector<Rough>> all_;  // that stick, of each part
  std::vector<std::size_t> part_of_row_;
};

}  // namespace dalembert
