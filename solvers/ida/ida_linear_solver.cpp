#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/ida/ida_solver.h>

namespace dalembert {

/// A direct solver for IDA's interface whose matrix is NewtonMatrix; IDA's own is empty.
void IdaStepper::Solver::make_linear_solver() {
  matrix.reset(check(SUNMatNewEmpty(context.get())));
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->zero = [](SUNMatrix) { return 0; };
  matrix->ops->destroy = [](SUNMatrix a) { SUNMatFreeEmpty(a); };

  solver.reset(check(SUNLinSolNewEmpty(context.get())));
  solver->content = this;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->setup = [](SUNLinearSolver self, SUNMatrix) noexcept {
    Solver& s = *static_cast<Solver*>(self->content);
    return guarded(s, s.matrix_t, [&s] {
      if (s.has_failed()) s.newton.find_sine();
      // IDA weighs once per step, also where it goes on to shorten it; those of multipliers depend on h.
      double h = 0.0;
      check(IDAGetCurrentStep(s.ida.get(), &h), "IDAGetCurrentStep");
      if (h != s.weighed_h) s.weigh(s.matrix_y, s.weights);
      s.spread_multipliers(s.matrix_y);
      const Instant at = s.instant(s.matrix_t, s.matrix_y);
      const bool known = s.evaluated_at == at.t && s.evaluated == s.matrix_y;  // by the residual just before
      if (!known) s.system->evaluate(at, s.e);
      const bool regular = s.newton.factorise(at, s.e, s.lambda, s.matrix_c);
      s.factored_at = at.t;
      s.corrections = 0;
      s.error_over_correction = Solver::unknown_rate;
      if (!regular) s.blame(s.matrix_t, "the constraints became linearly dependent");
      return regular ? 0 : 1;
    });
  };
  solver->ops->solve = [](SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, double) noexcept {
    Solver& s = *static_cast<Solver*>(self->content);
    if (x != b) N_VScale(1.0, b, x);
    return guarded(s, s.evaluated_at, [&] {
      double c = 0.0;
      check(IDAGetCurrentCj(s.ida.get(), &c), "IDAGetCurrentCj");
      // IDA keeps a matrix as long as Newton converges; fresh factors cost less than that saves.
      const bool stale = s.evaluated_at != s.factored_at;
      s.corrections = stale ? 1 : s.corrections + 1;
      if (stale || s.corrections > constants.corrections_of_one_matrix) {
        s.factored_at = s.evaluated_at;
        if (!s.newton.refresh(s.e, c)) return 1;
      }
      s.newton.solve(c, s.entries(x));
      return 0;
    });
  };
  solver->ops->free = [](SUNLinearSolver) { return 0; };  // owned by `solver`
}

}  // namespace dalembert
