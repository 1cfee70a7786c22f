#include <dalembert/bench/kernels/scenes.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/ida/ida.h>

#include <benchmark/benchmark.h>

#include <memory>

namespace dalembert::bench {
namespace {

/// IDA starts with order 1 and tiny steps; after this many its order and step have grown to what the motion
/// requires.
constexpr int settling_steps = 200;
/// Steps timed before the run starts anew, so that however long this takes the same motion is measured.
constexpr int steps_of_a_run = 200;

/// One step of a chain, without output.
template <class AnyStepper>
void step(benchmark::State& state) {
  const Options options{.t_end = 1e3};
  const Posed posed(models::Chain{.beads = static_cast<int>(state.range(0))}.scene().scene, options);
  const auto settled = [&] {
    auto stepper = std::make_unique<AnyStepper>(posed.problem, posed.start, options);
    for (int i = 0; i < settling_steps; ++i) stepper->step(options.t_end);
    return stepper;
  };
  try {
    auto stepper = settled();
    int left = steps_of_a_run;
    for (auto _ : state) {
      if (left == 0) {
        state.PauseTiming();
        stepper = settled();
        left = steps_of_a_run;
        state.ResumeTiming();
      }
      stepper->step(options.t_end);
      --left;
    }
  } catch (const StepFailure& failure) {
    state.SkipWithError(failure.what.c_str());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// An output: interpolation, projection onto the constraints, accelerations and forces of constraint.
template <Stepper stepper>
void recovery(benchmark::State& state) {
  const models::Chain chain{.beads = static_cast<int>(state.range(0))};
  Simulation<2> simulation(chain.scene().scene, {.t_end = 1.0, .stepper = stepper});
  constexpr double t = 0.01;
  simulation.advance_to(t);
  for (auto _ : state) simulation.advance_to(t);  // no step: the time has been passed
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK(step<IdaStepper>)->Arg(10)->Arg(1000);
BENCHMARK(step<ErkStepper>)->Arg(10)->Arg(1000);
BENCHMARK(recovery<Stepper::ida>)->Arg(10)->Arg(1000);
BENCHMARK(recovery<Stepper::erk>)->Arg(10)->Arg(1000);

}  // namespace
}  // namespace dalembert::bench
