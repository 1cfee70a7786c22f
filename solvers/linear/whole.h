#pragma once

#include <dalembert/solvers/linear/klu.h>
#include <dalembert/solvers/linear/values.h>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The places of the whole saddle-point matrix, with some of its blocks, for some rows and coordinates.
class WholePattern {
 public:
  /// `coordinates` are all that the rows read. The system must outlive it.
  WholePattern(const System& system, std::span<const std::size_t> rows,
               std::span<const std::size_t> coordinates, SaddleValues::Blocks blocks);

 private:
  friend class WholeMatrix;
  struct Plan;
  WholePattern(const System& system, Plan plan);
  [[nodiscard]] static Plan plan(const System& system, std::span<const std::size_t> rows,
                                 std::span<const std::size_t> coordinates, SaddleValues::Blocks blocks);

  const System* system_;
  std::vector<std::size_t> rows_, coordinates_;
  std::vector<std::size_t> slope_, stiffness_, damping_;  // entries of the system's patterns in the matrix
  LuPattern lu_;
};

/// Such a matrix, factored by LU.
class WholeMatrix {
 public:
  /// The pattern must outlive it.
  explicit WholeMatrix(const WholePattern& pattern) : pattern_(&pattern), lu_(pattern.lu_) {}

  /// With the blocks that the pattern has. False if singular.
  [[nodiscard]] bool factorise(const SaddleValues& values);
  /// In place: (a, b) becomes (x, y), one number per coordinate and then one per row.
  void solve(std::span<double> x) { lu_.solve(x); }
  void solve_refined(std::span<double> x) { lu_.solve_refined(x); }
  /// Of the last factorisation; of a symmetric one it is 1 if no row depends on others.
  [[nodiscard]] int sign_of_determinant() { return lu_.sign_of_determinant(); }

 private:
  const WholePattern* pattern_;
  SparseLU lu_;
};

}  // namespace dalembert
