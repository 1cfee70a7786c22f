#pragma once

#include <dalembert/solvers/linear/ldl.h>
#include <dalembert/solvers/linear/values.h>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The places of a Schur complement W M^-1 W^T of some rows: a sum of products of entries of W and V = W M^-1
/// that share a coordinate; which ones is settled here.
class ComplementPattern {
 public:
  ComplementPattern(const System& system, std::span<const std::size_t> rows);

  /// Number of products that make it up: the sum over all coordinates of the square of how many entries of W
  /// they have. Large where many constraints share a particle.
  [[nodiscard]] static std::size_t products(const System& system, std::span<const std::size_t> rows);

 private:
  friend class SchurComplement;
  /// An entry of V, with the number of that of the system's W.
  struct Entry {
    std::size_t w, column;
  };
  /// A sum of products of consecutive entries of the system's W and of V. The first one of a place sets it,
  /// the others add.
  struct Product {
    std::size_t place, w, v, count;
    bool first = false;
  };
  /// Where a compliant row of the system stands on the diagonal.
  struct Diagonal {
    std::size_t row, place;
  };
  struct Plan {
    std::vector<Entry> entries;
    std::vector<std::size_t> row_end;       // among the entries
    std::vector<Diagonal> compliant;        // `place` is the number of a product
    std::vector<LdlPattern::Entry> places;  // one per product
    std::vector<Product> products;
  };
  [[nodiscard]] static Plan plan(const System& system, std::span<const std::size_t> rows);
  ComplementPattern(const System& system, Plan plan);

  std::vector<double> inverse_mass_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> row_end_;
  std::vector<Product> products_;
  std::vector<Diagonal> compliant_;
  LdlPattern ldl_;
};

/// Solves the symmetric system
///
///   [ M  -W^T ] [ x ]   [ a ]
///   [ W   s   ] [ y ] = [ b ]                                                            (1)
///
/// through the Schur complement of M, which is diagonal and positive:
///
///   S y = b - W M^-1 a,   x = M^-1 (a + W^T y),   S = W M^-1 W^T + s                      (2)
///
/// S has one row per constraint, is positive definite if the rows of W are independent, and for a chain it is
/// tridiagonal.
///
/// The condition of S is the square of that of W M^-1/2: rows that make an angle of 1e-8 are
/// dependent here, while (1) as a whole still tells them apart. SaddleMatrix takes care of that.
class SchurComplement {
 public:
  /// The pattern must outlive it.
  explicit SchurComplement(const ComplementPattern& pattern);

  /// Of `values`, w and s. False if S is singular to working precision.
  [[nodiscard]] bool factorise(const SaddleValues& values);
  /// In place: (a, b) becomes (x, y), one number per coordinate of the system and then one per row.
  void solve(std::span<double> x);
  /// See SparseLdl: sin^2 of the smallest angle that a row makes with others.
  [[nodiscard]] double smallest_pivot() const { return ldl_.smallest_pivot(); }

 private:
  const ComplementPattern* pattern_;
  std::vector<double> v_;
  SparseLdl ldl_;
};

}  // namespace dalembert
