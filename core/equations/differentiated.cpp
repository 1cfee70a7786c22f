#include "dalembert/core/equations/differentiated.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/equations/scratch.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <numeric>

namespace dalembert::detail {

namespace {

constexpr std::size_t elements_at_once = 8;

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
  directions_.resize(n * n);
  for (std::size_t k = 0; k < n; ++k) directions_[k * n + k] = 1.0;
}

template <int K>
struct DifferentiatedEquations::Evaluation {
  const DifferentiatedEquations& own;
  const EquationType& its = *own.type_;
  const ElementType& of = its.elements;
  const Instant& at;
  const ConstraintValues& out;
  std::size_t from;
  std::size_t rows = size(its.rows), width = size(of.coordinates), inputs = size(of.inputs);
  bool at_once = its.variables <= K;
  std::size_t several = at_once ? 0 : (size(its.variables) + K - 1) / K * K;  ///< numbers of all passes
  std::size_t most = at_once ? elements_at_once : 1;

  void run_through(std::size_t end) {
    Scratch room(Scratch::size_of<Jet<K>>(most * rows) + 2 * Scratch::size_of<double>(most * inputs) +
                 Scratch::size_of<double>(rows * several));
    Jet<K>* const jets = room.template take<Jet<K>>(most * rows);
    double* const x = room.template take<double>(most * inputs);
    double* const x_s = room.template take<double>(most * inputs);
    double* const gradients = room.template take<double>(rows * several);
    for (std::size_t i = from; i < end;) {
      const std::size_t count = std::min(most, end - i);
      Pass pass{.elements = own.elements_.data(),
                .i = i,
                .count = static_cast<int>(count),
                .along_directions = false,
                .t = at.t,
                .t_s = 1.0,
                .x = at.q.data(),
                .x_s = at.v.data(),
                .v = at.v.data(),
                .at = own.elements_.coordinates(i).data(),
                .first = 0,
                .out = jets};
      if (!of.direct) {
        for (std::size_t e = 0; e < count; ++e)
          own.elements_.gather(i + e, at, x + e * inputs, x_s + e * inputs);
        pass.x = x;
        pass.x_s = pass.v = x_s;
        pass.at = own.in_order_.data();
      }
      if (at_once) {
        run(its.jets, pass);
        write(jets, i, count);
        if (!out.w.empty()) write_gradients(jets, i, count);
      } else {
        const std::size_t mark = Branches::next();
        for (; pass.first < its.variables && (pass.first == 0 || !out.w.empty()); pass.first += K) {
          Branches::again(mark);
          pass.i = i;
          pass.count = 1;
          pass.at = of.direct ? own.elements_.coordinates(i).data() : own.in_order_.data();
          run(its.jets, pass);
          for (std::size_t k = 0; k < rows; ++k)
            for (int j = 0; j < K; ++j) gradients[k * several + size(pass.first + j)] = jets[k].z[j];
        }
        write(jets, i, 1);
        if (!out.w.empty()) write_gradients(gradients, i);
      }
      i += count;
    }
  }

  /// What is no gradient, of elements from number `i` on.
  void write(const Jet<K>* value, std::size_t i, std::size_t count) const {
    const std::size_t first = (i - from) * rows, last = first + count * rows;
    for (std::size_t row = first; row < last; ++row, ++value) {
      if (!out.psi.empty()) {
        if (!std::isfinite(value->value)) throw ElementFault{from + row / rows, "is not a finite number"};
        out.psi[row] = its.on_velocities ? value->value : value->s;
        if (!its.on_velocities) out.g[row] = value->value;
      }
      if (!out.gamma.empty()) {
        const double gamma = its.on_velocities ? value->s : value->ss;
        if (!std::isfinite(gamma))
          throw ElementFault{from + row / rows, its.on_velocities ? "has no finite derivative"
                                                                  : "has no finite second derivative"};
        out.gamma[row] = gamma;
      }
    }
  }
  [[noreturn]] void refuse_gradient(std::size_t i) const {
    throw ElementFault{i, its.singular.empty() || its.on_velocities
                              ? "has no finite gradient"
                              : "has no gradient: " + std::string(its.singular)};
  }
  /// Of equations with all their derivatives in one number.
  void write_gradients(const Jet<K>* value, std::size_t i, std::size_t count) const {
    double* w = out.w.data() + (i - from) * rows * width;
    for (const std::size_t last = i + count; i < last; ++i) {
      for (std::size_t k = 0; k < rows; ++k, ++value, w += width) {
        if (zero_of(value->z) != 0.0) refuse_gradient(i);
        if (of.direct && of.inputs == K) {
          std::memcpy(w, value->z.p, K * sizeof(double));
        } else if (of.direct) {
          for (std::size_t j = 0; j < inputs; ++j) w[j] = value->z[static_cast<int>(j)];
        } else {
          own.elements_.pull_back(i, reinterpret_cast<const double*>(value->z.p), w);
        }
      }
    }
  }
  void write_gradients(const double* gradients, std::size_t i) const {
    for (std::size_t k = 0; k < rows; ++k, gradients += several) {
      for (std::size_t j = 0; j < inputs; ++j)
        if (!std::isfinite(gradients[j])) refuse_gradient(i);
      own.elements_.pull_back(i, gradients, out.w.data() + ((i - from) * rows + k) * width);
    }
  }
};

void DifferentiatedEquations::evaluate(const Instant& at, std::size_t from, std::size_t end,
                                       const ConstraintValues& out) const {
  with_directions(type_->directions, [&](auto K) {
    Evaluation<K.value>{.own = *this, .at = at, .out = out, .from = from}.run_through(end);
  });
}

template <int K>
struct DifferentiatedEquations::Linearisation {
  const DifferentiatedEquations& own;
  const EquationType& its = *own.type_;
  const ElementType& of = its.elements;
  const Instant& at;
  std::size_t i;
  const double* lambda;
  int rows = its.rows, inputs = of.inputs;
  bool at_once = its.variables <= K;
  std::size_t mark = Branches::next();
  int together = Branches::heard() ? 1 : inputs;  ///< directions in one pass
  // Of the rows along directions; inputs and rates; per row psi_r; of lambda times all rows the second
  // derivatives.
  HyperDual<K>* duals = nullptr;
  double *x = nullptr, *v = nullptr, *zeros = nullptr, *psi_r = nullptr, *sums = nullptr;
  double *slopes = nullptr, *curvatures = nullptr;

  void pass(const double* x_s, const double* v_s, int count, double t_s, int first) const {
    Branches::again(mark);
    Pass one{.elements = own.elements_.data(),
             .i = i,
             .count = count,
             .along_directions = true,
             .t = at.t,
             .t_s = t_s,
             .x = x,
             .x_s = x_s,
             .v = v,
             .v_s = v_s,
             .at = own.in_order_.data(),
             .first = first,
             .out = duals};
    run(its.duals, one);
  }

  void run_through(double* psi_q, double* block) {
    const std::size_t n = size(inputs), numbers = size(rows);
    Scratch room(Scratch::size_of<HyperDual<K>>(numbers * n) + 2 * Scratch::size_of<double>(n) +
                 Scratch::size_of<double>(numbers * n) + 2 * Scratch::size_of<double>(n * n) +
                 2 * Scratch::size_of<double>(numbers));
    duals = room.template take<HyperDual<K>>(numbers * n);
    x = room.template take<double>(n);
    v = room.template take<double>(n);
    psi_r = room.template take<double>(numbers * n);
    sums = room.template take<double>(n * n);
    own.elements_.gather(i, at, x, v);
    std::fill_n(sums, n * n, 0.0);
    for (int first = 0; first < inputs; first += K) {
      // Second derivatives of a holonomic equation are symmetric: those before `first` are known.
      int k = its.on_velocities ? 0 : first;
      while (k < inputs) {
        const int count = std::min(together, inputs - k);
        pass(own.directions_.data() + k * inputs, nullptr, count, 0.0, first);
        for (int c = 0; c < count; ++c) add_second(duals + c * rows, k + c, first);
        k += count;
      }
    }
    if (its.on_velocities) {
      zeros = room.template take<double>(n * n);
      slopes = room.template take<double>(numbers);
      curvatures = room.template take<double>(numbers);
      std::fill_n(zeros, n * n, 0.0);
      require_linear();
    } else {
      for (int a = 0; a < inputs; ++a)
        for (int b = (a / K + 1) * K; b < inputs; ++b) sums[a * inputs + b] = sums[b * inputs + a];
      if (psi_q != nullptr && !at_once) find_psi_r();
    }
    own.elements_.pull_back_block(i, sums, block);
    if (psi_q == nullptr) return;
    for (int r = 0; r < rows; ++r) own.elements_.pull_back(i, psi_r + r * inputs, psi_q + r * of.coordinates);
  }

  /// What the derivatives of the rows along input k contribute.
  void add_second(const HyperDual<K>* row, int k, int first) const {
    const int here = std::min(K, inputs - first);
    double zero = 0.0;
    for (int r = 0; r < rows; ++r) {
      const HyperDual<K>& g = row[r];
      double* const sum = sums + k * inputs + first;
      for (int j = 0; j < here; ++j) sum[j] += lambda[r] * g.zs[j];
      for (int j = 0; j < here; ++j) zero += 0.0 * g.zs[j];
      if (its.on_velocities) {
        zero += 0.0 * g.s + zero_of(g.z);
        psi_r[r * inputs + k] = g.s;
      } else if (at_once) {
        double along_motion = its.timed() ? g.zs[inputs] : 0.0;
        for (int j = 0; j < here; ++j) along_motion += g.zs[j] * v[j];
        zero += 0.0 * along_motion;
        psi_r[r * inputs + k] = along_motion;
      }
    }
    require_finite(zero == 0.0, i, "has no finite second derivative");
  }

  /// By passes along the motion, as no pass of the others has all second derivatives of a row.
  void find_psi_r() const {
    for (int first = 0; first < inputs; first += K) {
      pass(v, nullptr, 1, 1.0, first);
      for (int r = 0; r < rows; ++r) {
        for (int j = 0; j < std::min(K, inputs - first); ++j) {
          psi_r[r * inputs + first + j] = duals[r].zs[j];
          require_finite(std::isfinite(duals[r].zs[j]), i, "has no finite second derivative");
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
      for (int k = 0; k < inputs; k += together) {
        pass(zeros, own.directions_.data() + k * inputs, together, 0.0, first);
        const HyperDual<K>* g = duals;
        for (int c = 0; c < together; ++c) {
          for (int r = 0; r < rows; ++r, ++g) {
            for (int j = 0; j < std::min(K, inputs - first); ++j) {
              zero += 0.0 * g->zs[j];
              slopes[r] = std::max(slopes[r], std::abs(g->z[j]));
              curvatures[r] = std::max(curvatures[r], std::abs(g->zs[j]));
            }
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

void DifferentiatedEquations::linearise(const Instant& at, std::size_t i, const double* lambda, double* psi_q,
                                        double* block) const {
  with_directions(type_->directions, [&](auto K) {
    Linearisation<K.value>{.own = *this, .at = at, .i = i, .lambda = lambda}.run_through(psi_q, block);
  });
}

}  // namespace dalembert::detail
