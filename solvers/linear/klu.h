#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The places of a sparse unsymmetric matrix, ordered once by SuiteSparse's KLU for all matrices that have
/// them.
class LuPattern {
 public:
  struct Entry {
    std::size_t row, column;
  };

  /// As a list of entries; several may share a place.
  LuPattern(std::size_t size, std::span<const Entry> entries);
  LuPattern(LuPattern&&) noexcept;
  ~LuPattern();

  [[nodiscard]] std::size_t size() const;

 private:
  friend class SparseLU;
  struct State;
  std::unique_ptr<const State> state_;
};

/// A matrix of such a pattern, factored by KLU: pivoted at the first factorisation and again whenever the
/// pivots have become unstable, refactored with the same pivots otherwise. Values are added up per place.
class SparseLU {
 public:
  /// The pattern must outlive it.
  explicit SparseLU(const LuPattern& pattern);
  SparseLU(SparseLU&&) noexcept;
  ~SparseLU();

  void set_zero();
  /// Adds to the k-th entry of the list.
  void add(std::size_t k, double value);
  /// False if a pivot vanishes. (Rows that depend on each other up to round-off leave a tiny one; they
  /// are found beforehand, by rank-revealing QR.)
  [[nodiscard]] bool factorise();
  /// Solves in place.
  void solve(std::span<double> x);
  /// The same with one step of iterative refinement: KLU takes pivots a thousand times smaller than others of
  /// their column, and elements grow by as much. One step leaves a residual of round-off (Skeel, Math. Comp.
  /// 35 (1980) 817).
  void solve_refined(std::span<double> x);
  /// Of the last factorisation: -1, 0 or 1.
  [[nodiscard]] int sign_of_determinant();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dalembert
