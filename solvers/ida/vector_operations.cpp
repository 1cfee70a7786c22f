#include "dalembert/solvers/ida/vector_operations.h"

#include <dalembert/solvers/base/pairs.h>

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace dalembert {

namespace {

std::size_t length(N_Vector x) { return static_cast<std::size_t>(NV_LENGTH_S(x)); }

/// Sum of term(i), in four chains.
template <class Term>
double sum(std::size_t n, const Term& term) {
  std::array<double, 4> part{};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (std::size_t j = 0; j < 4; ++j) part[j] += term(i + j);
  }
  double total = (part[0] + part[1]) + (part[2] + part[3]);
  for (; i < n; ++i) total += term(i);
  return total;
}

double root_mean_square(N_Vector x, N_Vector weight) {
  const double* const v = NV_DATA_S(x);
  const double* const w = NV_DATA_S(weight);
  const std::size_t n = length(x);
  const double squares = sum(n, [=](std::size_t i) { return (v[i] * w[i]) * (v[i] * w[i]); });
  return std::sqrt(squares / static_cast<double>(n));
}

double root_mean_square_masked(N_Vector x, N_Vector weight, N_Vector mask) {
  const double* const v = NV_DATA_S(x);
  const double* const w = NV_DATA_S(weight);
  const double* const on = NV_DATA_S(mask);
  const std::size_t n = length(x);
  const double squares = sum(n, [=](std::size_t i) { return on[i] * ((v[i] * w[i]) * (v[i] * w[i])); });
  return std::sqrt(squares / static_cast<double>(n));
}

// Results may be one of the arguments, element by element, never shifted: no dependence for `ivdep`.
void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector result) {
  const double* const u = NV_DATA_S(x);
  const double* const v = NV_DATA_S(y);
  double* const z = NV_DATA_S(result);
  const std::size_t n = length(x);
#ifndef __clang__
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < n; ++i) z[i] = a * u[i] + b * v[i];
}

void scale(double a, N_Vector x, N_Vector result) {
  const double* const u = NV_DATA_S(x);
  double* const z = NV_DATA_S(result);
  const std::size_t n = length(x);
#ifndef __clang__
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < n; ++i) z[i] = a * u[i];
}

int linear_combination(int count, double* a, N_Vector* x, N_Vector result) {
  write_by_pairs(NV_DATA_S(result), length(result),
                 [&]<class T>(std::size_t i, T sum) DALEMBERT_INLINE_LAMBDA {
                   for (int j = 0; j < count; ++j) sum += a[j] * load<T>(NV_DATA_S(x[j]) + i);
                   return sum;
                 });
  return 0;
}

int linear_sums(int count, double a, N_Vector* x, double b, N_Vector* y, N_Vector* results) {
  for (int j = 0; j < count; ++j) linear_sum(a, x[j], b, y[j], results[j]);
  return 0;
}

int scale_all(int count, double* a, N_Vector* x, N_Vector* results) {
  for (int j = 0; j < count; ++j) scale(a[j], x[j], results[j]);
  return 0;
}

void constant(double a, N_Vector x) { std::fill_n(NV_DATA_S(x), length(x), a); }

}  // namespace

void vectorise(N_Vector x) {
  x->ops->nvwrmsnorm = root_mean_square;
  x->ops->nvwrmsnormmask = root_mean_square_masked;
  x->ops->nvlinearsum = linear_sum;
  x->ops->nvscale = scale;
  x->ops->nvconst = constant;
  x->ops->nvlinearcombination = linear_combination;
  x->ops->nvlinearsumvectorarray = linear_sums;
  x->ops->nvscalevectorarray = scale_all;
}

}  // namespace dalembert
