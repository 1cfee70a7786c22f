#include "dalembert/solvers/integrator.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/audit/auditor.h>
#include <dalembert/solvers/event_log.h>
#include <dalembert/solvers/integration.h>
#include <dalembert/solvers/run/diagnosis.h>
#include <dalembert/solvers/run/stopwatch.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

/// An impact would have to give impulses to what reads the force of a contact.
void require_no_force_reads(const System& system) {
  for (std::size_t k = 0; k < system.multiplier_force_pattern().size(); ++k) {
    for (const std::size_t c : system.contacts()) {
      const Layout::Constraint& contact = system.layout()->constraints[c];
      if (system.multiplier_force_pattern()[k].column != contact.own_rows().front()) continue;
      throw InvalidScene(system.name_of_multiplier_force(k) + " reads the force of " + contact.label() +
                         ", which is one-sided: state it as a bilateral one, and end the run by an event "
                         "where its force vanishes");
    }
  }
}

}  // namespace

struct DALEMBERT_HIDDEN Integrator::Run {
  Run(System s, std::span<const double> q0, std::span<const double> v0, const Options& o,
      std::vector<FlatEvent> events) try
      : options(o),
        times(sample_times(o)),
        system(std::make_shared<const System>(std::move(s))),
        begin{q0, v0},
        conditional(find_conditional()),
        integration(conditional ? conditional->system() : system, begin.q, begin.v, o, begin.nearest_contact),
        now(*system, integration.start(), EventLog::changes(events)),
        next(now) {
    if (o.audit != Audited::off) auditor.emplace(system, o, [this](bool reached) { return claim(reached); });
    if (conditional) conditional->adopt(integration.start().scales);
    if (!events.empty() || conditional)
      log.emplace(std::move(events), conditional.get(), conditional ? &begin.change : nullptr,
                  auditor ? &*auditor : nullptr, integration);
    visit(o.t_start);                     // what the log has opened there exerts no force
  } catch (const StepFailure& failure) {  // before the first step it is a fault of the start
    throw InconsistentStart(failure.what);
  } catch (const EquationFault& fault) {
    throw InconsistentStart(fault.what());
  }

  /// A start, in q and v that stay where they are.
  struct Begin {
    std::span<const double> q, v;
    std::vector<double> own_q{};
    ConditionalConstraints::Change change{};
    double nearest_contact = std::numeric_limits<double>::infinity();
  };

  /// The constraints that do not always hold, if there are any: where the others hold, with those in force
  /// that are, after the impacts of the start.
  std::unique_ptr<ConditionalConstraints> find_conditional() {
    const auto numbers = system->conditional_constraints();
    if (numbers.empty()) return nullptr;
    require_no_force_reads(*system);
    begin.nearest_contact = nearest_contact(*system, {options.t_start, begin.q, begin.v});
    Start start =
        first_start(Problem(system->without(numbers)), begin.q, begin.v, options, begin.nearest_contact);
    const Instant at{options.t_start, start.q, start.v};
    auto found = std::make_unique<ConditionalConstraints>(system, start.scales, options.tolerance, at);
    begin.change = found->resolve_start(at);
    begin.own_q = std::move(start.q);
    begin.q = begin.own_q;
    begin.v = begin.change.v;
    return found;
  }

  /// If anything fails the current moment stays as it is.
  void visit(double time) {
    audit_to(time);
    integration.read(time, next);
    if (auditor) auditor->sample(next.flat());
    std::swap(now, next);
    read_from = integration.shared_system();
  }

  void step_once(double wanted) {
    if (++steps > options.max_steps) {
      throw StepFailure{"max_steps = " + std::to_string(options.max_steps) +
                            " was reached; raise it, or ask for a looser tolerance",
                        integration.time()};
    }
    audit_to(reached());
    if (log) log->carry_out(integration);
    if (log && log->pending()) return;
    integration.step(wanted);
    if (auditor && auditor->follows_steps()) auditor->step(integration.time(), integration.velocities());
    if (log) log->locate(integration);
  }

  /// With a ledger every step is gone over, up to where the run stands.
  void audit_to(double time) {
    if (!auditor) return;
    auditor->follow(time, [this](double t) {
      integration.read(t, next);
      return next.flat();
    });
  }

  [[nodiscard]] Claim claim(bool reached) const {
    const Scales& scales = integration.start().scales;
    if (!reached && !scales.length_from_path) return {scales.length, scales.time, options.tolerance};
    const Statistics so_far = integration.statistics(this->reached());
    return {so_far.length, so_far.time, std::max(options.tolerance, so_far.accuracy)};
  }

  /// Where an event ends the run, or its last step went so far.
  [[nodiscard]] double reached() const { return log ? log->reached() : integration.time(); }
  [[nodiscard]] bool ended() const { return log && log->end(); }
  void require_not_ended(const char* what) const {
    if (!ended() || now.t < *log->end()) return;
    std::ostringstream text;
    text << what << ": an event has ended the run at t = " << *log->end();
    throw InvalidArgument(text.str());
  }

  void go_to(double time) {
    while (reached() < time && !ended()) step_once(time);
    visit(std::min(time, reached()));
    finish();
  }

  /// What changes where the run ends is carried out, though no step follows; not before all of the last step
  /// has been read.
  void finish() {
    const auto at_end = [this] { return now.t >= options.t_end || (ended() && now.t >= reached()); };
    while (log && log->pending() && at_end()) log->carry_out(integration);
  }

  template <class Observe>
  void for_each_sample(const Observe& observe) {
    require_not_stopped();
    const Stopwatch::While timed(stopwatch, true);
    for (const double t : times) {
      if (t < now.t) continue;
      if (t > now.t) guarded([&] { go_to(t); });
      observe(now.flat());
      if (ended() && now.t >= reached()) break;
    }
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
      throw stop(failure.what, failure.time);
    } catch (const EquationFault& fault) {
      throw stop(fault.what(), reached(), false);
    } catch (const Error& fault) {
      throw stop(fault.what(), reached());
    } catch (...) {
      stop("an exception interrupted it", reached());
      throw;
    }
  }

  /// What also may be amiss is said where a step failed, not where an equation did.
  const IntegrationFailure& stop(const std::string& why, double time, bool of_step = true) {
    const std::string suspect = integration.unbounded_multiplier();
    auto kept = std::make_shared<Record>(record);
    kept->statistics = statistics();
    kept->dense = dense(std::min(time, reached()));
    keep_ledger(*kept);
    if (log) log->write(*kept);
    std::ostringstream what;
    what.precision(10);
    what << "Scene \"" << system->layout()->scene << "\" stopped at t = " << time << ": " << why;
    for (const auto& more : {suspect, coarse_time(integration.start().scales, time), kept->statistics.advice})
      if (of_step && !more.empty()) what << "; " << more;
    return stopped.emplace(what.str(), time, std::move(kept));
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics s = integration.statistics(this->reached());
    s.run_time = stopwatch.read();
    if (auditor) {
      s.audit = auditor->read();
      s.accuracy = std::max(s.accuracy, auditor->accuracy());
    }
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
  Begin begin;
  std::unique_ptr<ConditionalConstraints> conditional;  // if any constraint does not always hold
  Integration integration;
  OutputState now, next;
  std::shared_ptr<const System> read_from;  // `now` is of its layout
  std::optional<Auditor> auditor;           // unless the options turn it off
  std::optional<EventLog> log;              // if there is anything to be listed
  long steps = 0;
  Stopwatch stopwatch;
  std::optional<IntegrationFailure> stopped;
  Record record = empty_record();
};

Integrator::Integrator(System system, std::span<const double> q, std::span<const double> v,
                       const Options& options, std::vector<FlatEvent> events)
    : run_(std::make_unique<Run>(std::move(system), q, v, options, std::move(events))) {}
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator::~Integrator() = default;

FlatSample Integrator::sample() const { return run_->now.flat(); }
const System& Integrator::system() const { return *run_->read_from; }
std::span<const EventRecord> Integrator::events() const {
  return run_->log ? std::span<const EventRecord>(run_->log->occurred()) : std::span<const EventRecord>();
}
Statistics Integrator::statistics() const { return run_->statistics(); }

void Integrator::step() {
  Run& s = *run_;
  if (s.now.t >= s.options.t_end) {
    std::ostringstream what;
    what << "step(): t_end = " << s.options.t_end << " is reached; choose a later one in the options";
    throw InvalidArgument(what.str());
  }
  s.require_not_ended("step()");
  const Stopwatch::While timed(s.stopwatch, true);
  s.guarded([&s] {
    if (s.reached() < s.options.t_end && !s.ended()) s.step_once(s.options.t_end);
    s.visit(s.reached());
    s.finish();
  });
}

void Integrator::advance_to(double t) {
  Run& s = *run_;
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
  if (run_->options.dense)
    throw InvalidArgument("dense = true keeps all steps for Trajectory::at: not where no sample is kept");
  run_->for_each_sample([&](const FlatSample& sample) {
    const Stopwatch::While untimed(run_->stopwatch, false);  // it is the user's
    observe(sample);
  });
}

std::shared_ptr<const Record> Integrator::run() {
  Run& s = *run_;
  s.record.clear();
  s.record.reserve(s.times.size(), s.now.flat());
  s.for_each_sample([&s](const FlatSample& sample) {
    s.record.use_layout(s.read_from->layout());
    s.record.append(sample);
    if (s.auditor) s.auditor->keep(sample);
  });
  // The samples are handed over, not copied: they may be most of the memory.
  auto record = std::make_shared<Record>(std::exchange(s.record, s.empty_record()));
  record->statistics = s.statistics();
  record->dense = s.dense(s.reached());
  s.keep_ledger(*record);
  if (s.log) s.log->write(*record);
  return record;
}

}  // namespace dalembert
