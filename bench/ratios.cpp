#include "dalembert/bench/ratios.h"

#include <dalembert/bench/methods.h>
#include <dalembert/bench/progress.h>
#include <dalembert/bench/work_precision_curve.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace dalembert::bench {

namespace {

using AnyContest = std::variant<Contest<2>, Contest<3>>;

Contest<2> chain(int beads, double t_end) {
  const models::Chain system{.beads = beads};
  Contest<2> contest{system.model(), methods(system)};
  contest.model.name = "chain-" + std::to_string(beads);
  contest.model.t_end = t_end;
  // To round-off this would take minutes; so it is a hundredth of the least error asked for.
  contest.model.observations = [system](std::span<const double> times) {
    return system.reference(times, models::Real(1e-12));
  };
  return contest;
}

/// A peer would take many minutes.
Contest<2> without_peers(Contest<2> contest) {
  std::erase_if(contest.methods, [](const auto& method) { return method.first != Contender::hand; });
  return contest;
}

template <class System>
AnyContest of(const System& system) {
  return Contest{system.model(), methods(system)};
}

std::vector<std::pair<std::string, std::function<AnyContest()>>> scenes() {
  return {{"plane-pendulum", [] { return of(models::PlanePendulum{}); }},
          {"cone", [] { return of(models::ConeSlide{}); }},
          {"double-pendulum", [] { return of(models::DoublePendulum{}); }},
          {"chain-10", [] { return AnyContest(chain(10, 1.0)); }},
          {"chain-100", [] { return AnyContest(chain(100, 1.0)); }},
          {"chain-1000", [] { return AnyContest(without_peers(chain(1000, 0.3))); }}};
}

template <int D>
double run_time(const std::vector<WorkPrecisionCurve<D>>& curves, Contender contender, double error) {
  for (const WorkPrecisionCurve<D>& curve : curves) {
    if (curve.contender() == contender) return curve.crossing(error).run_time;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

template <int D>
std::vector<WorkPrecisionCurve<D>> reaching(const Contest<D>& contest,
                                            std::span<const models::Observation<D>> reference,
                                            const Ratios& options, Progress& progress) {
  std::vector<WorkPrecisionCurve<D>> curves;
  for (const Contender contender : options.steppers) {
    if (contest.admits(contender)) curves.emplace_back(contest, contender, reference, options.limit);
  }
  for (WorkPrecisionCurve<D>& curve : curves) {
    progress.next(contest.model.name + ", " + name(curve.contender()));
    for (const double error : options.errors) curve.reach(error);
  }
  progress.next(contest.model.name + ", all in turn");
  for (int i = 0; i < options.repeats; ++i) {
    for (WorkPrecisionCurve<D>& curve : curves) curve.repeat();
  }
  return curves;
}

/// Whether an error was reached, missed at every tolerance, or no tolerance ran at all.
std::string outcome(const auto& crossing, double error) {
  if (crossing.error <= error) return "ok";
  return std::isfinite(crossing.error) ? "missed" : "refused";
}

template <int D>
void race(const Contest<D>& contest, const Ratios& options, Progress& progress, Table& table) {
  const auto reference =
      contest.model.observations(sample_times({.t_end = contest.model.t_end, .samples = 2}));
  const auto curves = reaching<D>(contest, reference, options, progress);
  for (const double error : options.errors) {
    for (const WorkPrecisionCurve<D>& curve : curves) {
      const auto at = curve.crossing(error);
      table.rows.push_back({contest.model.name, shortest_power(error), name(curve.contender()),
                            scientific(at.tolerance, 2), scientific(at.error, 2), scientific(at.run_time),
                            scientific(at.run_time / run_time(curves, Contender::hand, error), 3),
                            scientific(at.run_time / run_time(curves, Contender::simbody_rod, error), 3),
                            outcome(at, error)});
    }
  }
}

void require_known(const std::vector<std::string>& names) {
  const auto known = scenes();
  for (const std::string& name : names) {
    const bool exists =
        std::any_of(known.begin(), known.end(), [&](const auto& s) { return s.first == name; });
    if (!exists && name != "all") throw Error("no scene \"" + name + "\"; there are: all, " + known_scenes());
  }
}

}  // namespace

std::string known_scenes() {
  std::string names;
  for (const auto& scene : scenes()) names += (names.empty() ? "" : ", ") + scene.first;
  return names;
}

void ratios(const Ratios& options) {
  require_known(options.scenes);
  require_writable(options.report);
  const auto chosen = [&](const std::string& name) {
    return std::any_of(options.scenes.begin(), options.scenes.end(),
                       [&](const std::string& s) { return s == "all" || s == name; });
  };
  Table table{.columns = {"scene", "error", "stepper", "tolerance", "error_reached", "run_time_s",
                          "ratio_to_hand", "ratio_to_rod", "outcome"},
              .rows = {}};
  {
    Progress progress(scenes().size() * (options.steppers.size() + 1));
    for (const auto& [name, make] : scenes()) {
      if (!chosen(name)) continue;
      std::visit([&](const auto& contest) { race(contest, options, progress, table); }, make());
    }
  }
  report("Time to reach an error of position at the end of a run, medians of " +
             std::to_string(options.repeats) + " rounds" + remark(options.steppers),
         table, options.report);
}

}  // namespace dalembert::bench
