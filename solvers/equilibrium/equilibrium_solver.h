#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/start.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A state whose residual no longer falls counts as balanced if it is below this, see
/// EquilibriumSolver::State.
inline constexpr double residual_tolerance = 1e-10;
/// What is handed on counts as an equilibrium with a hundred times that: as much as a start may violate.
inline constexpr double equilibrium_tolerance = start_tolerance;

/// The search for a state (q, lambda) in which all forces balance, see `equilibrium`:
///
///   R1 = F + W^T lambda - M A v,   R2 = g + C lambda,   v = A q + b.                                (1)
class EquilibriumSolver {
 public:
  struct State {
    std::vector<double> q{}, v{}, lambda{};
    double scale = 0.0;                       ///< of forces: the largest that balance here
    std::vector<double> acting{};             ///< the largest on the particle of each coordinate
    std::vector<double> force{}, distance{};  ///< R1, and R2 of all holonomic rows
    /// The larger of R1 over the forces on its own particle, and of R2 over the scene's length.
    double relative_residual = 0.0;
    double relative_violation = 0.0;  ///< R2's part of it
    /// Whether R1 is nowhere more than round-off of the forces, and R2 none.
    bool round_off = false;
  };

  /// Projects the guess onto the constraint manifold. `length` is the scene's; 0: its own, see Options, or
  /// static_length. Throws InconsistentStart, NoEquilibrium.
  EquilibriumSolver(const Problem& problem, std::span<const double> guess, double time,
                    const UniformRotation<3>& turning, double length = 0.0);
  /// The scene's time is at most `longest`, if the frame does not rotate.
  EquilibriumSolver(const Problem& problem, std::span<const double> guess, double time, RotatingFrame frame,
                    double length = 0.0, double longest = std::numeric_limits<double>::infinity());

  /// v, R1, R2 and relative residual of a state's q and lambda. Throws EquationFault.
  void evaluate(State& s) const;
  /// Gives each coordinate of a particle the largest number of any of them.
  void share_by_particle(std::span<double> numbers) const;
  /// Independent rows there.
  [[nodiscard]] ActiveRows rows_at(const State& s) const;
  /// The guess, with the multipliers of the motion that begins there.
  [[nodiscard]] State start() const;
  /// Whether a state is an equilibrium to this part of its forces and lengths: its residual is as small, or
  /// so is Newton's correction (where a force grows as x^3 it is as small as its own change), or what is left
  /// is round-off of the forces of which it is the sum.
  [[nodiscard]] bool is_equilibrium(const State& s, double close) const;
  /// Newton's iteration from a state; false if it does not converge.
  [[nodiscard]] bool solve(State& s) const;
  /// Descends until Newton's iteration converges. Throws NoEquilibrium.
  void descend(State& s) const;
  /// Projects positions onto the constraint manifold, with the multipliers of the motion that begins there;
  /// false if that fails.
  [[nodiscard]] bool project(State& s) const;
  /// The same, then solves from there.
  [[nodiscard]] bool project_and_solve(State& s) const { return project(s) && solve(s); }
  /// Throws NoEquilibrium unless the state persists.
  void require_lasting(const State& s) const;
  /// The state with its forces, those of dependent rows of least norm.
  [[nodiscard]] std::shared_ptr<const Record> record(const State& s) const;

  [[nodiscard]] const RotatingFrame& frame() const { return frame_; }
  [[nodiscard]] const Scales& scales() const { return scales_; }
  [[nodiscard]] const System& system() const { return *system_; }
  [[nodiscard]] double time() const { return time_; }
  /// More than the largest K/M at the guess, so that K + s M is regular [1 / time^2].
  [[nodiscard]] double high_stiffness() const { return 10.0 * largest(stiffest_); }

 private:
  /// The residual of a state relative to the forces in another.
  [[nodiscard]] static double relative_residual(const State& s, std::span<const double> acting);
  [[nodiscard]] bool step(const State& s, std::span<const double> shift, std::vector<double>& x) const;
  [[nodiscard]] double lengths_of(const std::vector<double>& x) const;
  [[nodiscard]] static double power(const State& s, const std::vector<double>& x);
  [[nodiscard]] State moved(const State& s, const std::vector<double>& x, double part) const;
  [[nodiscard]] double part_in_the_valley(const State& s, const std::vector<double>& x) const;
  [[nodiscard]] bool improve(State& s, const std::vector<double>& x) const;
  [[nodiscard]] bool leaps_uphill(const State& s, const std::vector<double>& x) const;
  [[nodiscard]] double correction(const State& s) const;
  [[nodiscard]] bool is_round_off_of_its_terms(const State& s) const;
  void newton(State& s, std::span<const double> shift) const;
  [[nodiscard]] bool has_other_multipliers(State& s) const;
  void measure_stiffness(const State& s);
  void share_along_rows(std::span<const double> w);
  [[nodiscard]] std::string remedy(std::size_t row) const;
  [[noreturn]] void refuse(const State& s, const std::string& why) const;

  Problem problem_;
  const System* system_;  // points into problem_
  double time_;
  RotatingFrame frame_;
  std::vector<double> q0_, lambda0_;
  ActiveRows rows_;
  Scales scales_;
  std::vector<double> stiffest_;             // of each coordinate: the largest K/M of the part it belongs to
  std::vector<double> shift_, least_shift_;  // see measure_stiffness
  /// Of the forces on each coordinate, so that a displacement of round-off unbalances nothing.
  std::vector<double> least_force_;
  mutable std::shared_ptr<const TangentMatrix::Pattern> tangent_;  // of the last step
};

}  // namespace dalembert
