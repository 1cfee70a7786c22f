#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/manifold/start.h>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A state whose residual no longer falls counts as balanced if it is below this, see
/// BalanceEquations::State.
inline constexpr double residual_tolerance = 1e-10;
/// What is handed on counts as an equilibrium with a hundred times that: as much as a start may violate.
inline constexpr double equilibrium_tolerance = start_tolerance;
/// A sum of forces counts as 0 below this many roundings of the largest of them.
inline constexpr double roundings_of_forces = 100.0;

/// The balance of all forces at a state (q, lambda), and how exactly it is known:
///
///   R1 = F + W^T lambda - M A v,   R2 = g + C lambda,   v = A q + b.
class BalanceEquations {
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

  /// From a consistent start.
  BalanceEquations(const Problem& problem, double time, RotatingFrame frame, Start start);

  /// v, R1, R2 and relative residual of a state's q and lambda. Throws EquationFault.
  void evaluate(State& s) const;
  /// The residual of a state relative to the forces in another.
  [[nodiscard]] static double relative_residual(const State& s, std::span<const double> acting);
  /// Gives each coordinate of a particle the largest number of any of them.
  void share_by_particle(std::span<double> numbers) const;
  /// Independent rows there.
  [[nodiscard]] ActiveRows rows_at(const State& s) const;
  /// The guess, with the multipliers of the motion that begins there.
  [[nodiscard]] State start() const;

  [[nodiscard]] const RotatingFrame& frame() const { return frame_; }
  [[nodiscard]] const Scales& scales() const { return scales_; }
  [[nodiscard]] const System& system() const { return problem_.system(); }
  [[nodiscard]] double time() const { return time_; }
  /// More than the largest K/M at the guess, so that K + s M is regular [1 / time^2].
  [[nodiscard]] double high_stiffness() const { return 10.0 * largest(stiffest_); }

 protected:
  [[nodiscard]] const Problem& problem() const { return problem_; }
  /// Whether R1 is no more than round-off of all forces, summed without sign: they may cancel each other
  /// before those of the constraints are added.
  [[nodiscard]] bool is_round_off_of_its_terms(const State& s) const;
  /// What is known of forces, and the shifts below, by the stiffness at a state.
  void measure_stiffness(const State& s);
  void set_time(double t) { time_ = t; }
  /// The largest K/M of the part of the scene that each coordinate belongs to.
  [[nodiscard]] const std::vector<double>& stiffest() const { return stiffest_; }
  /// For each coordinate an s that keeps K + s M regular along free motions, and the least that does.
  [[nodiscard]] const std::vector<double>& shift() const { return shift_; }
  [[nodiscard]] const std::vector<double>& least_shift() const { return least_shift_; }

 private:
  void share_along_rows(std::span<const double> w);

  Problem problem_;
  double time_;
  RotatingFrame frame_;
  std::vector<double> q0_, lambda0_;
  ActiveRows rows_;
  Scales scales_;
  std::vector<double> stiffest_, shift_, least_shift_;
  /// Of the forces on each coordinate, so that a displacement of round-off unbalances nothing.
  std::vector<double> least_force_;
};

}  // namespace dalembert
