#pragma once

#include <dalembert/solvers/private/saddle.h>

#include <optional>
#include <vector>

namespace dalembert {

/// Solves the linear systems of Newton's iteration for the stabilised index-2 equations
///
///   R1 = M (v - q') + G^T mu                     (n)
///   R2 = F(t,q,v) + W^T lambda - M v'            (n)
///   R3 = psi(t,q,v)                              (m)
///   R4 = g(t,q)                                  (m_holonomic)
///
/// in the unknowns (q, v, lambda, mu), where an integrator replaces q' and v' by c q + ..., c v + ...
/// With H = -(F + W^T lambda)_q and D = -F_v the correction obeys
///
///   (1)  M (dv - c dq) + G^T dmu                = b1        [neglecting (G^T mu)_q: mu is round-off]
///   (2)  -H dq - (D + c M) dv + W^T dlambda     = b2
///   (3)  psi_q dq + W dv                        = b3
///   (4)  G dq                                   = b4
///
/// (1) gives dv = c dq + p, p = M^-1 (b1 - G^T dmu). In (2), with dnu = dlambda + c dmu on holonomic
/// rows and dnu = dlambda on the others,
///
///   (5)  (M + D/c + H/c^2) x - W^T dnu          = -b2 - c b1 - D p,      x = c^2 dq
///   (6)  G x = c^2 b4,   (A + psi_q/c) x        = c (b3 - A p)
///
/// for holonomic and nonholonomic rows. Then the velocities, from (1) and the holonomic rows of (3):
///
///   (7)  M dv + G^T dmu                         = b1 + c M dq,     G dv = b3 - psi_q dq
///
/// Two systems of n + m instead of one of 2n + m + m_holonomic.
///
/// In p, dmu is neglected at first. In D p that does no harm. In A p it does where nonholonomic rows
/// meet holonomic ones, A M^-1 G^T not 0: a predictor leaves the manifold by c b4 - b3, dmu is as large, and
/// each iteration would mend that error of the last in the multipliers by one as large. There (5) to (7) are
/// solved a second time with p = dv - c dq of the first, which leaves of the error a part of order psi_q/c.
///
/// Where forces are soft against the inertia that a step feels, |H|/c^2 + |D|/c small against M, and
/// no row is nonholonomic, H and D are left out. Then both matrices are the same, nothing in
/// them depends on c, and their Schur complement W M^-1 W^T serves both; a change of the step needs no
/// new factors. (H holds the predicted, noisy multipliers: on chains leaving it out halves the
/// steps.)
class NewtonMatrix {
 public:
  NewtonMatrix(const System& system, const ActiveRows& rows);

  /// Factors at a state, with the equations there; `lambda` has one number per row of the system.
  /// False if singular. Throws EquationFault.
  [[nodiscard]] bool factorise(const Instant& at, const System::Evaluation& e, std::span<const double> lambda,
                               double c);
  /// In place: b = (b1, b2, b3, b4) becomes (dq, dv, dlambda, dmu). `c` may have changed since.
  void solve(double c, std::span<double> b);

  [[nodiscard]] long factorisations() const {
    return k2_.factorisations() + (k1_ ? k1_->factorisations() : 0);
  }
  /// Brings soft factors up to date with W, which costs them little; others stay as they are.
  /// False if singular.
  [[nodiscard]] bool refresh(const System::Evaluation& e);
  /// Whether the last factors leave the forces' derivatives out.
  [[nodiscard]] bool soft() const { return soft_; }
  [[nodiscard]] const char* method() const { return soft_ ? k2_.method() : "KLU"; }

 private:
  [[nodiscard]] double along(std::size_t row, std::span<const double> values,
                             std::span<const double> x) const;

  [[nodiscard]] bool judge_soft(double c);
  void solve_soft(double c, std::span<double> b);
  void solve_stiff(double c, std::span<double> b);
  void eliminate(double c, std::span<const double> b);

  const System* system_;
  ActiveRows rows_;
  System::Linearisation linear_;
  std::vector<double> w_, lower_;
  std::optional<KktMatrix> k1_;  // once the forces are not soft
  SaddleMatrix k2_;
  std::vector<double> x1_, x2_, p_;
  bool soft_ = false;
};

}  // namespace dalembert
