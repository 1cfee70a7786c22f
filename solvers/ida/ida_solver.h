#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/ida/ida.h>
#include <dalembert/solvers/ida/newton_matrix.h>
#include <dalembert/solvers/ida/order_guard.h>
#include <dalembert/solvers/ida/sundials.h>

#include <ida/ida.h>
#include <nvector/nvector_serial.h>

#include <exception>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

struct FreeIda {
  void operator()(void* memory) const { IDAFree(&memory); }
};

/// IDA's memory and what its callbacks need.
struct IdaStepper::Solver {
  Solver(const Problem& problem, const Start& start, const Options& options);

  // The context is declared first: it dies last.
  Owned<SUNContext, FreeContext> context = make_context();
  Owned<N_Vector, FreeVector> y, yp, dense;
  Owned<N_Vector, FreeVector> id;  // 1 for q and v; of multipliers their share in the error test, see weigh
  Owned<SUNMatrix, FreeMatrix> matrix;
  Owned<SUNLinearSolver, FreeSolver> solver;
  Owned<SUNNonlinearSolver, FreeNewton> nonlinear;
  Owned<void*, FreeIda> ida;

  const System* system;
  ActiveRows rows;
  Scales scales;
  std::vector<double> lengths;          // see Scales
  double tolerance, t_end, first_step;  // tolerance: of a step
  System::Evaluation e;
  std::vector<double> lambda;          // one per row of the system, 0 of dependent ones
  std::vector<double> impulse_row;     // per active row
  std::vector<double> compliance_row;  // per active row, of a gradient of unit length
  NewtonMatrix newton;
  OrderGuard guard;
  bool order_changed = false, reinitialise = false;  // by the guard, not yet done
  double t = 0.0;
  long steps = 0, evaluations = 0, error_tests = 0, convergence = 0;
  StepError reached;            // of the last step
  double rounding = 0.0;        // of the positions where it ended, as a length
  double left_by_newton = 0.0;  // of the last iteration, over the weights
  long solve_failures = 0;      // of Newton, as IDA counted them last
  long unresolved_steps = 0;    // longer than the vibration of a stiff force
  std::string fault;            // of the last evaluation that failed,
  double fault_time = 0.0;      // and where; no reason to stop once it has been stepped past

  // What the Jacobian callback records for the factorisation.
  double matrix_t = 0.0, matrix_c = 0.0;
  N_Vector matrix_y = nullptr;
  N_Vector weights = nullptr;  // IDA's own
  double weighed_h = 0.0;      // of the step they are for
  // Where `e` holds.
  double evaluated_at = 0.0, factored_at = 0.0;
  N_Vector evaluated = nullptr;
  int corrections = 0;  // so far, in this Newton iteration
  // Of Newton's iteration: its first correction and that of q and v alone, both weighted, and the error left
  // after a correction, in units of that.
  static constexpr double unknown_rate = 20.0;  // as in IDA, while a new matrix has shown none
  double first_correction = 0.0, first_of_motion = 0.0, error_over_correction = unknown_rate;
  std::exception_ptr thrown;  // by a callback, to be thrown again when IDA has returned

  [[nodiscard]] std::size_t n() const { return system->coordinates(); }
  [[nodiscard]] std::size_t m() const { return rows.size(); }
  [[nodiscard]] std::size_t m_holonomic() const { return rows.holonomic; }
  [[nodiscard]] std::size_t unknowns() const { return 2 * n() + m() + m_holonomic(); }
  [[nodiscard]] std::span<double> entries(N_Vector x) const { return {NV_DATA_S(x), unknowns()}; }
  [[nodiscard]] Instant instant(double at, N_Vector x) const {
    const auto y = entries(x);
    return {at, y.subspan(0, n()), y.subspan(n(), n())};
  }

  void make_linear_solver();
  void make_newton();
  [[nodiscard]] int test_convergence(int iteration, N_Vector correction, N_Vector weight,
                                     double newton_tolerance);
  void find_error(double advanced);
  [[nodiscard]] bool too_short(double step) const;
  void watch_order();
  void change_order();
  void watch_convergence();
  [[nodiscard]] bool has_failed() const;
  void count_failures(long& error_tests, long& convergence) const;
  void find_impulses();
  void spread_multipliers(N_Vector x);
  void residual(double at, N_Vector x, N_Vector xp, N_Vector r);
  [[nodiscard]] double sine() const { return newton.factorisations() > 0 ? newton.sine() : 1.0; }
  [[nodiscard]] double farthest(std::size_t row, std::span<const double> q) const;
  void weigh(N_Vector x, N_Vector weight);
  void blame(double at, std::string what) {
    fault_time = at;
    fault = std::move(what);
  }
  [[nodiscard]] std::string explain(int code) const;
  [[nodiscard]] bool has_stiff_force() const;
  [[nodiscard]] std::string cause() const;
  [[nodiscard]] std::string advice() const;
  [[nodiscard]] bool asks_for_too_much() const;
  [[nodiscard]] std::string fault_or(const std::string& otherwise) const {
    return !fault.empty() && fault_time >= t ? fault : otherwise;
  }
};

/// Runs `f` for C: +1, recoverable, for a fault of the user's equations at a time; the step is then
/// tried shorter. -1 for anything else, which is kept.
template <class Solver, class F>
int guarded(Solver& state, double at, const F& f) noexcept {
  try {
    return f();
  } catch (const EquationFault& error) {
    state.blame(at, error.what());
    return 1;
  } catch (...) {
    state.thrown = std::current_exception();
    return -1;
  }
}

}  // namespace dalembert
