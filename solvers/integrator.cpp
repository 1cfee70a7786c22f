#include "dalembert/solvers/integrator.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/run/diagnosis.h>
#include <dalembert/solvers/run/event_watch.h>
#include <dalembert/solvers/stepping.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

/// Processor time of this thread [s]: what a busy machine does meanwhile does not count.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { total_ += processor_time() - start_; }

 private:
  double& total_;
  double start_ = processor_time();
};

}  // namespace

struct DALEMBERT_HIDDEN Integrator::State {
  State(System s, std::span<const double> q0, std::span<const double> v0, const Options& o,
        std::vector<FlatEvent> events) try
      : options(o),
        times(sample_times(o)),
        system(std::make_shared<const System>(std::move(s))),
        stepping(system, q0, v0, o),
        now(*system, stepping.start()),
        next(now) {
    visit(o.t_start);
    if (!events.empty()) {
      seen = now;
      watch.emplace(std::move(events), *system->layout(), now.flat());
    }
  } catch (const StepFailure& failure) {  // before the first step it is a fault of the start
    throw InconsistentStart(failure.what);
  } catch (const EquationFault& fault) {
    throw InconsistentStart(fault.what());
  }

  /// If anything fails the current moment stays as it is.
  void visit(double time) {
    stepping.read(time, next);
    std::swap(now, next);
  }

  void step_once(double wanted) {
    if (++steps > options.max_steps) {
      throw StepFailure{"max_steps = " + std::to_string(options.max_steps) +
                            " is used up; raise it, or ask for a looser tolerance",
                        stepping.time()};
    }
    stepping.step(wanted);
    if (watch) watch->look([this](double t) { return read(t); }, stepping.time(), stepping.degree());
  }
  FlatSample read(double t) {
    stepping.read(t, *seen);
    return seen->flat();
  }

  /// Where an event ends the run, or its last step went so far.
  [[nodiscard]] double reached() const { return ended() ? *watch->end() : stepping.time(); }
  [[nodiscard]] bool ended() const { return watch && watch->end(); }
  void require_not_ended(const char* what) const {
    if (!ended() || now.t < *watch->end()) return;
    std::ostringstream text;
    text << what << ": an event has ended the run at t = " << *watch->end();
    throw InvalidArgument(text.str());
  }

  void go_to(double time) {
    while (stepping.time() < time && !ended()) step_once(time);
    visit(ended() ? std::min(time, reached()) : time);
  }

  template <class Observe>
  void for_each_sample(const Observe& observe) {
    for (const double t : times) {
      if (t < now.t) continue;
      if (t > now.t) guarded([&] { go_to(t); });
      observe(now.flat());
      if (ended() && now.t >= reached()) break;
    }
  }

  /// Runs `f`; whatever stops it becomes an IntegrationFailure with the samples so far.
  template <class F>
  void guarded(const F& f) {
    try {
      const Stopwatch stopwatch(run_time);
      f();
    } catch (const StepFailure& failure) {
      fail(failure.what, failure.time);
    } catch (const EquationFault& fault) {
      fail(fault.what(), stepping.time());
    }
  }

  [[noreturn]] void fail(const std::string& why, double time) {
    const std::string suspect = stepping.suspect();
    auto kept = std::make_shared<Record>(record);
    kept->statistics = statistics();
    kept->dense = stepping.dense();
    if (watch) watch->write(*kept);
    std::ostringstream what;
    what.precision(10);
    what << "Scene \"" << system->layout()->scene << "\" stopped at t = " << time << ": " << why;
    for (const auto& more : {suspect, coarse_time(stepping.start().scales, time), kept->statistics.advice})
      if (!more.empty()) what << "; " << more;
    throw IntegrationFailure(what.str(), time, std::move(kept));
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics s = stepping.statistics();
    s.run_time = run_time;
    return s;
  }

  [[nodiscard]] Record empty_record() const {
    return {.layout = system->layout(),
            .stepper = name(options.stepper),
            .tolerance = options.tolerance,
            .times = {},
            .values = {},
            .unique = {},
            .statistics = {},
            .dense = {},
            .events = {},
            .at_events = {}};
  }

  Options options;
  std::vector<double> times;
  std::shared_ptr<const System> system;
  Stepping stepping;
  Moment now, next;
  std::optional<Moment> seen;  // by events
  std::optional<EventWatch> watch;
  long steps = 0;
  double run_time = 0.0;
  Record record = empty_record();
};

Integrator::Integrator(System system, std::span<const double> q, std::span<const double> v,
                       const Options& options, std::vector<FlatEvent> events)
    : state_(std::make_unique<State>(std::move(system), q, v, options, std::move(events))) {}
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator::~Integrator() = default;

FlatSample Integrator::sample() const { return state_->now.flat(); }
const System& Integrator::system() const { return *state_->system; }
std::span<const Occurrence> Integrator::events() const {
  return state_->watch ? std::span<const Occurrence>(state_->watch->found()) : std::span<const Occurrence>();
}
Statistics Integrator::statistics() const { return state_->statistics(); }

void Integrator::step() {
  State& s = *state_;
  if (s.now.t >= s.options.t_end) {
    std::ostringstream what;
    what << "step(): t_end = " << s.options.t_end << " is reached; choose a later one in the options";
    throw InvalidArgument(what.str());
  }
  s.require_not_ended("step()");
  s.guarded([&s] {
    if (s.stepping.time() < s.options.t_end && !s.ended()) s.step_once(s.options.t_end);
    s.visit(s.reached());
  });
}

void Integrator::advance_to(double t) {
  State& s = *state_;
  if (!(t >= s.now.t && t <= s.options.t_end)) {
    std::ostringstream what;
    what << "advance_to(" << t << "): must lie between the current time " << s.now.t
         << " and t_end = " << s.options.t_end;
    throw InvalidArgument(what.str());
  }
  if (t > s.now.t) s.require_not_ended("advance_to");
  s.guarded([&] { s.go_to(t); });
}

void Integrator::run(const std::function<void(const FlatSample&)>& observe) {
  if (state_->options.dense)
    throw InvalidArgument("dense = true keeps all steps for Trajectory::at: not where no sample is kept");
  state_->for_each_sample(observe);
}

std::shared_ptr<const Record> Integrator::run() {
  State& s = *state_;
  s.record.clear();
  s.record.reserve(s.times.size(), s.now.flat());
  s.for_each_sample([&s](const FlatSample& sample) { s.record.append(sample); });
  // The samples are handed over, not copied: they may be most of the memory.
  auto record = std::make_shared<Record>(std::exchange(s.record, s.empty_record()));
  record->statistics = s.statistics();
  record->dense = s.stepping.dense();
  if (s.watch) s.watch->write(*record);
  return record;
}

}  // namespace dalembert
