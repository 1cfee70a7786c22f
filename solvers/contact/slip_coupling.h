#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A constraint of Coulomb's law by its rows, and that of its normal force.
struct SlipRows {
  std::size_t row, rows, pressing_row;
};

/// What friction sigma does to slip velocities u and to the normal forces N of an instant,
///
///   u' = c + S sigma,   N = N_0 + B sigma,                                                            (1)
///
/// where all other constraints hold and all other forces act, those of what slides with their normal forces;
/// S_0 is S without these. S_0 is symmetric and positive semi-definite. A slip velocity that the other
/// constraints prescribe has a row of zeros in S, and c is its rate.
struct SlipCoupling {
  /// `stated` has the rows, of which `free` has none in force.
  SlipCoupling(const System& stated, std::shared_ptr<const System> free, const std::vector<SlipRows>& of,
               const std::vector<double>& lengths, const Instant& at, double tolerance);

  /// The same for those at some places only, with their rows; nothing couples the others to them.
  [[nodiscard]] SlipCoupling part(const std::vector<Eigen::Index>& of,
                                  const std::vector<Eigen::Index>& rows) const;

  Eigen::MatrixXd S, S_0, B;
  Eigen::VectorXd c, N_0;
  Eigen::VectorXd terms;  ///< the largest term of each rate c

 private:
  SlipCoupling() = default;
  struct Equations;
  void find_rates(const Equations& its);
  void find_responses(const Equations& its, bool with_sliding, Eigen::MatrixXd& responses);
  void clear_prescribed(const Equations& its, double tolerance);
};

}  // namespace dalembert
