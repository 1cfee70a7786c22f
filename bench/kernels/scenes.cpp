#include <dalembert/bench/kernels/scenes.h>

#include <benchmark/benchmark.h>

namespace dalembert::bench {
namespace {

/// What a scene of rods costs to state, and to copy: a copy compares no names and checks nothing. Per rod.
void build(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(loose_rods<2>(static_cast<int>(state.range(0))));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
void copy(benchmark::State& state) {
  const Scene<2> rods = loose_rods<2>(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(Scene<2>(rods));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(build)->Arg(1)->Arg(1000);
BENCHMARK(copy)->Arg(1)->Arg(1000);

}  // namespace
}  // namespace dalembert::bench
