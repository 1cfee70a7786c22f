#include "dalembert/solvers/integrator.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/audit/auditor.h>
#include <dalembert/solvers/event_handler.h>
#include <dalembert/solvers/integration.h>
#include <dalembert/solvers/opening.h>
#include <dalembert/solvers/run/diagnosis.h>
#include <dalembert/solvers/run/stopwatch.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace dalembert {

struct DALEMBERT_HIDDEN Integrator::Run {
  Run(System s, std::span<const double> q0, std::span<const double> v0, const Options& o,
      std::vector<FlatEvent> asked_for) try
      : options(o),
        times(sample_times(o)),
        system(std::make_shared<const System>(std::move(s))),
        opening(open_run(system, q0, v0, o)),
        integration(opening.problem, std::move(opening.start), opening.sides, o),
        stop{integration.time()},
        now(*system, integration.start(), EventHandler::any_changes_scene(asked_for)),
        next(now) {
    if (o.audit != Audited::off) auditor.emplace(system, o, [this](bool reached) { return claim(reached); });
    if (!asked_for.empty() || opening.conditional) {
      handler.emplace(std::move(asked_for), opening.conditional.get(), auditor ? &*auditor : nullptr,
                      integration);
      if (opening.conditional) handler->list_at_start(std::move(opening.change), integration);
      if (integration.at_switch()) (void)resolve();
      stop = handler->restart(Stop{integration.time()}, nullptr, integration);
    } else if (integration.at_switch()) {
      (void)integration.go_behind_switch();
    }
    visit(o.t_start);                     // contacts that would pull are open by now
  } catch (const StepFailure& failure) {  // before the first step it is a fault of the start
    throw InconsistentStart(failure.what);
  } catch (const EquationFault& fault) {
    throw InconsistentStart(fault.what());
  }

  /// The loop of a run.
  void advance(double to) {
    while (stop.time < to && !stop.ends_run) step_once(to);
  }

  /// A turn of it: from what the last step came to, a step to the earliest event that changes something, or
  /// ends the run. It is resolved by the next turn, so that all before it is read from the steps before it.
  void step_once(double wanted) {
    count_turn();
    audit_to(stop.time);
    if (!stop.changes.empty() || (handler && integration.at_switch())) start_next_segment();
    if (!stop.changes.empty() || stop.ends_run) return;  // by what the change has made jump
    integration.step(wanted);
    if (auditor && auditor->follows_steps()) auditor->step(integration.time(), integration.velocities());
    if (handler) {
      handler->locate(integration, stop);
    } else {
      stop.time = integration.time();
    }
  }

  void start_next_segment() {
    if (const auto before = resolve()) {
      const FlatSample at = before->flat();
      stop = handler->restart(stop, &at, integration);
    }
  }

  /// Resolves what a switch of the equations changes, or else the first change that is due, and goes on from
  /// it. Returns the state before, if anything has changed.
  std::optional<OutputState> resolve() {
    const bool at_switch = integration.at_switch(stop.time);
    if (at_switch) stop.time = integration.time();
    integration.read(stop.time, next);
    OutputState before = next;
    const EventList::Side side{before.flat(), integration.system().layout()};
    audit(side.sample);
    std::optional<Change> change =
        at_switch ? handler->go_behind_switch(integration) : handler->resolve(stop, side.sample, integration);
    if (!change) return std::nullopt;
    integration.restart_with_constraints(stop.time, change->system, change->q, change->v);
    stop.made.reset();
    if (!at_switch) {
      stop.made = stop.changes.front();
      stop.changes.erase(stop.changes.begin());
    }
    handler->list(std::move(*change), side, integration);
    return before;
  }

  /// A run whose steps would not reach its end, and did not when it was last looked at, is told why, if a
  /// force holds it.
  void look_for_chatter() {
    const double t = integration.time(), step = (t - looked.time) / static_cast<double>(steps - looked.steps);
    const bool slow = (options.t_end - t) > step * static_cast<double>(options.max_steps - steps);
    std::string chatters = slow ? integration.chattering_force(step) : std::string{};
    const bool again = looked.chatters;
    looked = {t, steps, !chatters.empty()};
    if (again && looked.chatters) throw StepFailure{std::move(chatters), t};
  }

  void count_turn() {
    constexpr unsigned long first_look = 1024;  // from 512 or 4096 on the same runs stop
    if (++steps >= static_cast<long>(first_look) && std::has_single_bit(static_cast<unsigned long>(steps)))
      look_for_chatter();
    if (steps <= options.max_steps) return;
    const bool short_steps =
        options.max_step > 0.0 &&
        static_cast<double>(options.max_steps) * options.max_step < options.t_end - options.t_start;
    throw StepFailure{
        "max_steps = " + std::to_string(options.max_steps) +
            (short_steps ? " was reached; raise it, or max_step, of which so many do not reach t_end"
                         : " was reached; raise it, or ask for a looser tolerance"),
        integration.time()};
  }

  /// If anything fails the current state stays as it is.
  void visit(double time) {
    audit_to(time);
    integration.read(time, next);
    audit(next.flat());
    std::swap(now, next);
    read_from = integration.shared_system();
  }

  /// Where the steps came to before one failed, if that obeys the laws.
  void visit_last() try {
    if (stop.time > now.t) visit(stop.time);
  } catch (...) {
    return;  // the run is stopping: what stops it is known already
  }

  void audit(const FlatSample& sample) {
    if (auditor) integration.as_read(sample.time, [&] { auditor->sample(sample); });
  }

  /// With a ledger every step is gone over, up to where the run stands.
  void audit_to(double time) {
    if (!auditor) return;
    auditor->follow(time, [this](double t, const LedgerKeeper::Use& use) {
      integration.read(t, next);
      integration.as_read(t, [&] { use(next.flat()); });
    });
  }

  [[nodiscard]] Claim claim(bool reached) const {
    const Scales& scales = steps > 0 ? integration.start().scales : opening.given;
    if (steps == 0 || (!reached && !scales.length_from_path))
      return {scales.length, scales.time, options.tolerance};
    const Statistics so_far = integration.statistics(stop.time);
    return {so_far.length, so_far.time, std::max(options.tolerance, so_far.accuracy)};
  }

  /// Whether an event has ended the run where it is now.
  [[nodiscard]] bool ended() const { return stop.ends_run && now.t >= stop.time; }
  void require_not_ended(const char* what) const {
    if (!ended()) return;
    std::ostringstream text;
    text << what << ": an event has ended the run at t = " << stop.time;
    throw InvalidArgument(text.str());
  }

  void go_to(double time) {
    advance(time);
    visit(std::min(time, stop.time));
    finish();
  }

  /// What changes where the run ends is resolved, though no step follows; not before all of the last step has
  /// been read.
  void finish() {
    while (!stop.changes.empty() && (now.t >= options.t_end || ended())) start_next_segment();
  }

  template <class Observe>
  void for_each_sample(const Observe& observe) {
    require_not_stopped();
    const Stopwatch::While timed(stopwatch, true);
    for (const double t : times) {
      if (t < now.t) continue;
      if (t > now.t) guarded([&] { go_to(t); });
      observe(now.flat());
      if (ended()) return;
    }
    if (now.t >= options.t_end) return;  // events are those of the whole run
    guarded([&] { go_to(options.t_end); });
    if (ended()) observe(now.flat());
  }

  void require_not_stopped() const {
    if (stopped) throw IntegrationFailure(*stopped);
  }

  /// Runs `f`; what stops it, other than lack of memory and a defect, becomes an IntegrationFailure with the
  /// samples so far. The run has stopped then, in the middle of something: nothing goes on from there.
  template <class F>
  void guarded(const F& f) {
    require_not_stopped();
    try {
      f();
    } catch (const StepFailure& failure) {
      throw stopped_by(failure.what, failure.time);
    } catch (const EquationFault& fault) {
      throw stopped_by(fault.what(), stop.time, false);
    } catch (const Error& fault) {
      throw stopped_by(fault.what(), stop.time);
    } catch (...) {
      stopped_by("an exception interrupted it", stop.time);
      throw;
    }
  }

  /// What also may be amiss is said where a step failed, not where an equation did.
  const IntegrationFailure& stopped_by(const std::string& why, double time, bool of_step = true) {
    visit_last();
    const std::string suspect = integration.unbounded_multiplier();
    auto kept = std::make_shared<Record>(record);
    kept->statistics = statistics();
    kept->dense = dense(std::min(time, stop.time));
    keep_ledger(*kept);
    if (handler) handler->events().write(*kept);
    std::ostringstream what;
    what.precision(10);
    what << "Scene \"" << system->layout()->scene << "\" stopped at t = " << time << ": " << why;
    for (const auto& more : {suspect, coarse_time(integration.start().scales, time), kept->statistics.advice})
      if (of_step && !more.empty()) what << "; " << more;
    return stopped.emplace(what.str(), time, std::move(kept));
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics s = integration.statistics(stop.time);
    s.run_time = stopwatch.read();
    if (auditor) {
      s.audit = auditor->read();
      s.accuracy = std::max(s.accuracy, auditor->accuracy());
    }
    if (auto coarse = coarse_steps(s.accuracy); !coarse.empty()) s.advice = std::move(coarse);
    return s;
  }

  [[nodiscard]] std::shared_ptr<const DenseOutput> dense(double end) {
    auto steps = integration.dense(end);
    return auditor ? auditor->watch(std::move(steps)) : steps;
  }

  void keep_ledger(Record& of) const {
    if (auditor && auditor->ledger()) of.ledger = std::make_shared<const Ledger>(*auditor->ledger());
  }

  [[nodiscard]] Record empty_record() const {
    return {.layout = system->layout(),
            .later = {},
            .stepper = name(options.stepper),
            .tolerance = options.tolerance,
            .times = {},
            .values = {},
            .unique = {},
            .statistics = {},
            .dense = {},
            .events = {},
            .at_events = {},
            .after_events = {},
            .impulses = {}};
  }

  Options options;
  std::vector<double> times;
  std::shared_ptr<const System> system;
  Opening opening;
  Integration integration;
  Stop stop;
  OutputState now, next;
  std::shared_ptr<const System> read_from;  // `now` is of its layout
  std::optional<Auditor> auditor;           // unless the options turn it off
  std::optional<EventHandler> handler;      // if there is anything to be found
  long steps = 0;
  /// What the last look for chatter found, and when it was.
  struct Look {
    double time;
    long steps;
    bool chatters;
  } looked{options.t_start, 0, false};
  Stopwatch stopwatch;
  std::optional<IntegrationFailure> stopped;
  Record record = empty_record();
};

Integrator::Integrator(System system, std::span<const double> q, std::span<const double> v,
                       const Options& options, std::vector<FlatEvent> events)
    : run_(std::make_unique<Run>(std::move(system), q, v, options, std::move(events))) {}
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator::~Integrator() = default;

Integrator::Run& Integrator::its() const {
  if (run_) return *run_;
  throw InvalidArgument("this simulation was moved: use the one that it was moved into");
}

FlatSample Integrator::sample() const { return its().now.flat(); }
const System& Integrator::system() const { return *its().read_from; }
std::span<const EventRecord> Integrator::events() const {
  const auto& handler = its().handler;
  return handler ? std::span(handler->events().events()) : std::span<const EventRecord>();
}
Statistics Integrator::statistics() const { return its().statistics(); }

void Integrator::step() {
  Run& s = its();
  if (s.now.t >= s.options.t_end) {
    std::ostringstream what;
    what << "step(): t_end = " << s.options.t_end << " is reached; choose a later one in the options";
    throw InvalidArgument(what.str());
  }
  s.require_not_ended("step()");
  const Stopwatch::While timed(s.stopwatch, true);
  s.guarded([&s] {
    if (s.stop.time < s.options.t_end && !s.stop.ends_run) s.step_once(s.options.t_end);
    s.visit(s.stop.time);
    s.finish();
  });
}

void Integrator::advance_to(double t) {
  Run& s = its();
  if (!(t >= s.now.t && t <= s.options.t_end)) {
    std::ostringstream what;
    what << "advance_to(" << t << "): must lie between the current time " << s.now.t
         << " and t_end = " << s.options.t_end;
    throw InvalidArgument(what.str());
  }
  if (t > s.now.t) s.require_not_ended("advance_to");
  const Stopwatch::While timed(s.stopwatch, true);
  s.guarded([&] { s.go_to(t); });
}

void Integrator::run(const std::function<void(const FlatSample&)>& observe) {
  Run& s = its();
  if (s.options.dense)
    throw InvalidArgument("dense = true keeps all steps for Trajectory::at: not where no sample is kept");
  s.for_each_sample([&](const FlatSample& sample) {
    const Stopwatch::While untimed(s.stopwatch, false);  // it is the user's
    observe(sample);
  });
}

std::shared_ptr<const Record> Integrator::run() {
  Run& s = its();
  s.record.clear();
  s.record.reserve(s.times.size(), s.now.flat());
  s.for_each_sample([&s](const FlatSample& sample) {
    s.record.use_layout(s.read_from->layout());
    s.record.append(sample);
    if (s.auditor) s.integration.as_read(sample.time, [&] { s.auditor->keep(sample); });
  });
  // The samples are handed over, not copied: they may be most of the memory.
  auto record = std::make_shared<Record>(std::exchange(s.record, s.empty_record()));
  record->statistics = s.statistics();
  record->dense = s.dense(s.stop.time);
  s.keep_ledger(*record);
  if (s.handler) s.handler->events().write(*record);
  return record;
}

}  // namespace dalembert
