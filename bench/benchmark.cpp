#include "dalembert/bench/benchmark.h"

#include <limits>

namespace dalembert::bench {

namespace {

template <int D>
Result measure_other(const Benchmark<D>& benchmark, Method method, const Options& options,
                     std::span<const models::Observation<D>> reference) {
  const MethodRun<D> gave = run(benchmark.methods, method, options);
  Result result{models::compare<D>(benchmark.model, gave.seen, reference)};
  result.statistics = gave.statistics;
  return result;
}

}  // namespace

template <int D>
Result Benchmark<D>::measure(Method method, Options options,
                             std::span<const models::Observation<D>> reference) const try {
  const std::optional<Stepper> own = stepper(method);
  if (!own) return measure_other<D>(*this, method, options, reference);
  options.stepper = *own;
  return {models::measure<D>(model, options, reference)};
} catch (const Error& error) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {{nan, nan, nan, statistics_of(error)}, outcome_of(error)};
}

template struct Benchmark<2>;
template struct Benchmark<3>;

}  // namespace dalembert::bench
