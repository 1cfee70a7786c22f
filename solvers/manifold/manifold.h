#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/manifold/compliant_multipliers.h>
#include <dalembert/solvers/manifold/minimum_norm.h>
#include <dalembert/solvers/manifold/multiplier_forces.h>
#include <dalembert/solvers/manifold/violation.h>
#include <dalembert/solvers/manifold/weakest_direction.h>

#include <optional>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The set of states that obey the constraints: projects a state onto it, and finds the accelerations
/// and multipliers there.
///
/// Position: Newton's iteration for the least mass-weighted change, with q0 the given state,
///
///   [ M  -W^T ] [ dq ]   [  0 ]
///   [ W   0   ] [ y  ] = [ -g ]      (0 in nonholonomic rows).                        (1)
///
/// Velocity: the same matrix with -psi on the right, linear and so done in one solve.        (2)
/// Acceleration and multipliers:
///
///   [ M  -W^T ] [ v'     ]   [    F   ]
///   [ W   0   ] [ lambda ] = [ -gamma ].                                              (3)
///
/// Where forces read multipliers (3) is that of MultiplierForceSolver, with its errors.
///
/// A compliant row takes part with its multiplier as a variable, s = c^2 C in the lower right block:
/// its residuals are g + C lambda, psi + C lambda', W v' + gamma + C lambda'', and y changes lambda by
/// c^2 y. A stiff spring (s small) is treated like a rigid constraint and gets the recovered
/// multiplier; of a soft one (s large) the stepper's own is kept: lambda'' is known to the error of lambda
/// over a step's square, so what it contributes by changing no elongation (between held points) is dropped,
///
///   y := lambda + (S + s)^-1 S (y - lambda),   S = W M^-1 W^T,                         (4)
///
/// which is (3) solved again with 2 lambda - y for lambda. Without `use_multipliers` the multipliers are
/// -g/C, the limit of large s.
///
/// Where rows are redundant, those in use may come to depend on each other while others do not. Wherever the
/// matrix is factored others then take over: which ones are in use shows in no motion and no force.
class Manifold {
 public:
  Manifold(const Problem& problem, const ActiveRows& rows, std::vector<double> lengths);

  /// From here on the multipliers of compliant rows are these, and projected with the state.
  void use_multipliers(const CompliantMultipliers& given);
  [[nodiscard]] bool uses_given_multipliers() const { return given_multipliers_; }

  /// (1), with steps halved until they bring the state closer, until the distance is at most
  /// `tolerance` or no longer shrinks. Returns what is left. Throws EquationFault.
  Violation project_positions(double t, std::span<double> q, std::span<const double> v, double tolerance);
  /// (2) and (3) at positions that satisfy the constraints. False if the matrix is singular there.
  /// `lambda` has one number per row of the system; where rows depend on each other the forces are
  /// those of least norm (see MinimumNorm).
  [[nodiscard]] bool solve_motion(double t, std::span<const double> q, std::span<double> v,
                                  std::span<double> a, std::span<double> lambda);

  /// (2) alone, where it takes more than a correction: the impulses that put v onto the constraints, one per
  /// row of the system, none of compliant ones. Without `use_multipliers`. False if singular.
  [[nodiscard]] bool project_impulsively(double t, std::span<const double> q, std::span<double> v,
                                         std::span<double> impulses);

  /// (3) alone, at any state: the accelerations of the constrained motion. False if singular.
  [[nodiscard]] bool accelerate(const Instant& at, std::span<double> a);
  /// After a step: one step of (1), then (2) and (3) with the matrix of the new positions. What one
  /// step of (1) leaves is the square of what it found. False if singular.
  [[nodiscard]] bool project(double t, std::span<double> q, std::span<double> v, std::span<double> a);
  /// How far a gradient changed in that step of (1), relative to itself: most among the rigid rows in use.
  [[nodiscard]] double turned() const { return turned_; }

  /// The sine of the smallest angle that a row in use makes with others, in the metric of the masses: at a
  /// state, and where the matrix was factored last. 0 where rows depend on each other. Where the matrix does
  /// not tell it (see SaddleMatrix) it is 1, or if rows are redundant the least singular value, which does.
  [[nodiscard]] double sine(const Instant& at);
  [[nodiscard]] double sine() const { return sine_; }
  /// The rows in use, and how often others have taken over: angles of different ones do not compare.
  [[nodiscard]] const ActiveRows& rows() const { return rows_; }
  [[nodiscard]] long exchanges() const { return exchanges_; }
  /// Where the matrix was factored last, in each island the direction of the coordinates that its constraints
  /// constrain least, with the largest entry 1 (as lengths), and the largest violation, as a length, of a
  /// unit of it: 0, as n is, where there are no constraints.
  void weakest_directions(std::span<double> n, std::span<double> response);

  /// How far from each other two branches of the motion pass where the angle of the rows is least.
  struct Gap {
    double distance = 0.0;  ///< as a length; 0 where they cross
    double rounding = 0.0;  ///< below this round-off does not tell it from 0
    std::size_t row = 0;    ///< one that comes to depend on others
  };
  /// At a state close to that place, on the branches or as far from them as its square may be neglected. With
  /// u the weights by which rows depend on each other, n the weakest direction, p that of the motion,
  ///
  ///   f = u g,    f(q + x p + y n) = f + b x y + k y^2/2,
  ///
  /// the branches f = 0 cross if f is 0; else they are the two parts of a hyperbola. No error of the state
  /// enters f but by its square: in no direction does u g change where u W = 0.
  [[nodiscard]] Gap gap(const Instant& at, double length);

  /// The multipliers last found, one per row of the system; 0 in rows that are not in use.
  void multipliers(std::span<double> lambda) const;

  /// Per row of the system, whether the motion gives it one multiplier only.
  [[nodiscard]] std::span<const char> unique() const { return minimum_norm_.unique(); }

  /// The equations at the state last visited.
  [[nodiscard]] const System::Evaluation& equations() const { return e_; }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] long factorisations() const {
    return past_factorisations_ + matrix_.factorisations() + (friction_ ? friction_->factorisations() : 0);
  }
  [[nodiscard]] const char* method() const { return matrix_.method(); }

 private:
  void evaluate(const Instant& at);
  void evaluate_with_bias(const Instant& at);
  [[nodiscard]] bool compliant(std::size_t row) const {
    return system_->in_force(row) && system_->law(row).compliant();
  }
  void add_compliance();
  void weigh_compliance();
  void use(ActiveRows rows);
  [[nodiscard]] bool factorise_those_in_use();
  [[nodiscard]] bool exchange_rows(double own);
  [[nodiscard]] double turned_since(std::span<const double> w) const;
  [[nodiscard]] bool factorise();
  void add_to_multipliers(const std::vector<double>& from, double fraction, std::vector<double>& to);
  void solve_for_position_step(std::size_t n);
  void correct_velocities(std::span<double> v);
  [[nodiscard]] bool solve_for_accelerations(const Instant& at, std::span<double> a);
  [[nodiscard]] bool solve_with_compliance(const Instant& at, std::span<const double> lambda);

  Problem problem_;
  const System* system_;  // points into problem_
  ActiveRows rows_;
  std::vector<double> lengths_;
  System::Evaluation e_;
  std::vector<double> gamma_, x_, q_before_, w_before_;
  CompliantMultipliers multipliers_, multipliers_before_;
  std::vector<double> s_, reflected_;
  bool given_multipliers_ = false;
  SaddleMatrix matrix_;
  MinimumNorm minimum_norm_;
  WeakestDirection weakest_;
  std::optional<MultiplierForceSolver> friction_;  // if any force reads a multiplier
  bool redundant_;
  double turned_ = 0.0;
  double sine_ = 1.0, best_sine_ = 0.0;  // the latter of any rows, where they were compared last
  long evaluations_ = 0, exchanges_ = 0, past_factorisations_ = 0;  // the last by rows that are out of use
};

}  // namespace dalembert
