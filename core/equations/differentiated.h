#pragma once

#include <dalembert/core/equations/kernel.h>
#include <dalembert/core/errors.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

/// Thrown by a batch when one of its elements threw or gave a number that is not finite. Who evaluates the
/// batch turns the element's index into its name.
struct ElementFault {
  std::size_t element;
  std::string what;
};

/// Where equations write their values. Row r of element e is number `e * rows + r` and owns `width`
/// consecutive entries of w; what is empty is not asked for.
struct ConstraintValues {
  std::span<double> g;        ///< position residual (holonomic only)
  std::span<double> psi;      ///< velocity residual
  std::span<double> w{};      ///< d psi / dv
  std::span<double> gamma{};  ///< bias, see ConstraintBatch::bias
};

namespace detail {

/// The error of an element of this label at time t.
[[nodiscard]] EquationFault named(const ElementFault& fault, const std::string& label, double t);

inline void require_finite(bool finite, std::size_t element, const char* what) {
  if (!finite) throw ElementFault{element, what};
}

/// In a handler of whatever an element has thrown: throws it as the fault of that element.
[[noreturn]] void rethrow_as_fault(std::size_t element);
/// Calls a kernel; what its equation throws becomes the fault of the element that it was at.
void run(void (*kernel)(Pass&), Pass& pass);

/// Equations of one type with every derivative taken from the equation itself.
///
/// With z = (inputs, t) and dots along the motion (r' = v, t' = 1), for a holonomic g(t, r):
///   psi   = g_r v + g_t                      W = g_r
///   gamma = psi_r v + psi_t = d^2 g / ds^2   along r + v s, t + s
///   psi_q = (g_zz (v, 1))_r                  d(W^T lambda)/dq = lambda g_rr
/// and for a(t, r, v), linear in v:
///   psi = a,   W = a_v,   gamma = a_r v + a_t  (along r + v s, t + s with v held),   psi_q = a_r,
///   d(W^T lambda)/dq = lambda a_vr
class DifferentiatedEquations {
 public:
  explicit DifferentiatedEquations(const EquationType& type);

  [[nodiscard]] const EquationType& type() const { return *type_; }
  [[nodiscard]] Elements& elements() { return elements_; }
  [[nodiscard]] const Elements& elements() const { return elements_; }

  /// Values of elements from number `from` to before `end`; the first row is that of number `from`.
  void evaluate(const Instant& at, std::size_t from, std::size_t end, const ConstraintValues& out) const;
  /// Of the same psi_q, unless it is null, and d(W^T lambda)/dq as blocks by rows; `lambda` of each row.
  void linearise(const Instant& at, std::size_t from, std::size_t end, const double* lambda, double* psi_q,
                 double* blocks) const;

 private:
  template <class S>
  struct Evaluation;
  template <int K>
  struct Linearisation;

  const EquationType* type_;
  Elements elements_;
  std::vector<int> in_order_;       // 0, 1, ..: the places of inputs that were gathered
  std::vector<double> directions_;  // unit vectors, by pairs: the two numbers of each input in turn
};

}  // namespace detail

}  // namespace dalembert
