#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/klu.h>
#include <dalembert/solvers/linear/rows.h>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The saddle-point matrix that every solve of this library is about,
///
///   [ M + d D + h H   -U^T ] [ x ]   [ a ]
///   [ L                s   ] [ y ] = [ b ],
///
/// with U = W and L in W's pattern, H = -d(F + W^T lambda)/dq, D = -dF/dv, and s diagonal, not 0 in
/// compliant rows only. Where forces read multipliers, U^T = W^T + dF/dlambda.
class KktMatrix {
 public:
  /// With the blocks H and D and dF/dlambda, with the last alone, or with M alone.
  enum class Forces { none, friction, linearised };

  KktMatrix(const System& system, const ActiveRows& rows, Forces forces);
  /// Of some of the coordinates only, with the rows that read them and no others.
  KktMatrix(const System& system, const ActiveRows& rows, Forces forces,
            std::vector<std::size_t> coordinates);

  /// [M -W^T; W s]; `w` in the pattern of the system's W, `s` one number per row of the system, or none for
  /// 0. False if singular.
  [[nodiscard]] bool factorise(std::span<const double> w, std::span<const double> s = {});
  /// The same with dF/dlambda, in the system's pattern.
  [[nodiscard]] bool factorise_with_friction(std::span<const double> w, std::span<const double> s,
                                             std::span<const double> friction);
  /// The same with h H + d D added to M and `lower` for L.
  [[nodiscard]] bool factorise(std::span<const double> w, std::span<const double> lower,
                               const System::Linearisation& forces, double h, double d,
                               std::span<const double> s = {});
  /// In place: (a, b) becomes (x, y), one number per coordinate and then one per row of the matrix.
  void solve(std::span<double> x) { lu_.solve(x); }

  [[nodiscard]] std::size_t size() const { return lu_.size(); }
  [[nodiscard]] long factorisations() const { return lu_.factorisations(); }
  /// Of the last factorisation; without friction and linearised forces it is 1 if no row depends on others.
  [[nodiscard]] int sign_of_determinant() { return lu_.sign_of_determinant(); }

 private:
  struct Plan;
  KktMatrix(const System& system, const ActiveRows& rows, Plan plan);
  [[nodiscard]] static Plan plan(const System& system, const ActiveRows& rows, Forces forces,
                                 std::vector<std::size_t> coordinates);
  void add_friction(std::span<const double> friction);
  void assemble(std::span<const double> w, std::span<const double> lower, std::span<const double> s);

  const System* system_;
  std::vector<std::size_t> rows_, coordinates_;
  std::vector<std::size_t> friction_, stiffness_, damping_;  // entries of the system's patterns in the matrix
  SparseLU lu_;
  std::size_t first_force_entry_;
};

}  // namespace dalembert
