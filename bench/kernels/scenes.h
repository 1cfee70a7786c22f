#pragma once

#include <dalembert/models/chain.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/start.h>

#include <numeric>
#include <span>
#include <vector>

namespace dalembert::bench {

/// Rods that share no point, in motion.
template <int D>
[[nodiscard]] Scene<D> loose_rods(int count) {
  Scene<D> scene("rods");
  for (int i = 0; i < count; ++i) {
    const Vec<D> place = i * Vec<D>::UnitX();
    const auto a = scene.add_particle({.mass = 1.0, .position = place, .velocity = Vec<D>::UnitX()});
    const auto b = scene.add_particle({.mass = 1.0, .position = place + Vec<D>::UnitY()});
    scene.add(Distance{a, b, 1.0});
  }
  return scene;
}

/// A scene's equations and a state of it, for a kernel to be called on.
struct DALEMBERT_HIDDEN Posed {
  template <int D>
  explicit Posed(const Scene<D>& scene, const Options& options = {.t_end = 1.0})
      : problem(scene.system()),
        start(consistent_start(problem, scene.initial_positions(), scene.initial_velocities(), options)),
        equations(system().evaluation()) {
    system().evaluate(instant(), equations);
  }

  [[nodiscard]] const System& system() const { return problem.system(); }
  [[nodiscard]] std::shared_ptr<const SaddlePattern> pattern() const {
    return problem.pattern(start.rows.rows);
  }
  [[nodiscard]] Instant instant() const { return {0.0, start.q, start.v}; }
  [[nodiscard]] std::span<const double> w() const { return equations.w; }
  /// As many numbers as coordinates and rows, none of them zero.
  [[nodiscard]] std::vector<double> right_hand_side() const {
    std::vector<double> b(static_cast<std::size_t>(system().coordinates() + start.rows.size()));
    std::iota(b.begin(), b.end(), 1.0);
    return b;
  }

  Problem problem;
  Start start;
  System::Evaluation equations;
};

[[nodiscard]] inline Posed chain(int beads) { return Posed(models::Chain{.beads = beads}.scene().scene); }

}  // namespace dalembert::bench
