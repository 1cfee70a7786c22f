#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/balance_equations.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The search for a state in which all forces balance, see `equilibrium`.
class EquilibriumSolver : public BalanceEquations {
 public:
  /// Projects the guess onto the constraint manifold. `length` is the scene's; 0: its own, see Options, or
  /// static_length. Throws InconsistentStart, NoEquilibrium.
  EquilibriumSolver(const Problem& problem, std::span<const double> guess, double time,
                    const UniformRotation<3>& turning, double length = 0.0);
  /// The scene's time is at most `longest`, if the frame does not rotate.
  EquilibriumSolver(const Problem& problem, std::span<const double> guess, double time, RotatingFrame frame,
                    double length = 0.0, double longest = std::numeric_limits<double>::infinity());

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

 private:
  /// The same search, with what the stiffness at this state tells about forces.
  [[nodiscard]] EquilibriumSolver measured_at(const State& s) const;
  /// The same search at another time.
  [[nodiscard]] EquilibriumSolver at_time(double t) const;
  [[nodiscard]] bool step(const State& s, std::span<const double> shift, std::vector<double>& x) const;
  [[nodiscard]] bool stays(const State& s) const;
  [[nodiscard]] double lengths_of(const std::vector<double>& x) const;
  [[nodiscard]] static double power(const State& s, const std::vector<double>& x);
  [[nodiscard]] State moved(const State& s, const std::vector<double>& x, double part) const;
  [[nodiscard]] double part_in_the_valley(const State& s, const std::vector<double>& x) const;
  [[nodiscard]] bool improve(State& s, const std::vector<double>& x) const;
  [[nodiscard]] bool leaps_uphill(const State& s, const std::vector<double>& x) const;
  [[nodiscard]] double correction(const State& s) const;
  void newton(State& s, std::span<const double> shift) const;
  [[nodiscard]] bool has_other_multipliers(State& s) const;
  [[nodiscard]] std::string remedy(std::size_t row) const;
  [[noreturn]] void refuse(const State& s, const std::string& why) const;

  mutable std::shared_ptr<const TangentMatrix::Pattern> tangent_;  // of the last step
};

}  // namespace dalembert
