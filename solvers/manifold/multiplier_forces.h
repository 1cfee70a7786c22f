#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/problem.h>

#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Throws EquationFault: no acceleration exists, or no unique one. Of several forces it names the one with
/// the largest slope, the likeliest.
[[noreturn]] void refuse_friction(const System& system, std::span<const double> slope, double t);

/// Accelerations and multipliers where forces F_f read multipliers,
///
///   [ M  -W^T ] [ v'     ]   [ F + F_f(lambda) ]
///   [ W   s   ] [ lambda ] = [ b               ],                                        (1)
///
/// by Newton's iteration, from the multipliers of the last solution or of the motion without friction, with
///
///   [ M  -(W^T + dF_f/dlambda) ]
///   [ W   s                    ].                                                        (2)
///
/// Coulomb's law is linear in lambda as long as that keeps its sign: one or two steps solve (1) to
/// round-off, however strongly friction couples back. Iterating on lambda with the factors of the matrix
/// in (1) would need no matrix (2), but would converge as a power of that coupling, and would reject, at
/// a coupling below -1, problems that have exactly one solution.
///
/// Without friction the determinant of (2) is positive. Friction that changes its sign has passed the value
/// at which no acceleration or many exist (Painleve): the solution of (1) is then not the motion. Of a law
/// in |lambda| a second solution may lie where multipliers have the other sign: `require_unique` asks for
/// the sign of (2) at -lambda, which settles that for one multiplier and catches for several those that
/// change their signs together.
class MultiplierForceSolver {
 public:
  MultiplierForceSolver(const Problem& problem, const ActiveRows& rows);

  /// In place: (F, b) becomes (v', lambda), n and then one number per active row; w and s as in SaddleValues.
  /// False if W is singular. Throws EquationFault, naming the force, if there is no solution.
  [[nodiscard]] bool solve(const Instant& at, std::span<const double> w, std::span<const double> s,
                           std::span<double> x);
  /// After `solve` at the same state; throws EquationFault.
  void require_unique(const Instant& at, std::span<const double> w, std::span<const double> s);
  /// That no force reads a row which `determined` says the motion does not determine. Throws
  /// InconsistentStart, naming both.
  void require_determined(const Instant& at, std::span<const char> determined);

  [[nodiscard]] long factorisations() const { return matrix_.factorisations(); }

 private:
  /// Which of its multipliers each force reads, by its slopes at velocities and multipliers of no special
  /// kind: where friction is at rest, slopes vanish.
  void find_what_is_read(const Instant& at);
  /// y += factor dF_f/dlambda x, for one number per row of the system.
  void add_slope(double factor, std::span<const double> x, std::span<double> y) const;
  [[nodiscard]] bool converged() const;
  enum class Outcome { solved, none, singular };  // none: no solution, or no unique one; singular: W is
  [[nodiscard]] bool solve_without(std::span<const double> w, std::span<const double> s);
  [[nodiscard]] Outcome iterate(const Instant& at, std::span<const double> w, std::span<const double> s,
                                std::span<double> x);
  [[nodiscard]] Outcome iterate_from_last(const Instant& at, std::span<const double> w,
                                          std::span<const double> s, std::span<double> x);
  void read_multipliers(std::span<const double> w, std::span<const double> s, std::span<double> x);
  [[nodiscard]] bool mirrored_slope(const Instant& at);
  void require_regular(bool regular, double t);

  const System* system_;
  ActiveRows rows_;
  SaddleMatrix matrix_;
  bool last_solved_ = false;  // lambda_ solved (1) the last time
  std::vector<double> given_, without_, lambda_, mirrored_, slope_, slope_mirrored_;
  std::vector<double> force_, predicted_, balanced_;
  std::vector<char> reads_;  // per entry of the slope; empty until it is asked for
};

}  // namespace dalembert
