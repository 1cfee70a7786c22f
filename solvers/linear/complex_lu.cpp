#include "dalembert/solvers/linear/complex_lu.h"

#include <klu.h>

#include <cassert>

namespace dalembert {

namespace {

/// KLU reads complex numbers as pairs (re, im), as std::complex lies in memory.
double* pairs(std::complex<double>* z) { return reinterpret_cast<double*>(z); }

}  // namespace

struct ComplexLU::State {
  explicit State(Matrix of) : A(std::move(of)) {
    A.makeCompressed();
    klu_defaults(&common);
    common.tol = 1.0;  // the largest of each column is its pivot: nothing is refined afterwards
    symbolic.reset(klu_analyze(size(), A.outerIndexPtr(), A.innerIndexPtr(), &common));
    if (!symbolic) return;
    numeric.reset(
        klu_z_factor(A.outerIndexPtr(), A.innerIndexPtr(), pairs(A.valuePtr()), symbolic.get(), &common));
    if (common.status != KLU_OK) numeric.reset();
  }

  [[nodiscard]] int size() const { return static_cast<int>(A.rows()); }

  struct FreeSymbolic {
    klu_common* common;
    void operator()(klu_symbolic* p) const { klu_free_symbolic(&p, common); }
  };
  struct FreeNumeric {
    klu_common* common;
    void operator()(klu_numeric* p) const { klu_z_free_numeric(&p, common); }
  };

  Matrix A;
  klu_common common{};
  std::unique_ptr<klu_symbolic, FreeSymbolic> symbolic{nullptr, {&common}};
  std::unique_ptr<klu_numeric, FreeNumeric> numeric{nullptr, {&common}};
};

ComplexLU::ComplexLU(Matrix A) : state_(std::make_unique<State>(std::move(A))) {}
ComplexLU::ComplexLU(ComplexLU&&) noexcept = default;
ComplexLU::~ComplexLU() = default;

bool ComplexLU::regular() const { return state_->numeric != nullptr; }

Eigen::VectorXcd ComplexLU::solve(Eigen::VectorXcd b) const {
  assert(regular() && b.size() == state_->size());
  klu_z_solve(state_->symbolic.get(), state_->numeric.get(), state_->size(), 1, pairs(b.data()),
              &state_->common);
  return b;
}

Eigen::VectorXcd ComplexLU::solve_adjoint(Eigen::VectorXcd b) const {
  assert(regular() && b.size() == state_->size());
  constexpr int conjugate = 1;
  klu_z_tsolve(state_->symbolic.get(), state_->numeric.get(), state_->size(), 1, pairs(b.data()), conjugate,
               &state_->common);
  return b;
}

}  // namespace dalembert
