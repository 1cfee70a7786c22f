#pragma once

#include <dalembert/core/lagrange/embedding.h>
#include <dalembert/solvers/integrator.h>
#include <dalembert/solvers/lagrange/lagrangian_simulation.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

/// The largest difference of one quantity between two motions.
struct Difference {
  double largest = 0.0;  ///< NaN if no sample could be compared
  double unit = 0.0;     ///< what it is compared with
  double time = 0.0;     ///< when it occurs, and
  std::string where{};   ///< of which particle or rotor

  /// The largest over the unit.
  [[nodiscard]] double relative() const { return unit > 0.0 ? largest / unit : largest; }
};

/// How far two formulations of one system are from each other: its scene, of particles and constraints with
/// multipliers, and its Lagrangian.
struct CrossCheck {
  Difference position;  ///< relative to the scene's length
  Difference velocity;  ///< relative to the largest speed, or length over time
  /// Of all forces of constraint on a particle together, Z = W^T lambda against Z = m a - F; relative to the
  /// largest of constraint or applied ones.
  Difference force;
  /// At random states that satisfy both sides' constraints, where the motion need never come: how far the
  /// embedding is from the scene's constraints, the accelerations relative to the largest, and Z as above.
  Difference embedded, acceleration, reaction;  ///< as functions of the Lagrangian's motion
  int states = 0;  ///< how many there were; of 10 those at which either side has no motion are left out

  /// One line for each.
  [[nodiscard]] std::string report() const;
};

namespace detail {
/// Differences of a run of a scene from the same motion by other means, given as flat arrays per sample.
class Comparison {
 public:
  Comparison(const System& system, const Statistics& statistics);
  void add(const FlatSample& sample, std::span<const double> q, std::span<const double> v,
           std::span<const double> Z);
  /// The same at a state of its own, with accelerations; `sample` is of the scene, as near as can be.
  void add_state(const FlatSample& sample, std::span<const double> q, std::span<const double> a,
                 std::span<const double> Z);
  [[nodiscard]] CrossCheck result() const { return found_; }
  /// Throws InvalidArgument unless the first sample agrees to the accuracy asked of a start.
  void require_same_start() const;

 private:
  void compare(double time, std::span<const double> a, std::span<const double> b, bool of_force,
               Difference& found) const;
  void compare_forces(const FlatSample& sample, std::span<const double> Z, Difference& found);

  const System* system_;
  std::vector<double> length_;  ///< of each coordinate: 1, or for an angle the scene's length
  std::vector<double> sum_;     ///< of forces of constraint
  CrossCheck found_;
};

/// Numbers from -1 to 1, the same in every run and on every machine.
[[nodiscard]] std::vector<double> random_numbers(std::size_t count);

/// Compares both sides at states around the start: as far from it as the coordinates' scales, and at rates
/// that move them so far in the motion's own time.
template <int D, int N>
void compare_random_states(const Scene<D>& scene, const LagrangianSystem<N>& system,
                           const Embedding<D, N>& embedding, double t, double time, Comparison& comparison) {
  constexpr std::size_t states = 10;
  const std::vector<double> numbers = random_numbers(2 * N * states);
  const System equations = scene.system();
  const Options begin{.t_end = t + time, .t_start = t, .assemble = true};
  std::vector<double> q(equations.coordinates()), v(q.size()), a(q.size()), Z(q.size());
  for (std::size_t k = 0; k < states; ++k) {
    const double* const own = &numbers[2 * N * k];
    Vec<N> x = Vec<N>::from(own), rate = Vec<N>::from(own + N) / time;
    x += system.position().cwiseQuotient(system.scale());
    try {
      const Integrator lagrangian(system.rotor_scene(t).system(), std::span(x.data(), N),
                                  std::span(rate.data(), N), begin);
      const FlatSample now = lagrangian.sample();
      const auto scaled = [&](std::span<const double> u) -> Vec<N> {
        return system.scale().cwiseProduct(Vec<N>::from(u.data()));
      };
      embedding.write(*equations.layout(), t, scaled(now.q), scaled(now.v), scaled(now.a), q, v, a);
      const Integrator own(equations, q, v, begin);
      constraint_forces(equations, {t, q, v}, a, Z);
      comparison.add_state(own.sample(), q, a, Z);
    } catch (
        const Error&) {  // no state of motion: where a Lagrangian has no inertia, or a joint does not reach
    }
  }
}
}  // namespace detail

/// The motion and the forces of constraint from both formulations of a system (notes, mln5, mln8): `scene`
/// with its constraints, `system` with its Lagrangian, and `embedding`, the positions of the particles as
/// functions of its coordinates. Both runs take the same options.
///
/// The two share steppers but none of the equations. What is never felt in the motion that is run (the spring
/// between two pendulums that are released alike) shows at random states, at whose accelerations and forces
/// both are compared too. What both agree in is right unless both are misstated. Throws InvalidArgument if
/// they do not begin in the same state or the embedding leaves out a particle; else what `simulate` throws.
template <int D, int N>
[[nodiscard]] CrossCheck cross_check(const Scene<D>& scene, const LagrangianSystem<N>& system,
                                     const Embedding<D, N>& embedding, const Options& options) {
  const auto run = simulate(scene, options);
  const auto motion = simulate(system, options);
  const EmbeddedMotion<D> embedded(scene, embedding, motion);
  const System equations = scene.system();
  detail::Comparison comparison(equations, run.statistics());
  for (std::size_t i = 0; i < run.size(); ++i) {
    comparison.add(run.sample(i).flat(), embedded.positions(i), embedded.velocities(i),
                   embedded.constraint_forces(i));
    if (i == 0) comparison.require_same_start();
  }
  const double time = run.statistics().time > 0.0 ? run.statistics().time : options.t_end - options.t_start;
  detail::compare_random_states(scene, system, embedding, options.t_start, time, comparison);
  return comparison.result();
}

}  // namespace dalembert
