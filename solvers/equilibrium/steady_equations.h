#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/symmetries.h>
#include <dalembert/solvers/manifold/start.h>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The equations (1) of `steady` at (q, lambda, y), linearised:
///
///   r + J (dq, dy) + L dlambda = 0                                                                    (1)
///
/// one row per coordinate (forces over the root of the mass), per constraint row and per kept quantity.
/// Beside each number stands what it is a sum of, without signs: a fast spin leaves of its terms little.
class SteadyEquations {
 public:
  struct State {
    double time;
    const Eigen::VectorXd &q, &lambda, &y;
  };
  /// Of the independent rows, with room for some quantities that are kept.
  SteadyEquations(const System& system, const Islands& parts, const Symmetries& symmetries,
                  const Scales& scales, const ActiveRows& rows, const State& at, Eigen::Index kept);

  /// The k-th kept quantity: by how much it is off, what that is the difference of, and its gradient.
  void keep(Eigen::Index k, double off, double terms, const Eigen::RowVectorXd& gradient);

  // Once all that is kept has been told:

  /// Of each part of the scene that nothing couples to others the largest part of its terms that multipliers
  /// do not take up, or of what is kept and reads it.
  [[nodiscard]] std::vector<double> unbalanced();
  /// What multipliers change by without a correction of the rest.
  [[nodiscard]] Eigen::VectorXd balance() const;
  /// The correction of least size in units of the scene; its largest number, infinite where it is no number.
  struct Correction {
    Eigen::VectorXd q, y, lambda;
    double size;
  };
  /// Of the parts that do not stay as they are.
  [[nodiscard]] Correction correction(const std::vector<char>& stays) const;

 private:
  void add_equations(const System& system, const Symmetries& symmetries, const ActiveRows& rows,
                     const State& at, double most);
  void divide_row(Eigen::Index i, double by);
  void weigh();
  [[nodiscard]] Eigen::MatrixXd slopes_of_others(const std::vector<char>& stays) const;
  [[nodiscard]] Eigen::VectorXd least_change(const Eigen::MatrixXd& J) const;
  [[nodiscard]] bool reads(Eigen::Index row, std::size_t part) const;

  Eigen::Index n_, m_, p_;                // coordinates, rows, symmetries
  std::vector<std::size_t> part_of_row_;  // of the first n + m; the first n are the coordinates'
  std::size_t parts_;
  Eigen::VectorXd masses_, units_, v_{};
  Eigen::MatrixXd X_, still_{};  // fields of all symmetries, displacements by those that commute
  Eigen::MatrixXd J_, J_terms_, L_;
  Eigen::VectorXd r_, r_terms_;
  Eigen::MatrixXd free_{};  // of what multipliers take up
};

}  // namespace dalembert
