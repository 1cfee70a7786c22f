#include "dalembert/bench/contest.h"

#include <limits>

namespace dalembert::bench {

namespace {

Entry refused(const Error& why, const Statistics& so_far) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {{.error_position = nan, .error_force = nan, .energy_drift = nan, .statistics = so_far},
          refused_by(why)};
}

template <int D>
Entry measure_rival(const Contest<D>& contest, Contender contender, const Options& options,
                    std::span<const models::Observation<D>> reference) {
  const MethodRun<D> gave = run(contest.methods, contender, options);
  models::Measurement measured = models::compare<D>(contest.model, gave.seen, reference);
  measured.statistics = gave.statistics;
  return {measured};
}

}  // namespace

template <int D>
Entry Contest<D>::measure(Contender contender, Options options,
                          std::span<const models::Observation<D>> reference) const try {
  const std::optional<Stepper> own = stepper(contender);
  if (!own) return measure_rival<D>(*this, contender, options, reference);
  options.stepper = *own;
  return {models::measure<D>(model, options, reference)};
} catch (const IntegrationFailure& failed) {
  return refused(failed, failed.trajectory<D>().statistics());
} catch (const Error& failed) {
  return refused(failed, {});
}

template struct Contest<2>;
template struct Contest<3>;

}  // namespace dalembert::bench
