#include <dalembert/constraints/bodies/rigid_body.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/geometry/surfaces.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/joints/revolute.h>
#include <dalembert/constraints/on_surface.h>
#include <dalembert/constraints/rolling.h>
#include <dalembert/core/equations/constraint_type.h>
#include <dalembert/core/scene/scene.h>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

/// What equations cost, per constraint. Compiled by either compiler at -O2 and -O3 (bench/kernels.sh): so
/// much of it as users' programs contain.
namespace dalembert::bench {
namespace {

/// Constraints of one type, in a state of motion.
struct Batch {
  ConstraintBatch constraints;
  std::vector<double> q, v;

  template <int D, class C>
  Batch(const Scene<D>& scene, const std::vector<C>& all)
      : constraints(detail::constraint_type<C>),
        q(scene.initial_positions().begin(), scene.initial_positions().end()),
        v(scene.initial_velocities().begin(), scene.initial_velocities().end()) {
    for (const C& one : all) constraints.add(&one);
  }
};

// Positions that no axis and no symmetry favours, of number i of some.
double some(int i) { return 0.1 + 0.8 * static_cast<double>((37 * i + 11) % 64) / 64.0; }
template <int D>
Vec<D> place(int i) {
  Vec<D> r;
  for (int k = 0; k < D; ++k) r[k] = some(D * i + k) + (k == D - 1 ? 1.0 : 0.0);
  return r;
}
template <int D>
Particle<D> particle(Scene<D>& scene, int i) {
  return scene.add_particle({.mass = 1.0, .position = place<D>(i), .velocity = place<D>(i + 7)});
}

template <int D>
Batch rods(int count) {
  Scene<D> scene;
  std::vector<Distance<Particle<D>, Particle<D>>> all;
  for (int i = 0; i < count; ++i) {
    const auto a = particle(scene, 2 * i), b = particle(scene, 2 * i + 1);
    all.push_back({a, b, 1.0});
  }
  return {scene, all};
}

Batch cones(int count) {
  Scene<3> scene;
  std::vector<OnSurface<Particle<3>, Cone>> all;
  for (int i = 0; i < count; ++i) all.push_back({particle(scene, i), Cone{}});
  return {scene, all};
}

Batch rolling(int count) {
  Scene<2> scene;
  using Track = Fixed<2>;
  std::vector<Rolling<Particle<2>, Track, Track>> all;
  for (int i = 0; i < count; ++i) {
    const auto wheel = scene.add_rotor({.inertia = 1.0, .angle = some(i), .angular_velocity = 1.0});
    all.push_back({particle(scene, i), wheel, Track{{0.0, 0.0}}, Track{{1.0, 0.1}}, 0.5});
  }
  return {scene, all};
}

RigidBody<3> body(Scene<3>& scene, int i) {
  return add_body<3>(scene,
                     {.mass = 1.0,
                      .inertia = {0.1, 0.12, 0.15},
                      .centre = place<3>(i),
                      .velocity = place<3>(i + 3),
                      .angular_velocity = {0.3, -0.2, 0.5}},
                     "body " + std::to_string(i));
}

/// From a point of a body to a particle: 6 inputs of 15 coordinates.
Batch body_points(int count) {
  Scene<3> scene;
  std::vector<Distance<BodyPoint<3>, Particle<3>>> all;
  for (int i = 0; i < count; ++i)
    all.push_back({body(scene, 2 * i).point({0.1, 0.2, 0.3}), particle(scene, 2 * i + 1), 1.0});
  return {scene, all};
}

/// Of two bodies: five equations of five points.
Batch hinges(int count) {
  Scene<3> scene;
  std::vector<Revolute<RigidBody<3>, RigidBody<3>>> all;
  for (int i = 0; i < count; ++i) {
    const auto a = body(scene, 2 * i), b = body(scene, 2 * i + 1);
    all.push_back({a, b, place<3>(i + 5), Vec<3>(0.2, 0.3, 0.9)});
  }
  return {scene, all};
}

/// A user's own, on a circle that moves.
Batch lambdas(int count) {
  Scene<2> scene;
  const auto equation = [](auto t, auto r) { return (r - vec(0.1 * sin(10.0 * t), 0.0)).norm() - 1.0; };
  std::vector<decltype(holonomic(points(Particle<2>{}), equation))> all;
  for (int i = 0; i < count; ++i) all.push_back(holonomic(points(particle(scene, i)), equation));
  return {scene, all};
}

using Kind = Batch (*)(int);

template <class Kernel>
void on(benchmark::State& state, Kind kind, const Kernel& kernel) {
  const auto count = state.range(0);
  const Batch batch = kind(static_cast<int>(count));
  const ConstraintShape shape = batch.constraints.shape();
  const std::size_t rows = static_cast<std::size_t>(count * shape.rows),
                    width = static_cast<std::size_t>(shape.width);
  std::vector<double> g(shape.holonomic ? rows : 0), psi(rows), w(rows * width), gamma(rows),
      lambda(rows, 1.0), psi_q(rows * width), stiffness(static_cast<std::size_t>(count) * width * width);
  const Instant at{0.3, batch.q, batch.v};
  for (auto _ : state) {
    kernel(batch.constraints, at, ConstraintValues{g, psi, w, {}}, gamma, lambda, psi_q, stiffness);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * count);
}

/// Residuals, velocity residuals and gradients.
void gradient(benchmark::State& state, Kind kind) {
  on(state, kind, [](const ConstraintBatch& batch, const Instant& at, const ConstraintValues& out, auto&...) {
    batch.evaluate(at, out);
  });
}
/// These and gamma = psi_q v + psi_t in one pass.
void with_bias(benchmark::State& state, Kind kind) {
  on(state, kind,
     [](const ConstraintBatch& batch, const Instant& at, ConstraintValues out, std::vector<double>& gamma,
        auto&...) {
       out.gamma = gamma;
       batch.evaluate(at, out);
     });
}
void hessian(benchmark::State& state, Kind kind) {
  on(state, kind,
     [](const ConstraintBatch& batch, const Instant& at, const ConstraintValues&, std::vector<double>&,
        std::vector<double>& lambda, std::vector<double>& psi_q,
        std::vector<double>& stiffness) { batch.linearise(at, lambda, psi_q, stiffness); });
}

constexpr int many = 100;
#define DALEMBERT_KERNEL(kernel)                                         \
  BENCHMARK_CAPTURE(kernel, distance_in_the_plane, &rods<2>)->Arg(many); \
  BENCHMARK_CAPTURE(kernel, distance_in_space, &rods<3>)->Arg(many);     \
  BENCHMARK_CAPTURE(kernel, cone, &cones)->Arg(many);                    \
  BENCHMARK_CAPTURE(kernel, rolling, &rolling)->Arg(many);               \
  BENCHMARK_CAPTURE(kernel, body_point, &body_points)->Arg(many);        \
  BENCHMARK_CAPTURE(kernel, joint, &hinges)->Arg(many);                  \
  BENCHMARK_CAPTURE(kernel, lambda_in_time, &lambdas)->Arg(many)
DALEMBERT_KERNEL(gradient);
DALEMBERT_KERNEL(with_bias);
DALEMBERT_KERNEL(hessian);
#undef DALEMBERT_KERNEL

}  // namespace
}  // namespace dalembert::bench
