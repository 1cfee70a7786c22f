#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/kkt.h>
#include <dalembert/solvers/linear/schur.h>

#include <optional>

namespace DALEMBERT_HIDDEN dalembert {

/// The matrix of projections and accelerations,
///
///   [ M  -W^T ]
///   [ W   s   ],      s diagonal, not 0 in compliant rows only,
///
/// factored in the way that suits the scene: through its Schur complement W M^-1 W^T, or as a whole
/// by LU where many constraints share a particle (the complement would be full), and wherever rows
/// come so close to each other that the complement, whose condition is squared, cannot tell them
/// apart.
class SaddleMatrix {
 public:
  /// Throughout its life the matrix refers to the system.
  SaddleMatrix(const System& system, const ActiveRows& rows);

  /// Whether the Schur complement of these rows is sparse.
  [[nodiscard]] static bool complement_suits(const System& system, const ActiveRows& rows);

  /// `w` in the pattern of the system's W, `s` one number per row of the system, or none for 0. False if
  /// singular.
  [[nodiscard]] bool factorise(std::span<const double> w, std::span<const double> s = {});
  /// In place: (a, b) becomes (x, y), n and then one number per active row.
  void solve(std::span<double> x);

  /// The sine of the smallest angle that a row made with others when the matrix was factored last, in the
  /// metric of the masses; 1 if the complement, which tells it, does not suit the scene.
  [[nodiscard]] double sine() const;

  [[nodiscard]] std::size_t size() const { return system_->coordinates() + rows_.size(); }
  [[nodiscard]] long factorisations() const { return factorisations_; }
  /// "LDL" or "KLU".
  [[nodiscard]] const char* method() const { return schur_ ? "LDL" : "KLU"; }

 private:
  const System* system_;
  ActiveRows rows_;
  std::optional<SchurComplement> schur_;
  std::optional<KktMatrix> whole_;
  bool by_schur_ = false;  // the current factors
  long factorisations_ = 0;
};

}  // namespace dalembert
