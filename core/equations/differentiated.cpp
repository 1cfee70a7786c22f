#include "dalembert/core/equations/differentiated.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/equations/scratch.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <type_traits>

namespace dalembert::detail {

namespace {

constexpr std::size_t elements_at_once = 16;

[[nodiscard]] std::size_t size(int n) { return static_cast<std::size_t>(n); }

/// 0, or NaN if one of them is not finite: comparisons one after another would take longer. (A number beside
/// an odd K is 0, or not finite where others are not.)
template <int K>
[[nodiscard]] double zero_of(const Lanes<K>& x) {
  Pair zero = 0.0 * x.p[0];
  DALEMBERT_UNROLL for (int i = 1; i < Lanes<K>::pairs; ++i) zero += 0.0 * x.p[i];
  return zero[0] + zero[1];
}

}  // namespace

EquationFault named(const ElementFault& fault, const std::string& label, double t) {
  std::ostringstream when;
  when << " (t = " << std::setprecision(10) << t << ')';
  return EquationFault(label + ' ' + fault.what + when.str());
}

void rethrow_as_fault(std::size_t element) {
  try {
    throw;
  } catch (const ElementFault&) {
    throw;
  } catch (const std::exception& e) {
    throw ElementFault{element, std::string("threw \"") + e.what() + '"'};
  } catch (...) {
    throw ElementFault{element, "threw something that is no std::exception"};
  }
}

void run(void (*kernel)(Pass&), Pass& pass) {
  try {
    kernel(pass);
  } catch (...) {
    rethrow_as_fault(pass.i);
  }
}

DifferentiatedEquations::DifferentiatedEquations(const EquationType& type)
    : type_(&type), elements_(type.elements), in_order_(elements_at_once * size(type.elements.inputs)) {
  std::iota(in_order_.begin(), in_order_.end(), 0);
  const std::size_t n = size(type.elements.inputs);
  directions_.resize((n + 1) / 2 * 2 * n);
  for (std::size_t k = 0; k < n; ++k) directions_[k / 2 * 2 * n + 2 * k + k % 2] = 1.0;
}

/// By S = Dual, or by Jet if the bias is asked for.
template <class S>
struct DifferentiatedEquations::Evaluation {
  static constexpr int K = S::directions;
  static constexpr bool biased = S::along == 1;

  const DifferentiatedEquations& own;
  const EquationType& its = *own.type_;
  const ElementType& of = its.elements;
  const Instant& at;
  const ConstraintValues& out;
  std::size_t from;
  int inputs = of.inputs;
  std::size_t rows = size(its.rows), width = size(of.coordinates);

  void run_through(std::size_t end) const {
    if (its.variables <= K) {
      all_at_once(end);
    } else {
      in_passes(end);
    }
  }

  /// At elements from number i on; the inputs of those that do not simply read coordinates go to x and x_s.
  [[nodiscard]] Pass pass_of(std::size_t i, std::size_t count, double* x, double* x_s, S* values) const {
    Pass pass{.elements = own.elements_.data(),
              .i = i,
              .count = static_cast<int>(count),
              .t = at.t,
              .t_s = 1.0,
              .x = at.q.data(),
              .x_s = at.v.data(),
              .v = at.v.data(),
              .at = own.elements_.coordinates(i).data(),
              .first = 0,
              .out = values};
    if (of.direct) return pass;
    for (std::size_t e = 0; e < count; ++e)
      own.elements_.gather(i + e, at, x + e * size(inputs), x_s + e * size(inputs));
    pass.x = x;
    pass.x_s = pass.v = x_s;
    pass.at = own.in_order_.data();
    return pass;
  }

  void all_at_once(std::size_t end) const {
    Scratch room(Scratch::size_of<S>(elements_at_once * rows) +
                 2 * Scratch::size_of<double>(elements_at_once * size(inputs)));
    S* const values = room.template take<S>(elements_at_once * rows);
    double* const x = room.template take<double>(elements_at_once * size(inputs));
    double* const x_s = room.template take<double>(elements_at_once * size(inputs));
    for (std::size_t i = from; i < end;) {
      const std::size_t count = std::min(elements_at_once, end - i);
      Pass pass = pass_of(i, count, x, x_s, values);
      const double* const rates = pass.x_s;
      const int* places = pass.at;
      run(biased ? its.jets : its.duals, pass);
      const auto gradient = [](const S& value) { return reinterpret_cast<const double*>(value.z.p); };
      const S* value = values;
      for (std::size_t e = 0; e < count; ++e, places += inputs) {
        for (std::size_t r = 0; r < rows; ++r, ++value)
          write(*value, gradient(*value), std::integral_constant<int, K>{}, i + e, r, rates, places);
      }
      if (!of.direct && !out.w.empty()) {
        for (std::size_t row = 0; row < count * rows; ++row)
          own.elements_.pull_back(i + row / rows, gradient(values[row]), w_of(i, row));
      }
      i += count;
    }
  }

  void in_passes(std::size_t end) const {
    const bool gradients_asked = !biased || !out.w.empty();
    const std::size_t passes = gradients_asked ? (size(its.variables) + K - 1) / K : 1, several = passes * K;
    Scratch room(Scratch::size_of<S>(rows) + 2 * Scratch::size_of<double>(size(inputs)) +
                 Scratch::size_of<double>(rows * several));
    S* const values = room.template take<S>(rows);
    double* const x = room.template take<double>(size(inputs));
    double* const x_s = room.template take<double>(size(inputs));
    double* const gradients = room.template take<double>(rows * several);
    for (std::size_t i = from; i < end; ++i) {
      const std::size_t mark = Branches::next();
      const Pass first = pass_of(i, 1, x, x_s, values);
      for (std::size_t p = 0; p < passes; ++p) {
        Branches::again(mark);
        Pass pass = first;
        pass.first = static_cast<int>(p) * K;
        run(biased ? its.jets : its.duals, pass);
        for (std::size_t r = 0; r < rows; ++r)
          for (std::size_t j = 0; j < K; ++j)
            gradients[r * several + p * K + j] = values[r].z[static_cast<int>(j)];
      }
      for (std::size_t r = 0; r < rows; ++r)
        write(values[r], gradients + r * several, its.variables, i, r, first.x_s, first.at);
      if (!of.direct && !out.w.empty()) {
        for (std::size_t r = 0; r < rows; ++r)
          own.elements_.pull_back(i, gradients + r * several, w_of(i, r));
      }
    }
  }

  [[nodiscard]] double* w_of(std::size_t i, std::size_t row) const {
    return out.w.data() + ((i - from) * rows + row) * width;
  }

  /// Row r of element i, its gradient by coordinates only if they are its inputs. `variables` is a constant
  /// where it is known.
  template <class Count>
  DALEMBERT_INLINE void write(const S& g, const double* gradient, Count variables, std::size_t i,
                              std::size_t r, const double* rates, const int* places) const {
    const std::size_t row = (i - from) * rows + r;
    double zero = 0.0;  // or NaN where a number is not finite: one comparison instead of many
    if (!out.psi.empty()) {
      zero = 0.0 * g.value;
      if (its.on_velocities) {
        out.psi[row] = g.value;
      } else {
        out.g[row] = g.value;
        if constexpr (biased) {
          out.psi[row] = g.s;
        } else {
          out.psi[row] = rate(gradient, variables, rates, places);
        }
      }
    }
    if (!out.w.empty()) {
      for (int j = 0; j < variables; ++j) zero += 0.0 * gradient[j];
      if (of.direct) {
        double* const w = w_of(i, r);
        const int last = variables - 1;
        for (int j = 0; j < last; ++j) w[j] = gradient[j];
        if (!its.timed()) w[last] = gradient[last];
      }
    }
    if constexpr (biased) {
      out.gamma[row] = its.on_velocities ? g.s : g.ss;
      zero += 0.0 * out.gamma[row];
    }
    if (zero != 0.0) refuse(g, gradient, variables, i);
  }
  /// g_r v + g_t.
  template <class Count>
  [[nodiscard]] DALEMBERT_INLINE double rate(const double* gradient, Count variables, const double* rates,
                                             const int* places) const {
    const int last = variables - 1;
    double sum = its.timed() ? gradient[last] : gradient[last] * rates[places[last]];
    for (int j = 0; j < last; ++j) sum += gradient[j] * rates[places[j]];
    return sum;
  }
  /// Says which of its numbers is not finite.
  [[noreturn, gnu::noinline]] void refuse(const S& g, const double* gradient, int variables,
                                          std::size_t i) const {
    if (!out.psi.empty()) require_finite(std::isfinite(g.value), i, "is not a finite number");
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!out.w.empty() && !std::all_of(gradient, gradient + variables, finite)) {
      // Where a root is 0 no derivative of it is a number, whatever it depends on.
      const std::string none =
          its.timed() ? "has no gradient, or no derivative by time: " : "has no gradient: ";
      throw ElementFault{i, its.singular.empty() || its.on_velocities ? "has no finite gradient"
                                                                      : none + std::string(its.singular)};
    }
    throw ElementFault{i, its.on_velocities ? "has no finite derivative" : "has no finite second derivative"};
  }
};

void DifferentiatedEquations::evaluate(const Instant& at, std::size_t from, std::size_t end,
                                       const ConstraintValues& out) const {
  with_directions(type_->directions, [&](auto K) {
    if (out.gamma.empty()) {
      Evaluation<Dual<K>>{.own = *this, .at = at, .out = out, .from = from}.run_through(end);
    } else {
      Evaluation<Jet<K>>{.own = *this, .at = at, .out = out, .from = from}.run_through(end);
    }
  });
}

/// d(W^T lambda)/dq and psi_q, by pairs of directions.
template <int K>
struct DifferentiatedEquations::Linearisation {
  using S = HyperDual<K>;
  Linearisation(const DifferentiatedEquations& equations, const Instant& instant)
      : own(equations), at(instant) {}
  const DifferentiatedEquations& own;
  const Instant& at;
  const EquationType& its = *own.type_;
  const ElementType& of = its.elements;
  int rows = its.rows, inputs = of.inputs, pairs = (inputs + 1) / 2;
  std::size_t n = size(inputs), numbers = size(rows), all = size(pairs) * 2 * n;
  bool recorded = Branches::recording();
  Scratch room{Scratch::size_of<S>(numbers * size(pairs)) + 2 * Scratch::size_of<double>(n) +
               Scratch::size_of<double>(numbers * n) + Scratch::size_of<double>(n * n) +
               2 * Scratch::size_of<double>(all) + 2 * Scratch::size_of<double>(numbers)};
  // Of the rows along directions; inputs and rates; per row psi_r; of lambda times all rows the second
  // derivatives.
  S* values = room.template take<S>(numbers * size(pairs));
  double *x = room.template take<double>(n), *v = room.template take<double>(n),
         *psi_r = room.template take<double>(numbers * n), *sums = room.template take<double>(n * n),
         *zeros = room.template take<double>(all), *motion = room.template take<double>(all),
         *slopes = room.template take<double>(numbers), *curvatures = room.template take<double>(numbers);
  // The element at work.
  std::size_t i = 0, mark = 0;
  const double* lambda = nullptr;

  void pass(const double* x_s, const double* v_s, int count, double t_s, int first, S* out) const {
    if (recorded) Branches::again(mark);
    Pass one{.elements = own.elements_.data(),
             .i = i,
             .count = count,
             .t = at.t,
             .t_s = t_s,
             .x = x,
             .x_s = x_s,
             .v = v,
             .v_s = v_s,
             .at = own.in_order_.data(),
             .first = first,
             .out = out};
    run(its.hyper_duals, one);
  }
  [[nodiscard]] const double* directions(int pair) const {
    return own.directions_.data() + pair * 2 * inputs;
  }
  /// The rows along pairs of positions from number `from` on; in one pass, but where comparisons are
  /// recorded.
  void along_positions(int from, int first) const {
    const int together = recorded ? 1 : pairs - from;
    for (int p = from; p < pairs; p += together)
      pass(directions(p), zeros, together, 0.0, first, values + (p - from) * rows);
  }
  void along_velocities(int first) const {
    const int together = recorded ? 1 : pairs;
    for (int p = 0; p < pairs; p += together)
      pass(zeros, directions(p), together, 0.0, first, values + p * rows);
  }

  void run_through(std::size_t from, std::size_t end, const double* lambdas, double* psi_q, double* blocks) {
    std::fill_n(zeros, all, 0.0);
    const std::size_t width = size(of.coordinates);
    for (i = from; i < end; ++i, lambdas += rows, blocks += width * width) {
      lambda = lambdas;
      mark = Branches::next();
      own.elements_.gather(i, at, x, v);
      if (its.variables <= K) {
        at_once();
      } else {
        in_passes(psi_q != nullptr);
      }
      if (its.on_velocities) require_linear();
      own.elements_.pull_back_block(i, sums, blocks);
      if (psi_q == nullptr) continue;
      if (of.direct) {
        for (int k = 0; k < rows * inputs; ++k) *psi_q++ = psi_r[k];
      } else {
        for (int r = 0; r < rows; ++r, psi_q += width) own.elements_.pull_back(i, psi_r + r * inputs, psi_q);
      }
    }
  }

  /// Sums of numbers that stand in pairs: all K at a time.
  void at_once() const {
    Lanes<K> motion = Lanes<K>::zero(), sum[2];
    for (int j = 0; j < inputs; ++j) motion.p[j / 2][j % 2] = v[j];
    if (its.timed()) motion.p[(K - 1) / 2][(K - 1) % 2] = 1.0;
    Pair zero{0.0, 0.0};
    along_positions(0, 0);
    const S* g = values;
    for (int k = 0; k < inputs; k += 2) {
      sum[0] = sum[1] = Lanes<K>::zero();
      const int here = std::min(2, inputs - k);
      for (int r = 0; r < rows; ++r, ++g) {
        for (int d = 0; d < here; ++d) {
          sum[d] = sum[d] + lambda[r] * g->zs[d];
          Pair along_motion{0.0, 0.0};
          DALEMBERT_UNROLL for (int p = 0; p < Lanes<K>::pairs; ++p) {
            along_motion += g->zs[d].p[p] * motion.p[p];
            zero += 0.0 * g->zs[d].p[p];
          }
          psi_r[r * inputs + k + d] = its.on_velocities ? g->s[d] : along_motion[0] + along_motion[1];
        }
        if (its.on_velocities) zero[0] += 0.0 * g->s[0] + 0.0 * g->s[1] + zero_of(g->z);
      }
      for (int d = 0; d < here; ++d)
        for (int j = 0; j < inputs; ++j) sums[(k + d) * inputs + j] = sum[d][j];
    }
    require_finite(zero[0] + zero[1] == 0.0, i, "has no finite second derivative");
  }

  void in_passes(bool with_psi_q) const {
    std::fill_n(sums, n * n, 0.0);
    for (int first = 0; first < inputs; first += K) {
      // Second derivatives of a holonomic equation are symmetric: those before `first` are known.
      const int from = its.on_velocities ? 0 : first / 2;
      along_positions(from, first);
      for (int p = from; p < pairs; ++p) add_second(values + (p - from) * rows, 2 * p, first);
    }
    if (its.on_velocities) return;
    for (int a = 0; a < inputs; ++a)
      for (int b = (a / K + 1) * K; b < inputs; ++b) sums[a * inputs + b] = sums[b * inputs + a];
    if (with_psi_q) find_psi_r();
  }

  /// What the derivatives of the rows along inputs k and k + 1 contribute.
  void add_second(const S* row, int k, int first) const {
    const int here = std::min(K, inputs - first);
    double zero = 0.0;
    for (int r = 0; r < rows; ++r) {
      const S& g = row[r];
      if (its.on_velocities) zero += 0.0 * g.s[0] + 0.0 * g.s[1] + zero_of(g.z);
      for (int d = 0; d < 2 && k + d < inputs; ++d) {
        double* const sum = sums + (k + d) * inputs + first;
        for (int j = 0; j < here; ++j) sum[j] += lambda[r] * g.zs[d][j];
        for (int j = 0; j < here; ++j) zero += 0.0 * g.zs[d][j];
        if (its.on_velocities) psi_r[r * inputs + k + d] = g.s[d];
      }
    }
    require_finite(zero == 0.0, i, "has no finite second derivative");
  }

  /// By passes along the motion, as no pass of the others has all second derivatives of a row.
  void find_psi_r() const {
    for (int k = 0; k < inputs; ++k) {
      motion[2 * k] = v[k];
      motion[2 * k + 1] = 0.0;
    }
    for (int first = 0; first < inputs; first += K) {
      pass(motion, zeros, 1, 1.0, first, values);
      for (int r = 0; r < rows; ++r) {
        for (int j = 0; j < std::min(K, inputs - first); ++j) {
          const double along_motion = values[r].zs[0][j];
          require_finite(std::isfinite(along_motion), i, "has no finite second derivative");
          psi_r[r * inputs + first + j] = along_motion;
        }
      }
    }
  }

  /// d^2 a/dv^2 vanishes for an equation linear in v; 1e-9 of the first derivative is far above the
  /// round-off of any formula that is linear after cancellation.
  void require_linear() const {
    double speed = 0.0;
    for (int k = 0; k < inputs; ++k) speed = std::max(speed, std::abs(v[k]));
    if (speed == 0.0) return;
    std::fill_n(slopes, rows, 0.0);
    std::fill_n(curvatures, rows, 0.0);
    double zero = 0.0;
    for (int first = 0; first < inputs; first += K) {
      along_velocities(first);
      const S* g = values;
      for (int p = 0; p < pairs; ++p) {
        for (int r = 0; r < rows; ++r, ++g) {
          for (int j = 0; j < std::min(K, inputs - first); ++j) {
            const double second = std::max(std::abs(g->zs[0][j]), std::abs(g->zs[1][j]));
            zero += 0.0 * g->zs[0][j] + 0.0 * g->zs[1][j];
            slopes[r] = std::max(slopes[r], std::abs(g->z[j]));
            curvatures[r] = std::max(curvatures[r], second);
          }
        }
      }
    }
    require_finite(zero == 0.0, i, "has no finite second derivative");
    for (int r = 0; r < rows; ++r)
      require_finite(curvatures[r] * speed <= 1e-9 * slopes[r], i,
                     "is not linear in the velocities, as d'Alembert's principle requires");
  }
};

void DifferentiatedEquations::linearise(const Instant& at, std::size_t from, std::size_t end,
                                        const double* lambda, double* psi_q, double* blocks) const {
  with_directions(type_->directions, [&](auto K) {
    Linearisation<K.value>(*this, at).run_through(from, end, lambda, psi_q, blocks);
  });
}

}  // namespace dalembert::detail
