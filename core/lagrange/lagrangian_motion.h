#pragma once

#include <dalembert/core/lagrange/lagrangian_system.h>
#include <dalembert/core/results/trajectory.h>

#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace dalembert {

/// The motion of a Lagrangian system at a sequence of times: coordinates, momenta, the energy function, and
/// the multipliers of its constraints. Every function that takes a number throws InvalidArgument if there is
/// no such sample.
template <int N>
class LagrangianMotion {
 public:
  /// Of a run of `system.rotor_scene(t_start)`, held to a tolerance; so what a run that failed left behind is
  /// read as well: LagrangianMotion<N>(system, failure.trajectory<2>(), tolerance).
  LagrangianMotion(LagrangianSystem<N> system, Trajectory<2> run, double tolerance)
      : system_(std::move(system)),
        equations_(system_.equations()),
        run_(std::move(run)),
        tolerance_(tolerance),
        rank_(run_.size() > 0 ? reactions(0).rank : 0) {}
  LagrangianMotion(const LagrangianMotion&) = default;  ///< shares its run, also of one that is moved
  LagrangianMotion& operator=(const LagrangianMotion&) = default;  ///< shares its run

  /// Of samples.
  [[nodiscard]] std::size_t size() const { return run_.size(); }
  /// Of the samples [time].
  [[nodiscard]] std::span<const double> times() const& { return run_.times(); }
  void times() const&& = delete;
  /// Of the run.
  [[nodiscard]] const Statistics& statistics() const& { return run_.statistics(); }
  /// Whose motion it is.
  [[nodiscard]] const LagrangianSystem<N>& system() const& { return system_; }
  /// At any times of a run with the option `dense`; see Trajectory::at.
  [[nodiscard]] LagrangianMotion at(std::span<const double> times) const {
    LagrangianMotion other = *this;
    other.run_ = run_.at(times);
    return other;
  }

  /// q, q' and q''.
  [[nodiscard]] Vec<N> position(std::size_t i) const {
    return read([&](Rotor rotor) { return run_.angle(rotor, i); });
  }
  /// Its rate.
  [[nodiscard]] Vec<N> velocity(std::size_t i) const {
    return read([&](Rotor rotor) { return run_.angular_velocity(rotor, i); });
  }
  /// Its second derivative.
  [[nodiscard]] Vec<N> acceleration(std::size_t i) const { return system_.scale().cwiseProduct(solved(i).a); }
  /// p = L_v, conserved for cyclic coordinates on which nothing else acts.
  [[nodiscard]] Vec<N> momentum(std::size_t i) const { return terms(i).L_v; }
  /// h = p q' - L, conserved if neither L nor constraints depend on time and no forces Q act.
  [[nodiscard]] double energy_function(std::size_t i) const { return terms(i).energy(velocity(i)); }

  /// lambda, and the generalized force A^T lambda of a constraint on the coordinates. Where constraints are
  /// redundant they are the smallest that give the motion. Throws UndeterminedForce where they are so close
  /// to dependent that the error of the state changes a force by more than the root of the tolerance.
  template <int Rows>
  [[nodiscard]] Multiplier<Rows> multiplier(Constraint<Rows> constraint, std::size_t i) const {
    const std::vector<double> lambda = determined(i).lambda;
    const double* const first = lambda.data() + first_row(constraint);
    if constexpr (Rows == 1) {
      return *first;
    } else {
      return Vec<Rows>::from(first);
    }
  }
  /// Its generalized force A^T lambda, by coordinates.
  template <int Rows>
  [[nodiscard]] Vec<N> constraint_force(Constraint<Rows> constraint, std::size_t i) const {
    const std::size_t first = first_row(constraint);
    const Reactions now = determined(i);
    Vec<N> force = Vec<N>::Zero();
    for (std::size_t r = first; r < first + Rows; ++r)
      force += now.lambda[r] * Vec<N>::from(now.A.data() + r * N);
    return force.cwiseQuotient(system_.scale());
  }

 private:
  [[nodiscard]] auto solved(std::size_t i) const {
    const FlatSample at = run_.sample(i).flat();
    return equations_.solved({at.time, at.q, at.v});
  }
  template <int Rows>
  [[nodiscard]] std::size_t first_row(Constraint<Rows> constraint) const {
    const Layout& layout = run_.sample(0).layout();
    layout.require(constraint);
    return static_cast<std::size_t>(layout.constraints[static_cast<std::size_t>(constraint.index)].first_row);
  }
  /// All multipliers, and what they are solved from.
  struct Reactions {
    std::vector<double> A, lambda;
    double sine;
    int rank;
  };
  [[nodiscard]] Reactions reactions(std::size_t i) const {
    auto now = solved(i);
    auto found = detail::multipliers(now.rows, {now.reaction.data(), N});
    return {std::move(now.rows.A), std::move(found.lambda), found.sine, found.rank};
  }
  [[nodiscard]] Reactions determined(std::size_t i) const {
    Reactions now = reactions(i);
    if (now.sine < std::sqrt(tolerance_) || now.rank < rank_)
      throw UndeterminedForce("The constraints of \"" + system_.name() +
                              "\" are nearly linearly dependent at t = " + detail::text(times()[i]) +
                              ": the state does not determine their forces");
    return now;
  }
  template <class Read>
  [[nodiscard]] Vec<N> read(const Read& of) const {
    Vec<N> x;
    for (int k = 0; k < N; ++k) x[k] = system_.scale()[k] * of(system_.rotors()[static_cast<std::size_t>(k)]);
    return x;
  }
  [[nodiscard]] LagrangeTerms<N> terms(std::size_t i) const {
    return system_.lagrangian()->terms(run_.sample(i).time(), position(i), velocity(i));
  }

  LagrangianSystem<N> system_;
  LagrangeEquations<N> equations_;
  Trajectory<2> run_;
  double tolerance_;
  int rank_;  ///< of the constraints at the start
};

}  // namespace dalembert
