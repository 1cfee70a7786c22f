#include "dalembert/core/forces/law_batch.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/equations/scratch.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dalembert {

using detail::Scratch;

LawBatch::LawBatch(const LawType& type)
    : type_(&type), elements_(type.elements), in_order_(static_cast<std::size_t>(type.elements.inputs)) {
  std::iota(in_order_.begin(), in_order_.end(), 0);
}

void LawBatch::add(const void* force) {
  if (type_->constraint != nullptr) constraints_.push_back(type_->constraint(force));
  try {
    elements_.add(force);
  } catch (...) {
    if (type_->constraint != nullptr) constraints_.pop_back();
    throw;
  }
}

void LawBatch::replace(std::size_t i, const void* force) {
  elements_.replace(i, force);
  if (type_->constraint != nullptr) constraints_[i] = type_->constraint(force);
}

std::unique_ptr<ForceBatch> LawBatch::clone() const { return std::make_unique<LawBatch>(*this); }

/// What the law of one element after another is evaluated at, and the forces on its inputs.
struct LawBatch::Work {
  Work(const LawBatch& batch, const Instant& instant) : own(batch), at(instant) {}
  const LawBatch& own;
  const Instant& at;
  const ElementType& of = own.elements_.type();
  std::size_t n = static_cast<std::size_t>(of.inputs);
  Scratch room{Scratch::size_of<double>(3 * n + own.width())};
  double *x = room.take<double>(3 * n + own.width()), *v = x + n, *f = v + n, *g = f + n;
  detail::Pass pass{.elements = own.elements_.data(),
                    .i = 0,
                    .count = 1,
                    .t = at.t,
                    .t_s = 0.0,
                    .x = of.direct ? at.q.data() : x,
                    .x_s = nullptr,
                    .v = of.direct ? at.v.data() : v,
                    .at = own.in_order_.data(),
                    .first = 0,
                    .out = f};

  /// Direct elements read q and v in place; the inputs of others are gathered.
  void go_to(std::size_t i, std::span<const double> lambda) {
    pass.i = i;
    pass.lambda = lambda.data();
    if (of.direct) {
      pass.at = own.elements_.coordinates(i).data();
    } else {
      own.elements_.gather(i, at, x, v);
    }
  }
  void evaluate(std::size_t i, std::span<const double> lambda) {
    go_to(i, lambda);
    detail::run(own.type_->numbers, pass);
  }
  void require_finite() const {
    double zero = 0.0;  // or NaN
    for (std::size_t k = 0; k < n; ++k) zero += 0.0 * f[k];
    detail::require_finite(zero == 0.0, pass.i, "is not a finite number");
  }
  /// The forces on the coordinates that the element reads.
  [[nodiscard]] const double* on_coordinates() const {
    if (of.direct) return f;
    own.elements_.pull_back(pass.i, f, g);
    return g;
  }
  /// The multipliers that element i reads.
  [[nodiscard]] std::span<const double> read(const Multipliers& lambda, std::size_t i) const {
    return own.type_->constraint == nullptr
               ? std::span<const double>()
               : lambda.all.subspan(lambda.first_row[i], static_cast<std::size_t>(own.type_->shape.rows));
  }
};

/// The law of one element in numbers that carry K of its derivatives.
template <int K>
struct LawBatch::Slopes {
  Slopes(Work& of, std::size_t element, std::span<const double> multipliers)
      : work(of), i(element), lambda(multipliers) {}
  Work& work;
  std::size_t i;
  std::span<const double> lambda;
  int n = static_cast<int>(work.n);
  std::size_t mark = Branches::next();
  Scratch room{Scratch::size_of<Dual<K>>(work.n)};
  Dual<K>* f = room.template take<Dual<K>>(work.n);

  void run(int first) {
    Branches::again(mark);
    work.go_to(i, lambda);
    detail::Pass pass = work.pass;
    pass.first = first;
    pass.out = f;
    detail::run(work.own.type_->duals, pass);
  }
  /// Calls write(row, variable, slope) for variables from `first` to before `end`.
  template <class F>
  void find(int first, int end, const F& write) {
    for (; first < end; first += K) {
      run(first);
      for (int row = 0; row < n; ++row) {
        bool finite = std::isfinite(f[row].value);
        for (int j = 0; j < std::min(K, end - first); ++j) {
          finite &= std::isfinite(f[row].z[j]);
          write(row, first + j, f[row].z[j]);
        }
        detail::require_finite(finite, i, "has no finite derivative");
      }
    }
  }
};

void LawBatch::add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const {
  const bool by_numbers = !Branches::needed();
  Work work(*this, at);
  for (std::size_t i = 0; i < size(); ++i) {
    const auto read = work.read(lambda, i);
    if (by_numbers) {
      work.evaluate(i, read);
      work.require_finite();
    } else {  // with numbers that report their comparisons
      detail::with_directions(type_->directions, [&](auto K) {
        Branches::or_naturally<ElementFault>([&] {
          Slopes<K.value> slopes(work, i, read);
          slopes.run(0);
          for (std::size_t k = 0; k < work.n; ++k) work.f[k] = slopes.f[k].value;
          work.require_finite();
        });
      });
    }
    const double* const acting = work.on_coordinates();
    const auto place = elements_.coordinates(i);
    for (std::size_t k = 0; k < place.size(); ++k) F[static_cast<std::size_t>(place[k])] += acting[k];
  }
}

void LawBatch::power(const Instant& at, const Multipliers& lambda, std::span<double> out) const {
  Work work(*this, at);
  for (std::size_t i = 0; i < size(); ++i) {
    work.evaluate(i, work.read(lambda, i));
    work.require_finite();
    out[i] = 0.0;
    for (std::size_t k = 0; k < work.n; ++k) out[i] += work.f[k] * work.pass.v[work.pass.at[k]];
  }
}

void LawBatch::force(std::size_t element, const Instant& at, std::span<const double> lambda,
                     std::span<double> out) const {
  Work work(*this, at);
  work.evaluate(element, lambda);
  work.require_finite();
  std::copy_n(work.on_coordinates(), width(), out.begin());
}

void LawBatch::slope(const Instant& at, const Multipliers& lambda, std::span<double> out) const {
  if (type_->constraint == nullptr) return;
  Work work(*this, at);
  const int n = type_->elements.inputs, rows = type_->shape.rows;
  Scratch room(Scratch::size_of<double>(work.n * static_cast<std::size_t>(rows)));
  double* const by_lambda = room.take<double>(work.n * static_cast<std::size_t>(rows));
  detail::with_directions(type_->directions, [&](auto K) {
    for (std::size_t i = 0; i < size(); ++i) {
      Slopes<K.value> slopes(work, i, work.read(lambda, i));
      slopes.find(2 * n, 2 * n + rows, [&](int row, int variable, double slope) {
        by_lambda[(variable - 2 * n) * n + row] = slope;
      });
      for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r)
        elements_.pull_back(i, by_lambda + r * work.n,
                            out.data() + (i * static_cast<std::size_t>(rows) + r) * width());
    }
  });
}

void LawBatch::linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                         std::span<double> damping) const {
  Work work(*this, at);
  const int n = type_->elements.inputs;
  Scratch room(Scratch::size_of<double>(2 * work.n * work.n));
  double* const by_variables = room.take<double>(2 * work.n * work.n);  // F_r, then F_v, by columns
  detail::with_directions(type_->directions, [&](auto K) {
    for (std::size_t i = 0; i < size(); ++i) {
      Slopes<K.value> slopes(work, i, work.read(lambda, i));
      slopes.find(0, 2 * n,
                  [&](int row, int variable, double slope) { by_variables[variable * n + row] = slope; });
      const std::size_t block = i * width() * width();
      elements_.pull_back_block(i, by_variables, stiffness.data() + block);
      elements_.pull_back_block(i, by_variables + n * n, damping.data() + block);
    }
  });
}

}  // namespace dalembert
