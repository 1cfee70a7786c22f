#pragma once

#include <dalembert/bench/benchmark.h>

#include <set>
#include <vector>

namespace dalembert::bench {

/// The runs of one method at falling tolerances, half a decade apart, compared at the end of the run.
template <int D>
class WorkPrecisionCurve {
 public:
  /// What an error costs.
  struct Crossing {
    double tolerance;  ///< of the first run that meets the error, or if none does of the best one
    double error;      ///< of that run
    double run_time;   ///< at the error itself; of that run if none meets it [s]
  };

  /// `reference`: the observations of the model at the two ends of the run. No run is added after a run
  /// longer than `limit` [s], and none as long is repeated.
  WorkPrecisionCurve(const Benchmark<D>& benchmark, Method method,
                     std::span<const models::Observation<D>> reference, double limit)
      : benchmark_(&benchmark), method_(method), reference_(reference), limit_(limit) {}

  /// Adds runs until two in turn meet the error: one may do so by a lucky sign.
  void reach(double error);
  /// Runs the runs about each error reached once more, short ones several times.
  void repeat();
  [[nodiscard]] Crossing crossing(double error) const;
  [[nodiscard]] Method method() const { return method_; }

 private:
  struct Tried {
    double tolerance;
    double error;                   ///< infinite if the run failed
    std::vector<double> run_times;  ///< none if it failed
  };
  [[nodiscard]] Tried run(double tolerance) const;
  [[nodiscard]] bool ended() const;
  [[nodiscard]] bool crossed(double error) const;
  /// The run to which this error is ascribed.
  [[nodiscard]] std::size_t first_below(double error) const;

  const Benchmark<D>* benchmark_;
  Method method_;
  std::span<const models::Observation<D>> reference_;
  double limit_;
  std::vector<Tried> runs_;
  std::set<std::size_t> repeated_;
};

extern template class WorkPrecisionCurve<2>;
extern template class WorkPrecisionCurve<3>;

}  // namespace dalembert::bench
