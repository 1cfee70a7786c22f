#pragma once

#include <dalembert/core/autodiff/dual.h>

/// `std::sin(x)` in an equation, where x carries derivatives: said in one sentence, not in a page of
/// candidates. (Namespace std is not ours to add to; these declarations give no correct program another
/// meaning, and there is no other place where a call that names std looks.) The parameters are those of
/// Dual's own functions, which unqualified calls prefer even after `using std::sin;`.
#define DALEMBERT_NOT_OF_STD(name, ...)                                                            \
  template <int N, int Order>                                                                      \
  __attribute__((unavailable("call " #name                                                         \
                             "(...) without std:: in the equations of constraints and forces, "    \
                             "so that the function for numbers that carry derivatives is found"))) \
  dalembert::Dual<N, Order>                                                                        \
  name(__VA_ARGS__)

namespace std {

DALEMBERT_NOT_OF_STD(sqrt, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(exp, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(log, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(sin, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(cos, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(tan, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(asin, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(acos, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(atan, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(sinh, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(cosh, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(tanh, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(abs, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(pow, const dalembert::Dual<N, Order>&, double);
DALEMBERT_NOT_OF_STD(pow, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(atan2, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(hypot, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(exp2, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(expm1, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(log2, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(log10, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(log1p, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(cbrt, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(asinh, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(acosh, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(atanh, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(erf, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(erfc, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(fabs, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(floor, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(ceil, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(trunc, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(round, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(fmax, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(fmin, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(fdim, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(copysign, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(fmod, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(max, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(max, const dalembert::Dual<N, Order>&, double);
DALEMBERT_NOT_OF_STD(max, double, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(min, const dalembert::Dual<N, Order>&, const dalembert::Dual<N, Order>&);
DALEMBERT_NOT_OF_STD(min, const dalembert::Dual<N, Order>&, double);
DALEMBERT_NOT_OF_STD(min, double, const dalembert::Dual<N, Order>&);

}  // namespace std

#undef DALEMBERT_NOT_OF_STD
