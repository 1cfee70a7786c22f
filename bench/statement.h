#pragma once

#include <dalembert/dalembert.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace dalembert::bench {

/// What one way of stating a scene gave.
struct Motion {
  double run_time = 0.0;  ///< [s]
  long steps = 0;
  std::vector<std::vector<Vec<3>>> samples;  ///< per sample the points watched; z = 0 in the plane
};

/// One way of stating a scene.
struct Statement {
  std::size_t unknowns;
  std::function<Motion(const Options&)> run;
};

/// A scene and its points whose motion is compared.
template <int D>
struct Watched {
  Scene<D> scene;
  std::vector<Particle<D>> points = {};
};

[[nodiscard]] inline Vec<3> in_space(const Vec<2>& r) { return {r.x(), r.y(), 0.0}; }
[[nodiscard]] inline Vec<3> in_space(const Vec<3>& r) { return r; }

/// Of the stabilised index-2 equations: q, v, lambda, mu.
template <int D>
[[nodiscard]] std::size_t unknowns(const Scene<D>& scene) {
  const System system = scene.system();
  return 2 * system.coordinates() + system.rows() + system.holonomic_rows();
}

/// One motion from several scenes, run one after the other; `unknowns` are those of the largest.
/// Scenes stand in a deque: growing, it neither copies nor moves them.
template <int D>
[[nodiscard]] Statement state(std::deque<Watched<D>> scenes) {
  std::size_t largest = 0;
  for (const Watched<D>& watched : scenes) largest = std::max(largest, unknowns(watched.scene));
  const auto shared = std::make_shared<const std::deque<Watched<D>>>(std::move(scenes));
  return {largest, [shared](const Options& options) {
            Motion motion;
            for (const Watched<D>& watched : *shared) {
              const Trajectory<D> run = simulate(watched.scene, options);
              motion.run_time += run.statistics().run_time;
              motion.steps += run.statistics().steps;
              motion.samples.resize(run.size());
              for (std::size_t i = 0; i < run.size(); ++i)
                for (const Particle<D>& p : watched.points)
                  motion.samples[i].push_back(in_space(run.position(p, i)));
            }
            return motion;
          }};
}
template <int D>
[[nodiscard]] Statement state(Watched<D> scene) {
  std::deque<Watched<D>> one;
  one.push_back(std::move(scene));
  return state(std::move(one));
}

}  // namespace dalembert::bench
