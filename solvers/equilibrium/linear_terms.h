#pragma once

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/rotating_frame.h>
#include <dalembert/solvers/linear/klu.h>

#include <Eigen/SparseCore>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The equations of small motions u in a uniformly moving frame (A, see RotatingFrame; at rest A = 0), about
/// a state with multipliers lambda:
///
///   M u'' + C u' + K u = W^T y,       W u + c y = 0          (holonomic rows, c their compliance)   (1)
///                                     W u' + E u = 0         (nonholonomic rows)                    (2)
///   C = 2 M A - F_v,   K = -(F + W^T lambda)_q - F_v A + M A^2,   E = psi_q + W A                   (3)
///
/// since u there stands for the change u' + A u of velocity and u'' + 2 A u' + A^2 u of acceleration. K
/// contains the curvature of the constraints, -sum lambda g_qq, and the centrifugal forces.
struct LinearTerms {
  using Entries = std::vector<Eigen::Triplet<double, std::size_t>>;
  Entries stiffness, damping;  ///< K and C; places may repeat, their entries add
  std::vector<double> w;       ///< W, in the system's pattern
  std::vector<double> e;       ///< E, in the same, for the nonholonomic rows
  /// Roundings of themselves to which the numbers are known: as many as a position far from the origin has
  /// of the scene's length, as they are made of differences of positions; or one.
  double roundings = 1.0;
};

/// A multiplier that is round-off of the forces counts as 0: where nothing else is stiff, its curvature would
/// be taken for a stiffness. Throws EquationFault.
[[nodiscard]] LinearTerms linear_terms(const System& system, const RotatingFrame& frame, const Instant& at,
                                       std::span<const double> lambda, double roundings = 1.0);

/// [ K + s M  -W^T ]
/// [ W         c   ]   of some rows, factored.
class TangentMatrix {
 public:
  /// Where its entries stand, and the symbolic analysis of that.
  struct Pattern {
    std::vector<LuPattern::Entry> entries;
    LuPattern lu;
  };

  TangentMatrix(const System& system, const ActiveRows& rows, const LinearTerms& terms, double s);
  /// With an s for each coordinate. `known` keeps the pattern from one matrix to the next of the same
  /// pattern.
  TangentMatrix(const System& system, const ActiveRows& rows, const LinearTerms& terms,
                std::span<const double> s, std::shared_ptr<const Pattern>& known);
  [[nodiscard]] bool regular() const { return regular_; }
  /// In place, one number per coordinate and then one per row.
  void solve(std::span<double> x) { lu_.solve(x); }

 private:
  TangentMatrix(std::shared_ptr<const Pattern> pattern, const System& system, const ActiveRows& rows,
                const LinearTerms& terms, std::span<const double> s);

  std::shared_ptr<const Pattern> pattern_;
  SparseLU lu_;
  bool regular_;
};

}  // namespace dalembert
