#pragma once

#include <dalembert/core/autodiff/functions.h>

/// `std::sin(x)` in an equation, where x carries derivatives: said in one sentence, not in a page of
/// candidates. (Namespace std is not ours to add to; these declarations give no correct program another
/// meaning, and there is no other place where a call that names std looks.) The parameters are those of
/// our own functions, which unqualified calls prefer even after `using std::sin;`, as they ask for more.
#define DALEMBERT_NOT_OF_STD(name, ...)                                                              \
  template <dalembert::AnyDifferentiated D>                                                          \
  __attribute__((unavailable("call " #name                                                           \
                             "(...) without std:: in the equations of constraints and forces, "      \
                             "so that the function for numbers that carry derivatives is found"))) D \
  name(__VA_ARGS__)

namespace std {

DALEMBERT_NOT_OF_STD(sqrt, const D&);
DALEMBERT_NOT_OF_STD(exp, const D&);
DALEMBERT_NOT_OF_STD(log, const D&);
DALEMBERT_NOT_OF_STD(sin, const D&);
DALEMBERT_NOT_OF_STD(cos, const D&);
DALEMBERT_NOT_OF_STD(tan, const D&);
DALEMBERT_NOT_OF_STD(asin, const D&);
DALEMBERT_NOT_OF_STD(acos, const D&);
DALEMBERT_NOT_OF_STD(atan, const D&);
DALEMBERT_NOT_OF_STD(sinh, const D&);
DALEMBERT_NOT_OF_STD(cosh, const D&);
DALEMBERT_NOT_OF_STD(tanh, const D&);
DALEMBERT_NOT_OF_STD(abs, const D&);
DALEMBERT_NOT_OF_STD(pow, const D&, double);
DALEMBERT_NOT_OF_STD(pow, const D&, const D&);
DALEMBERT_NOT_OF_STD(atan2, const D&, const D&);
DALEMBERT_NOT_OF_STD(hypot, const D&, const D&);
DALEMBERT_NOT_OF_STD(exp2, const D&);
DALEMBERT_NOT_OF_STD(expm1, const D&);
DALEMBERT_NOT_OF_STD(log2, const D&);
DALEMBERT_NOT_OF_STD(log10, const D&);
DALEMBERT_NOT_OF_STD(log1p, const D&);
DALEMBERT_NOT_OF_STD(cbrt, const D&);
DALEMBERT_NOT_OF_STD(asinh, const D&);
DALEMBERT_NOT_OF_STD(acosh, const D&);
DALEMBERT_NOT_OF_STD(atanh, const D&);
DALEMBERT_NOT_OF_STD(erf, const D&);
DALEMBERT_NOT_OF_STD(erfc, const D&);
DALEMBERT_NOT_OF_STD(fabs, const D&);
DALEMBERT_NOT_OF_STD(floor, const D&);
DALEMBERT_NOT_OF_STD(ceil, const D&);
DALEMBERT_NOT_OF_STD(trunc, const D&);
DALEMBERT_NOT_OF_STD(round, const D&);
DALEMBERT_NOT_OF_STD(fmax, const D&, const D&);
DALEMBERT_NOT_OF_STD(fmin, const D&, const D&);
DALEMBERT_NOT_OF_STD(fdim, const D&, const D&);
DALEMBERT_NOT_OF_STD(copysign, const D&, const D&);
DALEMBERT_NOT_OF_STD(fmod, const D&, const D&);
DALEMBERT_NOT_OF_STD(max, const D&, const D&);
DALEMBERT_NOT_OF_STD(max, const D&, double);
DALEMBERT_NOT_OF_STD(max, double, const D&);
DALEMBERT_NOT_OF_STD(min, const D&, const D&);
DALEMBERT_NOT_OF_STD(min, const D&, double);
DALEMBERT_NOT_OF_STD(min, double, const D&);

}  // namespace std

#undef DALEMBERT_NOT_OF_STD
