#include "dalembert/solvers/integrator.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/private/crossing.h>
#include <dalembert/solvers/private/erk.h>
#include <dalembert/solvers/private/ida.h>
#include <dalembert/solvers/private/manifold.h>
#include <dalembert/solvers/private/outgrown.h>
#include <dalembert/solvers/private/start.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <sstream>
#include <variant>

namespace dalembert {

namespace {

/// Output is put onto the constraints to this fraction of the scene's length: a few units of
/// round-off.
constexpr double output_distance = 1e-15;
/// Constraints that were left out because they followed from others at the start must still do so:
/// to this fraction of the scene's length.
constexpr double tolerated_contradiction = 1e-8;

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

}  // namespace

struct Integrator::State {
  State(System s, std::span<const double> q0, std::span<const double> v0, const Options& o) try
      : options(o),
        times(sample_times(o)),
        system(std::move(s)),
        start(consistent_start(system, q0, v0, o)),
        lever(start.scales.lever()),
        manifold(std::in_place, system, start.rows, lever),
        stepper(make_stepper(system, start, o)),
        now(system, start),
        next(now),
        given(start.q.size()),
        past(o.t_start, start.q, start.v) {
    if (system.compliant()) {
      for (auto* numbers : {&springs.lambda, &springs.rate, &springs.second})
        numbers->resize(start.lambda.size());
    }
    record.layout = system.layout();
    record.stepper = name(o.stepper);
    record.tolerance = o.tolerance;
    record.statistics.degrees_of_freedom = system.coordinates() + system.compliant_rows() - start.rows.size();
    record.statistics.redundant_equations = system.rows() - start.rows.size();
    visit(o.t_start);
  } catch (const StepFailure& failure) {  // before the first step it is a fault of the start
    throw InconsistentStart(failure.what);
  } catch (const EquationFault& fault) {
    throw InconsistentStart(fault.what());
  }

  /// Everything that can be read at one instant.
  struct Moment {
    Moment(const System& system, const Start& start)
        : q(start.q),
          v(start.v),
          a(start.a),
          lambda(start.lambda),
          forces(system.layout()->slot_coordinate.size()) {
      if (start.rows.size() < system.rows()) unique.resize(lambda.size());
    }
    double t = 0.0;
    std::vector<double> q, v, a, lambda, forces;
    double energy = 0.0;
    std::vector<char> unique;  // empty if all multipliers are
  };

  /// The state at a time that the stepper has passed, put onto the constraints, with its forces. If
  /// anything fails the current moment stays as it is.
  void visit(double time) {
    next.t = time;
    interpolate(time, next.q, next.v);
    recover(next);
    std::swap(now, next);
  }

  /// The stepper's state, with the forces that it has found for compliant constraints.
  void interpolate(double time, std::span<double> q, std::span<double> v) {
    std::visit([&](auto& s) { s.interpolate(time, q, v); }, stepper);
    if (const auto* ida = std::get_if<IdaStepper>(&stepper); ida != nullptr && system.compliant()) {
      if (ida->springs(time, springs)) manifold->follow(springs);
    }
  }

  [[nodiscard]] double stepper_time() const {
    return std::visit([](const auto& s) { return s.time(); }, stepper);
  }

  void recover(Moment& m) {
    std::ranges::copy(m.q, given.begin());
    const double L = start.scales.length;
    const Violation left = manifold->project_positions(m.t, m.q, m.v, output_distance * L);
    if (!manifold->solve_motion(m.t, m.q, m.v, m.a, m.lambda)) {
      throw StepFailure{"the constraints became dependent on each other: their forces are not determined",
                        m.t};
    }
    if (left.size > tolerated_contradiction * L + start.scales.rounding(m.q)) {
      throw StepFailure{system.row_label(left.row) +
                            " contradicts the other constraints: it is violated by " +
                            std::to_string(left.size),
                        m.t};
    }
    const auto& equations = manifold->equations();
    if (!m.unique.empty()) std::ranges::copy(manifold->unique(), m.unique.begin());
    system.constraint_forces(equations.w, m.lambda, m.forces);
    m.energy = system.kinetic_energy(m.v) + system.potential_energy({m.t, m.q, m.v}) +
               system.elastic_energy(m.lambda);
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!finite(m.energy) || !std::ranges::all_of(m.forces, finite)) {
      throw StepFailure{
          "the energy or a force of constraint exceeds what double precision holds; choose units in which "
          "masses, lengths and speeds are closer to 1",
          m.t};
    }
    auto& s = record.statistics;
    s.residual_position = std::max(s.residual_position, left.size);
    s.residual_velocity = std::max(s.residual_velocity, velocity_violation(system, equations, lever).size);
    for (std::size_t i = 0; i < given.size(); ++i) {
      s.correction = std::max(s.correction, std::abs(m.q[i] - given[i]) * lever[i]);
    }
  }

  [[nodiscard]] FlatSample sample() const {
    return {now.t, now.q, now.v, now.lambda, now.forces, now.energy, now.unique};
  }

  void step_once(double wanted) {
    if (++steps > options.max_steps) {
      throw StepFailure{"max_steps = " + std::to_string(options.max_steps) +
                            " is used up; raise it, or ask for a looser tolerance",
                        stepper_time()};
    }
    if (crossing_until && stepper_time() >= *crossing_until) resume();
    try {
      std::visit([wanted](auto& s) { s.step(wanted); }, stepper);
    } catch (const StepFailure& failure) {
      if (!failure.singular || !cross()) throw;
    }
    if (!crossing_until) {
      const double age = crossing_distance * start.scales.time;
      past.remember(stepper_time(), age, [this](double t, std::span<double> q0, std::span<double> v0) {
        interpolate(t, q0, v0);
        // A crossing begins with -g/C for the forces of compliant constraints: g must be as exact.
        if (system.compliant()) manifold->project_positions(t, q0, v0, output_distance * start.scales.length);
      });
    }
  }

  /// An isolated singular position stops the implicit stepper. The explicit one, begun a little
  /// earlier, strides over it and on to where the other can go on.
  [[nodiscard]] bool cross() {
    if (crossing_until) return false;
    const double beyond = stepper_time() + crossing_distance * start.scales.time;
    if (beyond >= options.t_end) return false;
    crossing_until = beyond;
    Options explicit_options = options;
    explicit_options.stepper = Stepper::erk;
    explicit_options.tolerance = std::max(options.tolerance, crossing_tolerance);
    restart(past.earlier().t, past.earlier().q, past.earlier().v, explicit_options);
    ++record.statistics.singular_positions;
    return true;
  }
  void resume() {
    const double t = stepper_time();
    std::vector<double> q0(given.size()), v0(given.size());
    std::visit([&](auto& s) { s.interpolate(t, q0, v0); }, stepper);
    crossing_until.reset();
    restart(t, q0, v0, options);
    past = Past(t, q0, v0);
  }
  /// A fresh choice of rows and a fresh stepper at a state on its way.
  void restart(double t, std::span<const double> q0, std::span<const double> v0, Options o) {
    count(record.statistics);
    record.statistics.advice.clear();  // of a crossing it would be about the wrong stepper
    o.t_start = t;
    o.assemble = true;
    Scales scales = start.scales;
    start = consistent_start(system, q0, v0, o);
    start.scales = std::move(scales);
    manifold.emplace(system, start.rows, lever);
    stepper = make_stepper(system, start, o);
    next = Moment(system, start);
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
    } catch (const InconsistentStart& fault) {
      fail(fault.what(), stepper_time());  // of a restart beyond a singular position
    }
  }

  /// The constraint whose force has grown without bound where the stepper stands, if there is one.
  [[nodiscard]] std::string outgrown() {
    try {
      interpolate(stepper_time(), next.q, next.v);
      if (!manifold->solve_motion(stepper_time(), next.q, next.v, next.a, next.lambda)) return {};
      return outgrown_constraint(system, start.scales, manifold->equations().w, next.lambda);
    } catch (const std::exception&) {
      return {};  // the run is stopping: what stops it is known already
    }
  }

  [[noreturn]] void fail(const std::string& why, double time) {
    time = std::max(time, now.t);  // a crossing begins a little earlier, and may fail there
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
    if (crossing_until) s.advice.clear();
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
  std::vector<double> lever;         // see Scales
  std::optional<Manifold> manifold;  // of the current rows
  AnyStepper stepper;
  long steps = 0;

  Moment now, next;
  std::vector<double> given;             // q before projection
  Springs springs;                       // of the implicit stepper's state, if any constraint is compliant
  Past past;                             // where to begin a crossing from
  std::optional<double> crossing_until;  // while one is under way

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
  s.guarded([&s] {
    if (s.stepper_time() >= s.options.t_end)
      throw StepFailure{"t_end is reached; choose a later one", s.now.t};
    do {
      s.step_once(s.options.t_end);
    } while (s.stepper_time() <= s.now.t);  // a crossing begins a little earlier
    s.visit(s.stepper_time());
  });
}

void Integrator::advance_to(double t) {
  State& s = *state_;
  if (!(t >= s.now.t && t <= s.options.t_end)) {
    std::ostringstream what;
    what << "advance_to(" << t << "): must lie between the current time " << s.now.t
         << " and t_end = " << s.options.t_end;
    throw InvalidScene(what.str());
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
