#pragma once

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/ida/vibrations.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/manifold/weakest_direction.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Solves the linear systems of Newton's iteration for the stabilised index-2 equations
///
///   R1 = M (v - q') + G^T mu                     (n)
///   R2 = F(t,q,v,lambda) + W^T lambda - M v'     (n)
///   R3 = psi(t,q,v) + C lambda'                  (m)
///   R4 = g(t,q) + C lambda                       (m_holonomic)
///
/// in the unknowns (q, v, lambda, mu), where an integrator replaces x' by c x + ...; the compliance C is
/// 0 in rigid and in nonholonomic rows. With H = -(F + W^T lambda)_q and D = -F_v the correction obeys
///
///   (1)  M (dv - c dq) + G^T dmu                = b1        [neglecting (G^T mu)_q: mu is round-off]
///   (2)  -H dq - (D + c M) dv + W^T dlambda     = b2
///   (3)  psi_q dq + W dv + c C dlambda          = b3
///   (4)  G dq + C dlambda                       = b4
///
/// (1) gives dv = c dq + p, p = M^-1 (b1 - G^T dmu). In (2), with dnu = dlambda + c dmu on holonomic
/// rows and dnu = dlambda on the others,
///
///   (5)  (M + D/c + H/c^2) x - W^T dnu          = -b2 - c b1 - D p,      x = c^2 dq
///   (6)  G x + c^2 C dnu = c^2 (b4 + c C dmu),   (A + psi_q/c) x         = c (b3 - A p)
///
/// for holonomic and nonholonomic rows. Then the velocities, from (1) and the holonomic rows of (3):
///
///   (7)  M dv + G^T dmu                         = b1 + c M dq,     G dv = b3 - psi_q dq - c C dlambda
///
/// Two systems of n + m instead of one of 2n + m + m_holonomic.
///
/// Parallel rows (see ActiveRows) take part in (5) and (6) only; in place of (3) they have mu = 0.
///
/// At first dmu is neglected in (5) and (6). A predictor leaves the manifold by c b4 - b3, dmu is as
/// large, and neglecting it spoils convergence where it is multiplied by much: in D p where damping is
/// strong, in A p where nonholonomic rows are coupled to holonomic ones (A M^-1 G^T not 0), in C dmu. Each
/// iteration would correct that error of the last in the multipliers by one as large. There (5) to (7) are
/// solved again with the dmu and p found, which leaves of the error a part of order psi_q/c; with C a third
/// time. (With C dlambda = C (dnu - c dmu) and the same dmu in (6) and (7), the matrix of (7) is that of a
/// rigid scene.)
///
/// In steps that resolve the vibration of a compliant row, c^2 C > w M^-1 w, dlambda would be the small
/// difference of dnu and c dmu: there the unknown in (5) and (6) is dlambda itself, and c G^T dmu, with the
/// dmu found, stands on the right of (5).
///
/// Where forces read multipliers, W^T in (2) and (5) is W^T + F_lambda, and -c F_lambda dmu joins the right
/// of (5). What neglecting dmu leaves is multiplied without bound near Painleve's point, where W M^-1 (W^T +
/// F_lambda) is singular: there (5) to (7) are solved until dlambda is settled. Friction that changes the
/// sign of the determinant has passed that point; such a state has no acceleration, see
/// MultiplierForceSolver.
///
/// Where forces are soft against the inertia in a step, |H|/c^2 + |D|/c small against M, H and D
/// are left out. Of the forces' own stiffness |H| T/c must be small as well, with the scene's time T: IDA
/// measures a first correction dq by L, the H dq/(c M) that it leaves to the second by L/T, and would take
/// the second for divergence. Where besides no row is nonholonomic or compliant, both matrices are the same,
/// nothing in them depends on c, and their Schur complement W M^-1 W^T serves both; a change of the step
/// needs no new factors. (H holds the predicted, noisy multipliers: on chains leaving it out halves the
/// steps.) That is decided for each island of the scene by itself.
class NewtonMatrix {
 public:
  /// `time` is the scene's own, as in Scales.
  NewtonMatrix(const Problem& problem, const ActiveRows& rows, double time);

  /// Factors at a state, with the equations there; `lambda` has one number per row of the system.
  /// False if singular. Throws EquationFault, also where friction leaves no acceleration.
  [[nodiscard]] bool factorise(const Instant& at, const System::Evaluation& e, std::span<const double> lambda,
                               double c);
  /// In place: b = (b1, b2, b3, b4) becomes (dq, dv, dlambda, dmu). `c` may have changed since.
  void solve(double c, std::span<double> b);

  [[nodiscard]] long factorisations() const {
    return k2_.factorisations() + factorisations_of_earlier_ + (k1_ ? k1_->matrix.factorisations() : 0);
  }
  /// Brings the factors up to date with W; what forces and multipliers contribute stays as it was.
  /// False if singular.
  [[nodiscard]] bool refresh(const System::Evaluation& e, double c);
  /// Of the state at which the matrix was made.
  [[nodiscard]] const Vibrations& fastest() const { return fastest_; }
  /// The sine of the smallest angle that a holonomic row makes with others, see SaddleMatrix. Where that does
  /// not tell it, it is 1, and after `find_sine` the least singular value where the matrix was made.
  [[nodiscard]] double sine() const { return k2_.tells_sine() ? k2_.sine() : sine_; }
  void find_sine() { asks_sine_ = !k2_.tells_sine(); }
  /// After an iteration that did not converge: if forces were left out then for being soft, none will be.
  void converged_badly();
  /// Whether the last factors are those of W M^-1 W^T alone.
  [[nodiscard]] bool soft() const { return !k1_in_use_; }
  /// What factors the matrices, and of how many islands if it is not the same for all.
  [[nodiscard]] std::string method() const;

 private:
  /// The matrix of (5) and (6) for some of the islands.
  struct Stiff {
    std::vector<std::size_t> active;  // its rows, by their place among all active ones
    std::vector<char> islands;
    SaddleMatrix matrix;
    std::vector<double> x;
  };

  [[nodiscard]] std::vector<char> varying_islands() const;
  [[nodiscard]] double dlambda(std::size_t active, double c) const;
  void judge(double c);
  void leave_out_soft_forces();
  void include(const std::vector<char>& islands);
  [[nodiscard]] bool factorise_stiff(double c);
  void require_acceleration(double c, double t);
  void eliminate_again(double c, std::span<const double> b);
  void settle_friction(double c, std::span<const double> b);
  [[nodiscard]] int repetitions() const;
  void solve_by_k2();
  void eliminate(double c, std::span<const double> b);

  /// An entry of F_lambda in a holonomic row.
  struct Friction {
    std::size_t entry, coordinate, active;
    double dmu = 0.0, dlambda = 0.0;  // of the last elimination
  };

  Problem problem_;
  const System* system_;  // points into problem_
  ActiveRows rows_;
  double time_;
  double still_soft_ = constants.soft;
  std::vector<char> needs_k1_;  // per island: nonholonomic or compliant rows, or friction
  std::vector<char> stiff_;     // per island: forces that a step feels
  std::vector<Friction> friction_;
  System::Linearisation linear_;
  std::vector<double> w_, lower_, s_;
  std::optional<Stiff> k1_;
  std::vector<std::size_t> with_mu_;  // mu: places in rows_
  SaddleMatrix k2_;
  WeakestDirection weakest_;
  ActiveRows rows_of_k2_;
  bool asks_sine_ = false;
  double sine_ = 1.0;
  std::vector<double> x1_, x2_, p_, dmu_;
  std::vector<char> yields_;  // per holonomic active row: its compliance outweighs its inertia
  bool k1_in_use_ = false;
  long factorisations_of_earlier_ = 0;  // matrices K1, of fewer islands
  std::size_t first_force_entry_;       // of the stiffness: constraints come first
  Vibrations fastest_;
};

}  // namespace dalembert
