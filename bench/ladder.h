#pragma once

#include <dalembert/bench/contest.h>

#include <set>
#include <vector>

namespace dalembert::bench {

/// The runs of one contender at falling tolerances, half a decade a rung, compared at the end of the run.
template <int D>
class Ladder {
 public:
  /// What an error costs.
  struct Crossing {
    double tolerance;  ///< of the first rung that meets the error, or if none does of the best one
    double error;      ///< of that rung
    double run_time;   ///< at the error itself; of that rung if none meets it [s]
  };

  /// `reference`: the observations of the model at the two ends of the run. No rung is added after a run
  /// longer than `limit` [s], and none as long is repeated.
  Ladder(const Contest<D>& contest, Contender contender, std::span<const models::Observation<D>> reference,
         double limit)
      : contest_(&contest), contender_(contender), reference_(reference), limit_(limit) {}

  /// Adds rungs until two in turn meet the error: one may do so by a lucky sign.
  void climb(double error);
  /// Runs the rungs about each error climbed to once more, short ones several times.
  void repeat();
  [[nodiscard]] Crossing crossing(double error) const;
  [[nodiscard]] Contender contender() const { return contender_; }

 private:
  struct Rung {
    double tolerance;
    double error;                   ///< infinite if the run failed
    std::vector<double> run_times;  ///< none if it failed
  };
  [[nodiscard]] Rung run(double tolerance) const;
  [[nodiscard]] bool ended() const;
  [[nodiscard]] bool crossed(double error) const;
  /// The rung to which this error is ascribed.
  [[nodiscard]] std::size_t first_below(double error) const;

  const Contest<D>* contest_;
  Contender contender_;
  std::span<const models::Observation<D>> reference_;
  double limit_;
  std::vector<Rung> rungs_;
  std::set<std::size_t> repeated_;
};

extern template class Ladder<2>;
extern template class Ladder<3>;

}  // namespace dalembert::bench
