#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string>

/// SUNDIALS' objects as owners that free them, and its return codes as exceptions.
namespace DALEMBERT_HIDDEN dalembert {

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
struct FreeNewton {
  void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};
template <class Handle, class Free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

/// Our own mistakes in calling IDA; a user never sees these.
inline void check(int code, const char* function) {
  if (code < 0) throw std::logic_error(std::string(function) + " returned " + std::to_string(code));
}
template <class Pointer>
Pointer check(Pointer pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

/// A context that says nothing: errors are return codes.
[[nodiscard]] inline Owned<SUNContext, FreeContext> make_context() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  check(SUNContext_Create(SUN_COMM_NULL, &context), "SUNContext_Create");
  check(SUNContext_ClearErrHandlers(context), "SUNContext_ClearErrHandlers");
#else  // IDA itself is told to be silent
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
#endif
  return Owned<SUNContext, FreeContext>(context);
}

}  // namespace dalembert
