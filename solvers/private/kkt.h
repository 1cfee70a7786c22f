#pragma once

#include <dalembert/core/system.h>
#include <dalembert/solvers/private/klu.h>

#include <span>
#include <vector>

namespace dalembert {

/// The constraint rows a solver works with: all of them, unless some depend on others. Holonomic
/// rows come first.
struct ActiveRows {
  std::vector<int> rows;
  int holonomic = 0;

  [[nodiscard]] int size() const { return static_cast<int>(rows.size()); }
};

/// The saddle-point matrix that every solve of this library is about,
///
///   [ M + d D + h H   -U^T ] [ x ]   [ a ]
///   [ L                0   ] [ y ] = [ b ],
///
/// with U = W and L in W's pattern, H = -d(F + W^T lambda)/dq, D = -dF/dv.
class KktMatrix {
 public:
  /// With the blocks H and D, or with M alone.
  enum class Forces { none, linearised };

  KktMatrix(const System& system, const ActiveRows& rows, Forces forces);

  /// [M -W^T; W 0]; `w` in the pattern of the system's W. False if singular.
  [[nodiscard]] bool factorise(std::span<const double> w);
  /// The same with h H + d D added to M and `lower` for L.
  [[nodiscard]] bool factorise(std::span<const double> w, std::span<const double> lower,
                               const System::Linearisation& forces, double h, double d);
  /// In place: (a, b) becomes (x, y), n and then one number per active row.
  void solve(std::span<double> x) { lu_.solve(x); }

  [[nodiscard]] int size() const { return lu_.size(); }
  [[nodiscard]] long factorisations() const { return lu_.factorisations(); }
  [[nodiscard]] double reciprocal_condition() const { return lu_.reciprocal_condition(); }

 private:
  void assemble(std::span<const double> w, std::span<const double> lower);

  const System* system_;
  std::vector<int> rows_;
  SparseLU lu_;
  std::size_t first_force_entry_;
};

}  // namespace dalembert
