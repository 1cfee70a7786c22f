#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A sparse symmetric positive definite matrix with a fixed pattern, factored as L D L^T by
/// SuiteSparse's LDL: ordered once (by AMD, unless the given order fills in no more), factored
/// without pivoting.
class SparseLdl {
 public:
  struct Entry {
    std::size_t row, column;
  };

  /// The pattern as a list of entries of either triangle; several may share a place.
  SparseLdl(std::size_t size, std::span<const Entry> entries);
  SparseLdl(SparseLdl&&) noexcept;
  ~SparseLdl();

  [[nodiscard]] std::size_t size() const;
  /// Where in `values` the k-th entry of the list stands.
  [[nodiscard]] std::size_t place(std::size_t k) const;
  [[nodiscard]] std::span<double> values();

  /// False if the matrix is not positive definite to working precision.
  [[nodiscard]] bool factorise();
  /// Solves in place.
  void solve(std::span<double> x);
  /// The smallest pivot over its diagonal entry. For S = U U^T it is sin^2 of the angle between a
  /// row of U and the span of the rows eliminated before it.
  [[nodiscard]] double smallest_pivot() const;
  /// Entries of L below the diagonal.
  [[nodiscard]] std::size_t fill() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dalembert
