#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The places of a sparse symmetric matrix and the order in which its rows are eliminated: the given one, or
/// that of AMD if it fills in less. Settled once for all matrices that have them.
class LdlPattern {
 public:
  struct Entry {
    std::size_t row, column;
  };

  /// As a list of entries of either triangle; several may share a place.
  LdlPattern(std::size_t size, std::span<const Entry> entries);

  [[nodiscard]] std::size_t size() const { return diagonal_.size(); }
  /// Where among the values of a matrix the k-th entry of the list stands.
  [[nodiscard]] std::size_t place(std::size_t k) const { return place_[k]; }
  /// Entries of L below the diagonal.
  [[nodiscard]] int fill() const { return l_start_.back(); }

 private:
  friend class SparseLdl;

  void compress(std::span<const Entry> entries);
  void analyse();
  [[nodiscard]] int order_by_amd(std::vector<int>& order) const;
  [[nodiscard]] std::size_t position_of(std::size_t r) const { return position_.empty() ? r : position_[r]; }

  std::vector<std::size_t> diagonal_;    // place of each diagonal entry
  std::vector<int> column_start_, row_;  // upper triangle in compressed columns, in the order of elimination
  std::vector<std::size_t> place_;
  std::vector<std::size_t>
      position_;  // of each row in the order of elimination; empty if it is the given one
  std::vector<int> parent_, l_start_;
};

/// A positive definite matrix of such a pattern, factored as L D L^T by SuiteSparse's LDL, without pivoting.
class SparseLdl {
 public:
  /// The pattern must outlive it.
  explicit SparseLdl(const LdlPattern& pattern);

  [[nodiscard]] std::span<double> values() { return value_; }

  /// False if the matrix is not positive definite to working precision.
  [[nodiscard]] bool factorise();
  /// Solves in place.
  void solve(std::span<double> x);
  /// The smallest pivot over its diagonal entry. For S = U U^T it is sin^2 of the angle between a
  /// row of U and the span of the rows eliminated before it.
  [[nodiscard]] double smallest_pivot() const { return smallest_pivot_; }

 private:
  const LdlPattern* pattern_;
  std::vector<double> value_, pivot_;
  // Of more than one row.
  std::vector<double> l_value_, work_;
  std::vector<int> l_row_, l_count_, flag_, nonzeros_;  // the last two are work
  double smallest_pivot_ = 0.0;
};

}  // namespace dalembert
