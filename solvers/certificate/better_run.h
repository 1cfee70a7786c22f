#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/options.h>
#include <dalembert/solvers/certificate/two_runs.h>

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace DALEMBERT_HIDDEN dalembert {

/// Runs one scene with options; called on two threads at once.
using Run = std::function<std::shared_ptr<const Record>(const Options&)>;

/// A run as far as it got, and what stopped it.
struct FinishedRun {
  std::shared_ptr<const Record> record;
  std::string stopped{};
  std::exception_ptr failure{};
  double reached = 0.0;  ///< where it was stopped
};
[[nodiscard]] FinishedRun finish(const Run& run, const Options& options);
/// Two on two threads.
[[nodiscard]] std::pair<FinishedRun, FinishedRun> finish_both(const Run& run, const Options& a,
                                                              const Options& b);

/// With a second run at a hundredth of the tolerance estimates are within 5 % of the true errors at 1.3
/// to 1.8 times the cost of the run; at a tenth they were 0.2 to 1.1 of them.
inline constexpr double hundredth = 0.01;

/// The options of a run that certifies one with these: at this part of the tolerance, as far as there is one.
/// The motion between samples and the ledger are of the run that is handed out.
[[nodiscard]] Options tighter(Options options, Stepper by, double part = hundredth);

/// What an implicit run passes over: vibrations of which it takes less than three steps a period. It damps
/// them as its tolerance allows. However small they are, their forces are as large as what began them: those
/// of a load that is set on a stiff cable swing by its weight for ever. Explicit steps follow them, as far as
/// a run with these options was cut short before something happens: for 25 steps of the implicit run or 200
/// of the explicit one. (What begins to vibrate later is not seen.)
[[nodiscard]] PassedOver passed_over(const Run& run, const Options& options, const Record& implicit,
                                     const FinishedRun& cut_short);

/// The run that the options ask for, and one at a hundredth of its tolerance, or at a hundredth of that again
/// until it claims to be more accurate by what TwoRuns needs. Throws what the first one throws.
///
/// The second is explicit where that takes no more steps than an implicit run (a stiff scene is one where it
/// does), so that the two seldom have more in common than the equations; there the two run one after the
/// other, and the second costs a part of the first. Two explicit ones run on two threads. Beside two implicit
/// ones the begin is run by explicit steps, see `passed_over`.
[[nodiscard]] TwoRuns run_twice(const Run& run, const Options& options);

}  // namespace dalembert
