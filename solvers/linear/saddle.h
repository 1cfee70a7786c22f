#pragma once

#include <dalembert/solvers/linear/complement.h>
#include <dalembert/solvers/linear/whole.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What saddle-point matrices of some rows and coordinates have in common: how they are factored. Analysed
/// once, when first asked for.
class SaddlePattern {
 public:
  /// Of all coordinates, or some of them with the rows that read these and no others.
  SaddlePattern(std::shared_ptr<const System> system, std::vector<std::size_t> rows,
                std::vector<std::size_t> coordinates);

  [[nodiscard]] const std::vector<std::size_t>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<std::size_t>& coordinates() const { return coordinates_; }
  [[nodiscard]] std::size_t size() const { return coordinates_.size() + rows_.size(); }

  /// Whether symmetric matrices are factored through their Schur complement: where that is sparse.
  [[nodiscard]] bool by_complement() const { return by_complement_; }
  [[nodiscard]] const ComplementPattern& complement() const;
  [[nodiscard]] const WholePattern& whole(SaddleValues::Blocks blocks) const;

  /// So many symbolic analyses were made, by LDL and by KLU.
  struct Analyses {
    int ldl = 0, klu = 0;
  };
  [[nodiscard]] Analyses analyses() const;

 private:
  std::shared_ptr<const System> system_;
  std::vector<std::size_t> rows_, coordinates_;
  bool by_complement_;
  mutable std::optional<ComplementPattern> complement_;
  mutable std::array<std::optional<WholePattern>, 3> whole_;  // by their blocks
};

/// A saddle-point matrix (see SaddleValues), factored in the way that suits it: if it is symmetric through
/// its Schur complement W M^-1 W^T, or as a whole by LU where many constraints share a particle (the
/// complement would be full), and wherever rows come so close to each other that the complement, whose
/// condition is squared, cannot tell them apart; with other blocks as a whole.
class SaddleMatrix {
 public:
  /// What `blocks` need is made now, the rest when it is first needed.
  explicit SaddleMatrix(std::shared_ptr<const SaddlePattern> pattern,
                        SaddleValues::Blocks blocks = SaddleValues::Blocks::symmetric);

  /// False if singular.
  [[nodiscard]] bool factorise(const SaddleValues& values);
  /// In place: (a, b) becomes (x, y), one number per coordinate of the pattern and then one per row.
  void solve(std::span<double> x);
  /// The same, to round-off in the residual also where it is factored as a whole.
  void solve_refined(std::span<double> x);

  /// The sine of the smallest angle that a row made with others when a symmetric matrix was factored last, in
  /// the metric of the masses; 1 if the complement, which tells it, does not suit the scene.
  [[nodiscard]] double sine() const;
  [[nodiscard]] bool tells_sine() const { return complement_.has_value(); }
  /// Of the last factorisation, of a matrix with other blocks than the symmetric ones.
  [[nodiscard]] int sign_of_determinant() { return whole_[in_use_]->sign_of_determinant(); }

  [[nodiscard]] const std::vector<std::size_t>& rows() const { return pattern_->rows(); }
  [[nodiscard]] const std::vector<std::size_t>& coordinates() const { return pattern_->coordinates(); }
  [[nodiscard]] std::size_t size() const { return pattern_->size(); }
  [[nodiscard]] long factorisations() const { return factorisations_; }
  /// What factors symmetric ones: "LDL" or "KLU".
  [[nodiscard]] const char* method() const { return pattern_->by_complement() ? "LDL" : "KLU"; }

 private:
  [[nodiscard]] SchurComplement& complement();
  [[nodiscard]] WholeMatrix& whole(SaddleValues::Blocks blocks);

  std::shared_ptr<const SaddlePattern> pattern_;
  std::optional<SchurComplement> complement_;
  std::array<std::optional<WholeMatrix>, 3> whole_;  // by their blocks
  bool by_complement_ = false;                       // the current factors; else those of whole_[in_use_]
  std::size_t in_use_ = 0;
  long factorisations_ = 0;
};

}  // namespace dalembert
