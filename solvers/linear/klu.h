#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A sparse unsymmetric matrix with a fixed pattern, factored by SuiteSparse's KLU: ordered once,
/// pivoted at the first factorisation and again whenever the pivots have become bad, refactored
/// with the same pivots otherwise.
///
/// The pattern is given as a list of entries; values are added up per place, so that several
/// entries may share one.
class SparseLU {
 public:
  struct Entry {
    std::size_t row, column;
  };

  SparseLU(std::size_t size, std::span<const Entry> entries);
  SparseLU(SparseLU&&) noexcept;
  ~SparseLU();

  [[nodiscard]] std::size_t size() const;
  void set_zero();
  /// Adds to the k-th entry of the list.
  void add(std::size_t k, double value);
  /// False if a pivot vanishes. (Rows that depend on each other up to round-off leave a tiny one; they
  /// are found beforehand, by rank-revealing QR.)
  [[nodiscard]] bool factorise();
  /// Solves in place.
  void solve(std::span<double> x);
  /// Of the last factorisation: -1, 0 or 1.
  [[nodiscard]] int sign_of_determinant();
  [[nodiscard]] long factorisations() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dalembert
