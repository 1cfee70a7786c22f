#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/ida/ida_solver.h>

#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <cmath>

namespace dalembert {

namespace {

constexpr int converged = 0;  // SUN_NLS_SUCCESS before SUNDIALS 7, SUN_SUCCESS since

// As in IDA, see its user guide:
/// an iteration that converges more slowly has failed;
constexpr double slowest_rate = 0.9;
/// a first correction below this part of what is asked for needs no second.
constexpr double negligible = 1e-8;

double rate_of(double correction, double first, int iteration) {
  return std::pow(correction / first, 1.0 / iteration);
}

}  // namespace

/// IDA's Newton iteration, but for its test of divergence. Multipliers enter the equations linearly: their
/// first correction makes up for the predictor and may be small by chance, their second, from the squares of
/// those of q and v, does not depend on it. Their growth from one to the next proves nothing; the iteration
/// diverges if the corrections of q and v grow.
void IdaStepper::Solver::make_newton() {
  nonlinear.reset(check(SUNNonlinSol_Newton(y.get(), context.get())));
  check(IDASetNonlinearSolver(ida.get(), nonlinear.get()), "IDASetNonlinearSolver");
  const auto test = [](SUNNonlinearSolver newton, N_Vector, N_Vector correction, sunrealtype tolerance,
                       N_Vector weight, void* data) noexcept {
    Solver& s = *static_cast<Solver*>(data);
    int iteration = 0;
    (void)SUNNonlinSolGetCurIter(newton, &iteration);  // cannot fail
    return s.test_convergence(iteration, correction, weight, tolerance);
  };
  check(IDASetMaxNonlinIters(ida.get(), static_cast<int>(constants.most_corrections)),
        "IDASetMaxNonlinIters");
  check(SUNNonlinSolSetConvTestFn(nonlinear.get(), test, this), "SUNNonlinSolSetConvTestFn");
}

int IdaStepper::Solver::test_convergence(int iteration, N_Vector correction, N_Vector weight,
                                         double newton_tolerance) {
  const double size = N_VWrmsNorm(correction, weight);
  const auto of_motion = [&] { return N_VWrmsNormMask(correction, weight, id.get()); };
  if (iteration == 0) {
    first_correction = size;
    first_of_motion = of_motion();
    if (size <= negligible * newton_tolerance) {
      left_by_newton = size;
      return converged;
    }
  } else {
    const double rate = rate_of(size, first_correction, iteration);
    if (rate > slowest_rate) {
      const bool diverges = rate_of(of_motion(), first_of_motion, iteration) > slowest_rate;
      return diverges ? SUN_NLS_CONV_RECVR : SUN_NLS_CONTINUE;
    }
    error_over_correction = rate / (1.0 - rate);
  }
  left_by_newton = error_over_correction * size;
  return left_by_newton <= newton_tolerance ? converged : SUN_NLS_CONTINUE;
}

}  // namespace dalembert
