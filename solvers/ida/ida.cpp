#include "dalembert/solvers/ida/ida.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/ida/ida_solver.h>
#include <dalembert/solvers/run/diagnosis.h>
#include <dalembert/solvers/run/singularity.h>

#include <algorithm>
#include <utility>

namespace dalembert {

namespace {

/// Steps longer than this over a force's own rate do not follow its vibration.
constexpr double unresolved = 0.45;
/// A force that would vibrate so often in the scene's own time is stiff: round-off in the positions times
/// its stiffness disturbs the velocities.
constexpr double stiff_rate = 1000.0;

}  // namespace

IdaStepper::IdaStepper(const Problem& problem, const Start& start, const Options& options)
    : solver_(std::make_unique<Solver>(problem, start, options)) {
  Solver& s = *solver_;
  void* ida = s.ida.get();
  const auto residual = [](double t, N_Vector x, N_Vector xp, N_Vector r, void* data) noexcept {
    Solver& own = *static_cast<Solver*>(data);
    return guarded(own, t, [&] {
      own.residual(t, x, xp, r);
      return 0;
    });
  };
  const auto weigh = [](N_Vector x, N_Vector weight, void* data) noexcept {
    Solver& own = *static_cast<Solver*>(data);
    return guarded(own, own.t, [&] {
      own.weights = weight;
      own.weigh(x, weight);
      return 0;
    });
  };
  const auto record = [](double t, double c, N_Vector x, N_Vector, N_Vector, SUNMatrix, void* data, N_Vector,
                         N_Vector, N_Vector) noexcept {
    Solver& own = *static_cast<Solver*>(data);
    own.matrix_t = t;
    own.matrix_c = c;
    own.matrix_y = x;
    return 0;
  };
#if SUNDIALS_VERSION_MAJOR < 7  // from 7 on the context is silent
  const auto silence = [](int, const char*, const char*, char*, void*) noexcept {};
  check(IDASetErrHandlerFn(ida, silence, nullptr), "IDASetErrHandlerFn");
#endif
  check(IDAInit(ida, residual, s.t, s.y.get(), s.yp.get()), "IDAInit");
  check(IDASetUserData(ida, &s), "IDASetUserData");
  check(IDAWFtolerances(ida, weigh), "IDAWFtolerances");
  s.make_newton();
  check(IDASetLinearSolver(ida, s.solver.get(), s.matrix.get()), "IDASetLinearSolver");
  check(IDASetJacFn(ida, record), "IDASetJacFn");
  check(IDASetLinearSolutionScaling(ida, 0), "IDASetLinearSolutionScaling");  // NewtonMatrix knows c
  check(IDASetId(ida, s.id.get()), "IDASetId");
  check(IDASetSuppressAlg(ida, 1), "IDASetSuppressAlg");
  check(IDASetNonlinConvCoef(ida, constants.newton_tolerance), "IDASetNonlinConvCoef");
  check(IDASetInitStep(ida, s.first_step), "IDASetInitStep");
  check(IDASetStopTime(ida, s.t_end), "IDASetStopTime");
  check(IDASetMaxNumSteps(ida, -1), "IDASetMaxNumSteps");
  check(IDASetMaxStep(ida, options.max_step), "IDASetMaxStep");  // 0: none
}

IdaStepper::~IdaStepper() = default;

std::string IdaStepper::Solver::explain(int code) const {
  switch (code) {
    case IDA_RES_FAIL:
    case IDA_FIRST_RES_FAIL:
    case IDA_REP_RES_ERR:
    case IDA_LSETUP_FAIL:
    case IDA_LSOLVE_FAIL:
      return fault_or("the equations could not be evaluated");
    case IDA_ERR_FAIL:
      return fault_or("the error tolerance cannot be met with any step that double precision resolves: " +
                      cause());
    case IDA_CONV_FAIL:
      return fault_or("Newton's iteration does not converge: " + cause());
    case IDA_TOO_MUCH_ACC:
      return "the tolerance asks for more than double precision can deliver; ask for a looser one";
    default:
      return "IDA returned " + std::to_string(code);
  }
}

/// What makes steps fail however short they are, as far as the state tells.
std::string IdaStepper::Solver::cause() const {
  if (const auto singular = singular_here(*system, scales, instant(t, y.get())); !singular.empty())
    return singular;
  if (asks_for_too_much())
    return "the tolerance asks for more than double precision can deliver here; ask for one ten times as "
           "large";
  if (sine() < constants.close_to_dependent) return "the constraints are nearly linearly dependent here";
  if (newton.fastest().of_forces * scales.time > stiff_rate)
    return system->forces().owner_of_stiffness(newton.fastest().stiffest) +
           " is very stiff, or a force discontinuous";
  return "look for a discontinuous force, or a constraint whose gradient jumps";
}

std::string IdaStepper::Solver::advice() const {
  return "stiff: " + system->forces().owner_of_stiffness(newton.fastest().stiffest) +
         " causes vibrations much faster than the motion; if it is a spring, state it as a constraint with "
         "compliance 1/stiffness, as in compliant(Distance{a, b, length}, 1.0 / stiffness)";
}

/// Whether most steps were longer than the vibration of a force, or shorter because of it.
bool IdaStepper::Solver::has_stiff_force() const {
  return 2 * unresolved_steps > steps || newton.fastest().of_forces * scales.time > stiff_rate;
}

/// Whether round-off, which the constraints amplify by 1/sine, exceeds what Newton's iteration may leave.
bool IdaStepper::Solver::asks_for_too_much() const {
  return constants.newton_tolerance * tolerance * scales.length * sine() <
         scales.rounding(instant(t, y.get()).q);
}

/// Of the last step, by which the time advanced so much: in IDA's notation the local error of BDF is c E with
/// c = 1/(k + 1) in equal steps, where E is the sum of Newton's corrections to the predictor. What the
/// iteration left has no sign, as round-off, nor has what the gradients of constraints, known to the rounding
/// of positions, do to velocities.
void IdaStepper::Solver::find_error(double advanced) {
  int order = 1;
  double h = 0.0;
  check(IDAGetLastStep(ida.get(), &h), "IDAGetLastStep");
  check(IDAGetLastOrder(ida.get(), &order), "IDAGetLastOrder");
  check(IDAGetEstLocalErrors(ida.get(), dense.get()), "IDAGetEstLocalErrors");
  const auto correction = entries(dense.get()), state = entries(y.get());
  double of_q = 0.0, of_v = 0.0, farthest = 0.0, fastest = 0.0;
  for (std::size_t i = 0; i < n(); ++i) {
    of_q = std::max(of_q, std::abs(correction[i]) * lengths[i]);
    of_v = std::max(of_v, std::abs(correction[n() + i]) * lengths[i]);
    farthest = std::max(farthest, std::abs(state[i]) * lengths[i]);
    fastest = std::max(fastest, std::abs(state[n() + i]) * lengths[i]);
  }
  rounding = epsilon * farthest;
  const double c = 1.0 / (order + 1.0), left = left_by_newton * tolerance,
               turned = rounding / (scales.length * std::max(sine(), epsilon));
  reached = {.position = c * of_q,
             .velocity = c * of_v,
             .position_noise = rounding + left * scales.length,
             .velocity_noise = left * (scales.speed() + fastest) + turned * fastest,
             .late = advanced - h};
}

/// Whether a step advances the time by hardly more than its rounding, or the scene by less than a rounding of
/// its positions: the differences in BDF are round-off then, and lead nowhere.
bool IdaStepper::Solver::too_short(double step) const {
  return step <= 4.0 * epsilon * std::abs(t) || step * scales.length <= rounding * scales.time;
}

/// After a step: changes the highest order if the guard does. IDA can lower it only by a restart at
/// order 1.
void IdaStepper::Solver::watch_order() {
  double h = 0.0;
  check(IDAGetLastStep(ida.get(), &h), "IDAGetLastStep");
  const int before = guard.order();
  order_changed = guard.watch(h, newton.fastest().of_compliance);
  if (h * newton.fastest().of_forces > unresolved) ++unresolved_steps;
  reinitialise = order_changed && guard.order() < before;
}

/// Before the next step, so that the last can be read until then.
void IdaStepper::Solver::change_order() {
  order_changed = false;
  if (reinitialise) {
    count_failures(error_tests, convergence);
    check(IDAReInit(ida.get(), t, y.get(), yp.get()), "IDAReInit");
    check(IDASetStopTime(ida.get(), t_end), "IDASetStopTime");
  }
  check(IDASetMaxOrd(ida.get(), guard.order()), "IDASetMaxOrd");
}

/// Newton's iteration that failed with forces left out of its matrix is to have them.
void IdaStepper::Solver::watch_convergence() {
  long failures = 0;
  check(IDAGetNumStepSolveFails(ida.get(), &failures), "IDAGetNumStepSolveFails");
  if (failures > std::exchange(solve_failures, failures)) newton.converged_badly();
}

/// Whether Newton's iteration has failed since IDA began, maybe for round-off: what that may be must be
/// known.
bool IdaStepper::Solver::has_failed() const {
  long failures = 0;
  check(IDAGetNumStepSolveFails(ida.get(), &failures), "IDAGetNumStepSolveFails");
  return failures > 0;
}

/// Adds IDA's own counts since it began.
void IdaStepper::Solver::count_failures(long& of_tests, long& of_newton) const {
  long tests = 0, newtons = 0;
  check(IDAGetNumErrTestFails(ida.get(), &tests), "IDAGetNumErrTestFails");
  check(IDAGetNumStepSolveFails(ida.get(), &newtons), "IDAGetNumStepSolveFails");
  of_tests += tests;
  of_newton += newtons;
}

void IdaStepper::step(double /*wanted*/) {
  Solver& s = *solver_;
  if (s.order_changed) s.change_order();
  const double before = s.t;
  const int code = IDASolve(s.ida.get(), s.t_end, &s.t, s.y.get(), s.yp.get(), IDA_ONE_STEP);
  if (s.thrown) std::rethrow_exception(std::exchange(s.thrown, {}));
  if (code < 0) throw StepFailure{s.explain(code), s.t};
  ++s.steps;
  s.watch_convergence();
  s.find_error(s.t - before);
  // In front of a fault IDA would halve and double such steps for ever.
  if (code == IDA_SUCCESS && s.too_short(s.t - before)) {
    throw StepFailure{s.fault_or("the step has become too short to advance time: " + s.cause()), s.t};
  }
  s.watch_order();
}

double IdaStepper::time() const { return solver_->t; }
double IdaStepper::sine() const { return solver_->newton.sine(); }
StepError IdaStepper::error() const { return solver_->reached; }

void IdaStepper::interpolate(double t, std::span<double> q, std::span<double> v) {
  const Solver& s = *solver_;
  const bool at_node = s.steps == 0 || t == s.t;
  if (!at_node) check(IDAGetDky(s.ida.get(), t, 0, s.dense.get()), "IDAGetDky");
  const Instant at = s.instant(t, at_node ? s.y.get() : s.dense.get());
  std::ranges::copy(at.q, q.begin());
  std::ranges::copy(at.v, v.begin());
}

bool IdaStepper::compliant_multipliers(double t, CompliantMultipliers& out) const {
  const Solver& s = *solver_;
  if (s.steps == 0) return false;
  const auto read = [&](int derivative, std::vector<double>& numbers) {
    check(IDAGetDky(s.ida.get(), t, derivative, s.dense.get()), "IDAGetDky");
    const auto active = s.entries(s.dense.get()).subspan(2 * s.n(), s.m());
    for (std::size_t r = 0; r < s.m(); ++r) numbers[s.rows.rows[r]] = active[r];
  };
  int order = 0;
  double h = 0.0;
  check(IDAGetLastOrder(s.ida.get(), &order), "IDAGetLastOrder");
  check(IDAGetLastStep(s.ida.get(), &h), "IDAGetLastStep");
  read(0, out.lambda);
  read(1, out.rate);
  if (order >= 2)
    read(2, out.second);  // otherwise none is known
  else
    std::ranges::fill(out.second, 0.0);
  out.c = 1.0 / h;
  return true;
}

void IdaStepper::count(Statistics& statistics) const {
  const Solver& s = *solver_;
  long error_tests = s.error_tests, convergence = s.convergence;
  if (s.steps > 0) s.count_failures(error_tests, convergence);
  statistics.steps += s.steps;
  statistics.evaluations += s.evaluations;
  statistics.factorisations += s.newton.factorisations();
  statistics.linear_algebra = s.newton.method();
  statistics.error_test_failures += error_tests;
  statistics.convergence_failures += convergence;
  if (s.steps > 0 && s.has_stiff_force() &&
      singular_here(*s.system, s.scales, s.instant(s.t, s.y.get())).empty())
    statistics.advice = s.advice();
}

}  // namespace dalembert
