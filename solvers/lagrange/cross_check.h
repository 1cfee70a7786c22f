#pragma once

#include <dalembert/core/lagrange/embedding.h>
#include <dalembert/solvers/lagrange/lagrangian_simulation.h>

#include <string>

namespace dalembert {

/// The largest difference of one quantity between two motions.
struct Difference {
  double largest = 0.0;  ///< NaN if no sample could be compared
  double unit = 0.0;     ///< what it is compared with
  double time = 0.0;     ///< when it occurs, and
  std::string where{};   ///< of which particle or rotor

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
  [[nodiscard]] CrossCheck result() const { return found_; }
  /// Throws InvalidArgument unless the first sample agrees to the accuracy asked of a start.
  void require_same_start() const;

 private:
  void compare(double time, std::span<const double> a, std::span<const double> b, bool of_force,
               Difference& found) const;

  const System* system_;
  std::vector<double> length_;  ///< of each coordinate: 1, or for an angle the scene's length
  std::vector<double> sum_;     ///< of forces of constraint
  CrossCheck found_;
};
}  // namespace detail

/// The motion and the forces of constraint from both formulations of a system (notes, mln5, mln8): `scene`
/// with its constraints, `system` with its Lagrangian, and `embedding`, the positions of the particles as
/// functions of its coordinates. Both runs take the same options.
///
/// The two share steppers but none of the equations, so what they agree in is right unless both are
/// misstated. Throws InvalidArgument if they do not begin in the same state or the embedding leaves out a
/// particle; else what `simulate` throws.
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
  return comparison.result();
}

}  // namespace dalembert
