#include <dalembert/bench/kernels/scenes.h>

#include <benchmark/benchmark.h>

namespace dalembert::bench {
namespace {

/// What an evaluation of rods costs, per rod.
template <int D, class Kernel>
void on_rods(benchmark::State& state, const Kernel& kernel) {
  const Posed rods(loose_rods<D>(static_cast<int>(state.range(0))));
  kernel(state, rods);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// Residuals, velocity residuals and gradients.
template <int D>
void gradient(benchmark::State& state) {
  on_rods<D>(state, [](benchmark::State& running, const Posed& rods) {
    auto out = rods.system().evaluation();
    for (auto _ : running) {
      rods.system().evaluate(rods.instant(), out);
      benchmark::DoNotOptimize(out.w.data());
      benchmark::ClobberMemory();
    }
  });
}

template <int D>
void hessian(benchmark::State& state) {
  on_rods<D>(state, [](benchmark::State& running, const Posed& rods) {
    auto out = rods.system().linearisation();
    for (auto _ : running) {
      rods.system().linearise(rods.instant(), rods.start.lambda, out);
      benchmark::DoNotOptimize(out.stiffness.data());
      benchmark::ClobberMemory();
    }
  });
}

/// gamma = psi_q v + psi_t.
template <int D>
void bias(benchmark::State& state) {
  on_rods<D>(state, [](benchmark::State& running, const Posed& rods) {
    std::vector<double> gamma(rods.start.lambda.size());
    for (auto _ : running) {
      rods.system().bias(rods.instant(), gamma);
      benchmark::DoNotOptimize(gamma.data());
      benchmark::ClobberMemory();
    }
  });
}

BENCHMARK(gradient<2>)->Arg(1)->Arg(1000);
BENCHMARK(gradient<3>)->Arg(1)->Arg(1000);
BENCHMARK(hessian<2>)->Arg(1)->Arg(1000);
BENCHMARK(hessian<3>)->Arg(1)->Arg(1000);
BENCHMARK(bias<2>)->Arg(1)->Arg(1000);
BENCHMARK(bias<3>)->Arg(1)->Arg(1000);

}  // namespace
}  // namespace dalembert::bench
