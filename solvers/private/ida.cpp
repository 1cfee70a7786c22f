#include "dalembert/solvers/private/ida.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/private/newton_matrix.h>
#include <dalembert/solvers/private/vector_operations.h>

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace dalembert {

namespace {

/// The error allowed to one step, of the tolerance asked for: errors of hundreds of steps add up in
/// the result. Chosen by the benchmark: with it every model of the catalogue errs by less than 1000
/// times the tolerance 1e-8.
constexpr double share_of_a_step = 0.05;
/// Newton stops at this fraction of the error tolerance. IDA's 0.33 lets the multipliers' error
/// into the step control.
constexpr double newton_tolerance = 0.1;

struct FreeContext {
  void operator()(SUNContext c) const { SUNContext_Free(&c); }
};
struct FreeVector {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
struct FreeMatrix {
  void operator()(SUNMatrix a) const { SUNMatDestroy(a); }
};
struct FreeSolver {
  void operator()(SUNLinearSolver s) const { SUNLinSolFreeEmpty(s); }
};
struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};
template <class Handle, class Free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

/// Our own mistakes in calling IDA; a user never sees these.
void check(int code, const char* function) {
  if (code < 0) throw std::logic_error(std::string(function) + " returned " + std::to_string(code));
}
template <class Pointer>
Pointer check(Pointer pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

Owned<SUNContext, FreeContext> make_context() {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  return Owned<SUNContext, FreeContext>(context);
}

}  // namespace

struct IdaStepper::State {
  State(const System& system, const Start& start, const Options& options);

  // The context is declared first: it dies last.
  Owned<SUNContext, FreeContext> context = make_context();
  Owned<N_Vector, FreeVector> y, yp, dense, id;
  Owned<SUNMatrix, FreeMatrix> matrix;
  Owned<SUNLinearSolver, FreeSolver> solver;
  Owned<void*, FreeIda> ida;

  const System* system;
  ActiveRows rows;
  Scales scales;
  double tolerance, t_end, first_step;
  System::Evaluation e;
  std::vector<double> lambda;       // one per row of the system
  std::vector<double> impulse_row;  // |lambda| h for a unit of speed, per active row
  NewtonMatrix newton;
  double t = 0.0;
  long steps = 0, evaluations = 0;
  std::string fault;        // of the last evaluation that failed,
  double fault_time = 0.0;  // and where; no reason to stop once it has been stepped past

  // What the Jacobian callback records for the factorisation.
  double matrix_t = 0.0, matrix_c = 0.0;
  N_Vector matrix_y = nullptr;
  // Where `e` holds.
  double evaluated_at = 0.0, factored_at = 0.0;
  N_Vector evaluated = nullptr;

  [[nodiscard]] std::size_t n() const { return static_cast<std::size_t>(system->coordinates()); }
  [[nodiscard]] std::size_t m() const { return static_cast<std::size_t>(rows.size()); }
  [[nodiscard]] std::size_t m_holonomic() const { return static_cast<std::size_t>(rows.holonomic); }
  [[nodiscard]] std::size_t unknowns() const { return 2 * n() + m() + m_holonomic(); }
  [[nodiscard]] std::span<double> entries(N_Vector x) const { return {N_VGetArrayPointer(x), unknowns()}; }
  [[nodiscard]] Instant instant(double at, N_Vector x) const {
    return {at, entries(x).subspan(0, n()), entries(x).subspan(n(), n())};
  }

  void make_linear_solver();
  void spread_multipliers(N_Vector x);
  void residual(double at, N_Vector x, N_Vector xp, N_Vector r);
  void weigh(N_Vector x, N_Vector weight);
  void weigh_multipliers();
  void blame(double at, std::string what) {
    fault_time = at;
    fault = std::move(what);
  }
  [[nodiscard]] std::string explain(int code) const;
  [[nodiscard]] std::string fault_or(const char* otherwise) const {
    return !fault.empty() && fault_time >= t ? fault : otherwise;
  }
};

namespace {

/// Runs `f` for C: +1, recoverable, for a fault of the user's equations at a time; the step is then
/// tried shorter. -1 for anything else.
template <class State, class F>
int guarded(State& state, double at, const F& f) noexcept {
  try {
    return f();
  } catch (const EquationFault& error) {
    state.blame(at, error.what());
    return 1;
  } catch (...) {
    return -1;
  }
}

}  // namespace

IdaStepper::State::State(const System& s, const Start& start, const Options& options)
    : system(&s),
      rows(start.rows),
      scales(start.scales),
      tolerance(share_of_a_step * options.tolerance),
      t_end(options.t_end),
      // IDA's own first step is so short that round-off in the multipliers fails Newton's iteration.
      first_step(
          std::min(0.1 * std::sqrt(options.tolerance) * start.scales.time, options.t_end - options.t_start)),
      e(s.evaluation()),
      lambda(start.lambda),
      impulse_row(static_cast<std::size_t>(start.rows.size())),
      newton(s, start.rows),
      t(options.t_start) {
  y.reset(check(N_VNew_Serial(static_cast<sunindextype>(unknowns()), context.get())));
  vectorise(y.get());
  yp.reset(check(N_VClone(y.get())));
  dense.reset(check(N_VClone(y.get())));
  id.reset(check(N_VClone(y.get())));
  for (N_Vector v : {y.get(), yp.get(), id.get()}) N_VConst(0.0, v);
  const auto y0 = entries(y.get());
  const auto yp0 = entries(yp.get());
  std::ranges::copy(start.q, y0.begin());
  std::ranges::copy(start.v, y0.subspan(n()).begin());
  for (std::size_t r = 0; r < m(); ++r)
    y0[2 * n() + r] = start.lambda[static_cast<std::size_t>(rows.rows[r])];
  std::ranges::copy(start.v, yp0.begin());
  std::ranges::copy(start.a, yp0.subspan(n()).begin());
  std::fill_n(entries(id.get()).begin(), 2 * n(), 1.0);
  system->evaluate(instant(t, y.get()), e);
  weigh_multipliers();

  ida.reset(check(IDACreate(context.get())));
  make_linear_solver();
}

IdaStepper::IdaStepper(const System& system, const Start& start, const Options& options)
    : state_(std::make_unique<State>(system, start, options)) {
  State& s = *state_;
  void* ida = s.ida.get();
  const auto residual = [](double t, N_Vector x, N_Vector xp, N_Vector r, void* data) noexcept {
    State& own = *static_cast<State*>(data);
    return guarded(own, t, [&] {
      own.residual(t, x, xp, r);
      return 0;
    });
  };
  const auto weigh = [](N_Vector x, N_Vector weight, void* data) noexcept {
    static_cast<State*>(data)->weigh(x, weight);
    return 0;
  };
  const auto record = [](double t, double c, N_Vector x, N_Vector, N_Vector, SUNMatrix, void* data, N_Vector,
                         N_Vector, N_Vector) noexcept {
    State& own = *static_cast<State*>(data);
    own.matrix_t = t;
    own.matrix_c = c;
    own.matrix_y = x;
    return 0;
  };
  const auto silence = [](int, const char*, const char*, char*, void*) noexcept {};
  check(IDASetErrHandlerFn(ida, silence, nullptr), "IDASetErrHandlerFn");
  check(IDAInit(ida, residual, s.t, s.y.get(), s.yp.get()), "IDAInit");
  check(IDASetUserData(ida, &s), "IDASetUserData");
  check(IDAWFtolerances(ida, weigh), "IDAWFtolerances");
  check(IDASetLinearSolver(ida, s.solver.get(), s.matrix.get()), "IDASetLinearSolver");
  check(IDASetJacFn(ida, record), "IDASetJacFn");
  check(IDASetLinearSolutionScaling(ida, 0), "IDASetLinearSolutionScaling");  // NewtonMatrix knows c
  check(IDASetId(ida, s.id.get()), "IDASetId");
  check(IDASetSuppressAlg(ida, 1), "IDASetSuppressAlg");
  check(IDASetNonlinConvCoef(ida, newton_tolerance), "IDASetNonlinConvCoef");
  check(IDASetInitStep(ida, s.first_step), "IDASetInitStep");
  check(IDASetStopTime(ida, s.t_end), "IDASetStopTime");
  check(IDASetMaxNumSteps(ida, -1), "IDASetMaxNumSteps");
}

IdaStepper::IdaStepper(IdaStepper&&) noexcept = default;
IdaStepper& IdaStepper::operator=(IdaStepper&&) noexcept = default;
IdaStepper::~IdaStepper() = default;

/// A direct solver for IDA's interface whose matrix is NewtonMatrix; IDA's own is empty.
void IdaStepper::State::make_linear_solver() {
  matrix.reset(check(SUNMatNewEmpty(context.get())));
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->zero = [](SUNMatrix) { return 0; };
  matrix->ops->destroy = [](SUNMatrix a) { SUNMatFreeEmpty(a); };

  solver.reset(check(SUNLinSolNewEmpty(context.get())));
  solver->content = this;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->setup = [](SUNLinearSolver self, SUNMatrix) noexcept {
    State& s = *static_cast<State*>(self->content);
    return guarded(s, s.matrix_t, [&s] {
      s.spread_multipliers(s.matrix_y);
      const Instant at = s.instant(s.matrix_t, s.matrix_y);
      const bool known = s.evaluated_at == at.t && s.evaluated == s.matrix_y;  // by the residual just before
      if (!known) s.system->evaluate(at, s.e);
      const bool regular = s.newton.factorise(at, s.e, s.lambda, s.matrix_c);
      s.factored_at = at.t;
      if (!regular) s.blame(s.matrix_t, "the constraints became dependent on each other");
      return regular ? 0 : 1;
    });
  };
  solver->ops->solve = [](SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, double) noexcept {
    State& s = *static_cast<State*>(self->content);
    double c = 0.0;
    IDAGetCurrentCj(s.ida.get(), &c);
    if (x != b) N_VScale(1.0, b, x);
    return guarded(s, s.evaluated_at, [&] {
      // IDA keeps a matrix as long as Newton converges; fresh soft factors cost less than that saves.
      if (s.evaluated_at != s.factored_at) {
        s.factored_at = s.evaluated_at;
        if (!s.newton.refresh(s.e)) return 1;
      }
      s.newton.solve(c, s.entries(x));
      return 0;
    });
  };
  solver->ops->free = [](SUNLinearSolver) { return 0; };  // owned by `solver`
}

/// IDA's multipliers, one per active row, into one per row of the system.
void IdaStepper::State::spread_multipliers(N_Vector x) {
  const auto active = entries(x).subspan(2 * n(), m());
  for (std::size_t r = 0; r < m(); ++r) lambda[static_cast<std::size_t>(rows.rows[r])] = active[r];
}

void IdaStepper::State::residual(double at, N_Vector x, N_Vector xp, N_Vector r) {
  ++evaluations;
  const Instant now = instant(at, x);
  system->evaluate(now, e);
  evaluated_at = at;
  evaluated = x;
  const auto qp = entries(xp).subspan(0, n());
  const auto vp = entries(xp).subspan(n(), n());
  const auto active = entries(x).subspan(2 * n(), m());
  const auto mu = entries(x).subspan(2 * n() + m(), m_holonomic());
  const auto r1 = entries(r).subspan(0, n());
  const auto r2 = entries(r).subspan(n(), n());
  const auto r3 = entries(r).subspan(2 * n(), m());
  const auto r4 = entries(r).subspan(2 * n() + m(), m_holonomic());
  const auto masses = system->masses();
  for (std::size_t i = 0; i < n(); ++i) {
    r1[i] = masses[i] * (now.v[i] - qp[i]);
    r2[i] = e.force[i] - masses[i] * vp[i];
  }
  for (std::size_t k = 0; k < m(); ++k) {
    const auto row = static_cast<std::size_t>(rows.rows[k]);
    const bool holonomic = k < m_holonomic();
    for (auto j = static_cast<std::size_t>(system->row_start()[row]);
         j < static_cast<std::size_t>(system->row_start()[row + 1]); ++j) {
      const auto i = static_cast<std::size_t>(system->w_columns()[j]);
      r2[i] += e.w[j] * active[k];
      if (holonomic) r1[i] += e.w[j] * mu[k];
    }
    r3[k] = e.psi[row];
    if (holonomic) r4[k] = e.g[row];
  }
}

/// The multiplier that delivers the scene's speed to the masses of its row in a unit of time:
/// speed |W| / (W M^-1 W^T), whatever the scale of the user's equation.
void IdaStepper::State::weigh_multipliers() {
  for (std::size_t r = 0; r < m(); ++r) {
    const auto row = static_cast<std::size_t>(rows.rows[r]);
    double square = 0.0, mobility = 0.0;
    for (auto k = static_cast<std::size_t>(system->row_start()[row]);
         k < static_cast<std::size_t>(system->row_start()[row + 1]); ++k) {
      const auto i = static_cast<std::size_t>(system->w_columns()[k]);
      const double slope = e.w[k] * scales.coordinate[i] / scales.length;
      square += slope * slope;
      mobility += e.w[k] * e.w[k] / system->masses()[i];
    }
    impulse_row[r] = scales.speed() * std::sqrt(square) / mobility;
  }
}

void IdaStepper::State::weigh(N_Vector x, N_Vector weight) {
  double h = 0.0;
  if (steps > 0) IDAGetCurrentStep(ida.get(), &h);
  if (h == 0.0) h = first_step;
  const auto value = entries(x);
  const auto w = entries(weight);
  for (std::size_t i = 0; i < n(); ++i) {
    const double scale = scales.coordinate[i];
    w[i] = 1.0 / scales.position_error(i, value[i], tolerance);
    w[n() + i] = 1.0 / (tolerance * (scale / scales.time + std::abs(value[n() + i])));
  }
  for (std::size_t r = 0; r < m(); ++r) {
    w[2 * n() + r] = h / (tolerance * impulse_row[r]);
    if (r < m_holonomic()) w[2 * n() + m() + r] = h / (tolerance * impulse_row[r] * scales.time);
  }
}

std::string IdaStepper::State::explain(int code) const {
  switch (code) {
    case IDA_RES_FAIL:
    case IDA_FIRST_RES_FAIL:
    case IDA_REP_RES_ERR:
    case IDA_LSETUP_FAIL:
    case IDA_LSOLVE_FAIL:
      return fault_or("the equations could not be evaluated");
    case IDA_ERR_FAIL:
      return "the error tolerance cannot be met with any step that double precision resolves; "
             "ask for a looser tolerance, or look for a discontinuous or very stiff force";
    case IDA_CONV_FAIL:
      return fault_or("Newton's iteration does not converge; the constraints may be close to singular here");
    case IDA_TOO_MUCH_ACC:
      return "the tolerance asks for more than double precision can deliver; ask for a looser one";
    default:
      return "IDA returned " + std::to_string(code);
  }
}

void IdaStepper::step(double /*wanted*/) {
  State& s = *state_;
  const double before = s.t;
  const int code = IDASolve(s.ida.get(), s.t_end, &s.t, s.y.get(), s.yp.get(), IDA_ONE_STEP);
  if (code < 0) throw StepFailure{s.explain(code), s.t, code == IDA_CONV_FAIL || code == IDA_LSETUP_FAIL};
  ++s.steps;
  // In front of a fault IDA would halve and double such steps for ever.
  if (code == IDA_SUCCESS && s.t - before <= 4.0 * std::numeric_limits<double>::epsilon() * std::abs(s.t)) {
    throw StepFailure{
        s.fault_or("the step has become too short to advance time; look for a discontinuous force"), s.t};
  }
}

double IdaStepper::time() const { return state_->t; }

void IdaStepper::interpolate(double t, std::span<double> q, std::span<double> v) const {
  const State& s = *state_;
  if (s.steps == 0) {
    std::ranges::copy(s.instant(t, s.y.get()).q, q.begin());
    std::ranges::copy(s.instant(t, s.y.get()).v, v.begin());
    return;
  }
  check(IDAGetDky(s.ida.get(), t, 0, s.dense.get()), "IDAGetDky");
  std::ranges::copy(s.instant(t, s.dense.get()).q, q.begin());
  std::ranges::copy(s.instant(t, s.dense.get()).v, v.begin());
}

void IdaStepper::count(Statistics& statistics) const {
  const State& s = *state_;
  long error_tests = 0, convergence = 0;
  if (s.steps > 0) {
    check(IDAGetNumErrTestFails(s.ida.get(), &error_tests), "IDAGetNumErrTestFails");
    check(IDAGetNumStepSolveFails(s.ida.get(), &convergence), "IDAGetNumStepSolveFails");
  }
  statistics.steps += s.steps;
  statistics.evaluations += s.evaluations;
  statistics.factorisations += s.newton.factorisations();
  statistics.linear_algebra = s.newton.method();
  statistics.error_test_failures += error_tests;
  statistics.convergence_failures += convergence;
}

}  // namespace dalembert
