#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/saddle.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// In each island the direction n of the coordinates that its constraints constrain least: the right singular
/// vector of the smallest singular value of W M^-1/2 with rows of unit length, by inverse iteration with
///
///   [ M  -W^T ] [ x ]   [  0  ]
///   [ W   0   ] [ y ] = [ D u ],     D^2 the diagonal of W M^-1 W^T,     u <- D y,  n ~ x.
class WeakestDirection {
 public:
  explicit WeakestDirection(const System& system) : system_(&system) {}

  /// With the factors that `matrix` has at W. One iteration serves all islands: it does not mix them.
  void find(SaddleMatrix& matrix, const ActiveRows& rows, std::span<const double> w, const Islands& islands);
  /// The smallest singular value itself, of all islands.
  [[nodiscard]] double smallest_singular_value(SaddleMatrix& matrix, const ActiveRows& rows,
                                               std::span<const double> w, const Islands& islands);
  /// n, not normalised, of the last `find`.
  [[nodiscard]] std::span<const double> n() const { return std::span(x_).first(system_->coordinates()); }
  /// The weights of rows of unit length, not normalised.
  [[nodiscard]] std::span<const double> u() const { return u_; }
  /// The one that has the smallest singular value of all.
  [[nodiscard]] std::size_t weakest_island(const ActiveRows& rows, const Islands& islands);

 private:
  void measure(const ActiveRows& rows, const Islands& islands);

  const System* system_;
  std::vector<double> x_, u_;
  std::vector<double> square_;  // |u|^2 of each island
};

}  // namespace dalembert
