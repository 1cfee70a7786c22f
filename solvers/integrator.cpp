#include "dalembert/solvers/integrator.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/ida/ida.h>
#include <dalembert/solvers/manifold/manifold.h>
#include <dalembert/solvers/manifold/recovery.h>
#include <dalembert/solvers/manifold/start.h>
#include <dalembert/solvers/run/outgrown.h>
#include <dalembert/solvers/run/singularity.h>
#include <dalembert/solvers/run/sticking.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <sstream>
#include <utility>
#include <variant>

namespace dalembert {

namespace {

/// Times known no better than to this part of the scene's own are worth a word when a run stops.
constexpr double coarse_time = 1e-10;

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

using AnyStepper = std::variant<IdaStepper, ErkStepper>;

AnyStepper make_stepper(const System& system, const Start& start, const Options& options) {
  if (options.stepper == Stepper::erk) {
    return AnyStepper(std::in_place_type<ErkStepper>, system, start, options);
  }
  return AnyStepper(std::in_place_type<IdaStepper>, system, start, options);
}

/// The start of a run. What has no length but that of its path gets that of a first explicit step, whose
/// error is within the tolerance of its own length.
Start first_start(const System& system, std::span<const double> q, std::span<const double> v,
                  const Options& options) {
  Start start = consistent_start(system, q, v, options);
  if (!start.scales.of_path) return start;
  try {
    ErkStepper first(system, start, options);
    first.step(options.t_end);
    const Scales& scales = first.scales();
    start.scales.of_path = scales.way.length > Scales::least;  // else it rests, and any length will do
    if (start.scales.of_path) start.scales.take(scales.way);
  } catch (const StepFailure&) {
    start.scales.of_path = false;  // the run will stop, and say why
  }
  return start;
}

}  // namespace

struct DALEMBERT_HIDDEN Integrator::State {
  State(System s, std::span<const double> q0, std::span<const double> v0, const Options& o) try
      : options(o),
        times(sample_times(o)),
        system(std::move(s)),
        start(first_start(system, q0, v0, o)),
        lever(start.scales.lever()),
        manifold(std::in_place, system, start.rows, lever),
        stepper(make_stepper(system, start, o)),
        now(system, start),
        next(now),
        recovery(system, start, o.tolerance),
        angle{o.t_start, 1.0} {
    if (system.compliant()) {
      for (auto* numbers : {&springs.lambda, &springs.rate, &springs.second})
        numbers->resize(start.lambda.size());
    }
    record.layout = system.layout();
    record.stepper = name(o.stepper);
    record.tolerance = o.tolerance;
    const auto count = [](std::size_t equations) { return static_cast<int>(equations); };
    record.statistics.degrees_of_freedom =
        count(system.coordinates() + system.compliant_rows()) - count(start.rows.size());
    record.statistics.redundant_equations = count(system.rows() - start.rows.size());
    if (system.frictional() && o.stepper == Stepper::ida)
      sticking.emplace(system, start, o.t_start, o.tolerance);
    visit(o.t_start);
    best_sine = manifold->sine();
  } catch (const StepFailure& failure) {  // before the first step it is a fault of the start
    throw InconsistentStart(failure.what);
  } catch (const EquationFault& fault) {
    throw InconsistentStart(fault.what());
  }

  /// The state at a time that the stepper has passed, put onto the constraints, with its forces. If
  /// anything fails the current moment stays as it is.
  void visit(double time) {
    next.t = time;
    interpolate(time, next.q, next.v);
    if (const auto rows = better_rows()) {
      Manifold other(system, *rows, lever);
      follow_springs(time, other);
      recover(other, next);
      record.statistics.evaluations += other.evaluations();
      record.statistics.factorisations += other.factorisations();
    } else {
      recover(*manifold, next);
    }
    std::swap(now, next);
  }

  /// The stepper's state, with the forces that it has found for compliant constraints.
  void interpolate(double time, std::span<double> q, std::span<double> v) {
    std::visit([&](auto& s) { s.interpolate(time, q, v); }, stepper);
    follow_springs(time, *manifold);
  }

  void follow_springs(double time, Manifold& follower) {
    if (!system.compliant()) return;
    if (const auto* ida = std::get_if<IdaStepper>(&stepper); ida != nullptr && ida->springs(time, springs))
      follower.follow(springs);
  }

  [[nodiscard]] double stepper_time() const {
    return std::visit([](const auto& s) { return s.time(); }, stepper);
  }

  void recover(Manifold& on, Moment& m) {
    recovery.recover(on, m);
    auto& s = record.statistics;
    s.residual_position = std::max(s.residual_position, m.position.size);
    s.residual_velocity = std::max(s.residual_velocity, m.velocity.size);
    s.correction = std::max(s.correction, m.correction);
  }

  [[nodiscard]] FlatSample sample() const {
    return {now.t, now.q, now.v, now.a, now.lambda, now.forces, now.energy, now.unique};
  }

  void step_once(double wanted) {
    if (++steps > options.max_steps) {
      throw StepFailure{"max_steps = " + std::to_string(options.max_steps) +
                            " is used up; raise it, or ask for a looser tolerance",
                        stepper_time()};
    }
    // Before a step, so that all output within the last has been read from the stepper that took it.
    follow_rows();
    if (options.stepper == Stepper::ida) watch_angle();
    if (steps == 1) watch_sliding();
    try {
      std::visit([wanted](auto& s) { s.step(wanted); }, stepper);
    } catch (const StepFailure&) {
      // Newton's iteration may fail anywhere; where the constraints are close to dependent the explicit
      // stepper goes on.
      if (handed_over || options.stepper == Stepper::erk || !(sine() < constants.handover_sine)) throw;
      hand_over();
    }
    watch_sliding();
  }

  /// The explicit stepper finds itself where friction sticks.
  void watch_sliding() {
    if (!sticking) return;
    interpolate(stepper_time(), next.q, next.v);
    sticking->watch(stepper_time(), next.q, next.v);
  }

  [[nodiscard]] double sine() const {
    return std::visit([](const auto& s) { return s.sine(); }, stepper);
  }

  [[nodiscard]] bool redundant() const { return start.rows.size() < system.rows(); }

  /// The rows in use are independent at the start of the run; on the way they may come to depend on each
  /// other while others do not.
  void follow_rows() {
    if (!redundant()) return;
    next.t = stepper_time();
    interpolate(next.t, next.q, next.v);
    if (better_rows()) restart(handed_over ? Stepper::erk : options.stepper);
  }

  /// Rows that make much larger angles at `next` than those in use. They are looked for where the angle of
  /// these is much less than the best was when last looked for.
  std::optional<ActiveRows> better_rows() {
    if (!redundant()) return std::nullopt;
    const Instant at{next.t, next.q, next.v};
    const double own = manifold->sine(at);
    if (own >= constants.worn * best_sine) return std::nullopt;
    ActiveRows rows = independent_rows(system, manifold->equations().w, start.rows);
    const double best = Manifold(system, rows, lever).sine(at);
    if (own < constants.worn * best) return rows;
    best_sine = std::max(own, best);
    return std::nullopt;
  }

  /// Isolated singular positions are passed by the explicit stepper (see ErkStepper), from where they come in
  /// sight until they are as far behind.
  void watch_angle() {
    const Angle before = std::exchange(angle, {stepper_time(), sine()});
    if (!handed_over) {
      const double left = time_to_singular(before, angle);
      if (angle.sine < constants.handover_sine && left < constants.handover_steps * (angle.t - before.t))
        hand_over();
      return;
    }
    if (angle.sine <= before.sine || angle.sine < sine_at_handover) return;
    handed_over = false;
    restart(Stepper::ida);
  }
  void hand_over() {
    handed_over = true;
    sine_at_handover = angle.sine;
    restart(Stepper::erk);
  }

  /// A fresh choice of rows and a fresh stepper where the present one stands.
  void restart(Stepper kind) {
    const double t = stepper_time();
    std::vector<double> q0(next.q.size()), v0(next.q.size());
    interpolate(t, q0, v0);
    // The explicit stepper takes -g/C for the forces of compliant constraints: g must be as exact.
    if (system.compliant()) manifold->project_positions(t, q0, v0, 0.1 * start.scales.rounding(q0));
    count(record.statistics);
    record.statistics.advice.clear();  // of a crossing it would be about the wrong stepper
    Options from_here = options;
    from_here.t_start = t;
    from_here.stepper = kind;
    // Close to a singular position a step of the explicit stepper is to err by no more than one of the other.
    if (kind != options.stepper)
      from_here.tolerance = std::max(constants.share_of_a_step * options.tolerance, smallest_tolerance);
    start = begin_anew(system, start, t, q0, v0);
    manifold.emplace(system, start.rows, lever);
    best_sine = manifold->sine({t, start.q, start.v});
    stepper = make_stepper(system, start, from_here);
    if (sticking) sticking.emplace(system, start, t, options.tolerance);
    next = Moment(system, start);
    angle = {t, 1.0};
  }

  void step_past(double time) {
    while (stepper_time() < time) step_once(time);
  }

  /// Runs `f`; whatever stops it becomes an IntegrationFailure with the samples so far.
  template <class F>
  void guarded(const F& f) {
    try {
      const Stopwatch stopwatch(record.statistics.run_time);
      f();
    } catch (const StepFailure& failure) {
      fail(failure.what, failure.time);
    } catch (const EquationFault& fault) {
      fail(fault.what(), stepper_time());
    }
  }

  /// The constraint whose force has grown without bound where the stepper stands, if there is one.
  [[nodiscard]] std::string outgrown() {
    try {
      interpolate(stepper_time(), next.q, next.v);
      if (!manifold->solve_motion(stepper_time(), next.q, next.v, next.a, next.lambda)) return {};
      return outgrown_constraint(system, start.scales, manifold->equations().w, next.lambda, lambda_at_start);
    } catch (const std::exception&) {
      return {};  // the run is stopping: what stops it is known already
    }
  }

  [[noreturn]] void fail(const std::string& why, double time) {
    const std::string suspect = outgrown();
    auto kept = std::make_shared<Record>(record);
    kept->statistics = statistics();
    std::ostringstream what;
    what.precision(10);
    what << "Scene \"" << record.layout->scene << "\" stopped at t = " << time << ": " << why;
    if (!suspect.empty()) what << "; " << suspect;
    const double resolution = std::numeric_limits<double>::epsilon() * std::abs(time);
    if (resolution > coarse_time * start.scales.time) {
      what << "; double precision tells times here only to " << resolution << ": let time begin at 0";
    }
    if (!kept->statistics.advice.empty()) what << "; " << kept->statistics.advice;
    throw IntegrationFailure(what.str(), time, std::move(kept));
  }

  [[nodiscard]] Statistics statistics() const {
    Statistics s = record.statistics;
    count(s);
    if (handed_over) s.advice.clear();
    return s;
  }

  /// Adds what the present stepper and manifold have done.
  void count(Statistics& s) const {
    std::visit([&s](const auto& stepping) { stepping.count(s); }, stepper);
    s.evaluations += manifold->evaluations();
    s.factorisations += manifold->factorisations();
  }

  Options options;
  std::vector<double> times;
  System system;
  Start start;
  std::vector<double> lever;  // see Scales
  std::vector<double> lambda_at_start = start.lambda;
  std::optional<Manifold> manifold;  // of the current rows
  AnyStepper stepper;
  std::optional<Sticking> sticking;  // for the implicit stepper, if there is friction
  long steps = 0;

  Moment now, next;
  Springs springs;  // of the implicit stepper's state, if any constraint is compliant
  Recovery recovery;
  double best_sine = 1.0;    // of any rows, where they were compared last
  Angle angle;               // at the last step
  bool handed_over = false;  // to the explicit stepper, close to a singular position
  double sine_at_handover = 0.0;

  Record record;
};

Integrator::Integrator(System system, std::span<const double> q, std::span<const double> v,
                       const Options& options)
    : state_(std::make_unique<State>(std::move(system), q, v, options)) {}
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator::~Integrator() = default;

FlatSample Integrator::sample() const { return state_->sample(); }
const System& Integrator::system() const { return state_->system; }
Statistics Integrator::statistics() const { return state_->statistics(); }

void Integrator::step() {
  State& s = *state_;
  if (s.now.t >= s.options.t_end) {
    std::ostringstream what;
    what << "step(): t_end = " << s.options.t_end << " is reached; choose a later one in the options";
    throw InvalidArgument(what.str());
  }
  s.guarded([&s] {
    if (s.stepper_time() < s.options.t_end) s.step_once(s.options.t_end);
    s.visit(s.stepper_time());
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
  s.guarded([&] {
    s.step_past(t);
    s.visit(t);
  });
}

void Integrator::run(const std::function<void(const FlatSample&)>& observe) {
  State& s = *state_;
  s.guarded([&] {
    for (const double t : s.times) {
      if (t < s.now.t) continue;
      if (t > s.now.t) {
        s.step_past(t);
        s.visit(t);
      }
      observe(s.sample());
    }
  });
}

std::shared_ptr<const Record> Integrator::run() {
  State& s = *state_;
  s.record.clear();
  s.record.reserve(s.times.size(), s.sample());
  run([&s](const FlatSample& sample) { s.record.append(sample); });
  // The samples are handed over, not copied: they may be most of the memory.
  auto record = std::make_shared<Record>(std::move(s.record));
  s.record = {.layout = record->layout,
              .stepper = record->stepper,
              .tolerance = record->tolerance,
              .times = {},
              .values = {},
              .unique = {},
              .statistics = record->statistics};
  record->statistics = s.statistics();
  return record;
}

}  // namespace dalembert
