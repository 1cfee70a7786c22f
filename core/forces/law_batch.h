#pragma once

#include <dalembert/core/equations/batch.h>
#include <dalembert/core/forces/friction.h>

namespace dalembert {

/// A type of forces given by their law F(t, [lambda,] r, v), lambda the multipliers of a constraint. A law is
/// called with plain numbers and, for its slopes, with numbers that carry derivatives by its positions, then
/// by its velocities, then by its multipliers.
struct LawType {
  ElementType elements;
  ForceShape shape;
  int directions;
  void (*numbers)(detail::Pass&);
  void (*duals)(detail::Pass&);
  int (*constraint)(const void* force);  ///< the number of the one that it reads; null if none
};

class LawBatch final : public ForceBatch {
 public:
  explicit LawBatch(const LawType& type);

  [[nodiscard]] bool holds(const std::type_info& type) const { return *elements_.type().type == type; }
  void add(const void* force);
  void replace(std::size_t i, const void* force);

  [[nodiscard]] std::unique_ptr<ForceBatch> clone() const override;
  [[nodiscard]] ForceShape shape() const override { return type_->shape; }
  [[nodiscard]] std::size_t size() const override { return elements_.size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return elements_.coordinates(); }
  [[nodiscard]] std::span<const int> constraints() const override { return constraints_; }

  void add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const override;
  void power(const Instant& at, const Multipliers& lambda, std::span<double> out) const override;
  void force(std::size_t element, const Instant& at, std::span<const double> lambda,
             std::span<double> out) const override;
  void slope(const Instant& at, const Multipliers& lambda, std::span<double> out) const override;
  void linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                 std::span<double> damping) const override;

 private:
  struct Work;
  template <int K>
  struct Slopes;
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(type_->shape.width); }

  const LawType* type_;
  Elements elements_;
  std::vector<int> constraints_;  // whose multipliers they read
  std::vector<int> in_order_;     // 0, 1, ..: the places of inputs that were gathered
};

namespace detail {

/// The law of an element and what it is called with behind time: `force` with positions and velocities, or
/// `friction` with multipliers in front of them.
template <class E>
struct LawTraits {
  using Function = ForceOf<E>;
  using Arguments = ProbeMotion<E>;
  static constexpr int rows = 0;
};
template <FrictionForce E>
struct LawTraits<E> {
  using Function = FrictionOf<E>;
  using Arguments = ProbeFriction<E>;
  static constexpr int rows = rows_read<E>;
};

template <class E>
inline constexpr bool law_takes_time =
    applicable_with_time<typename LawTraits<E>::Function, Probe<E>, typename LawTraits<E>::Arguments>;

/// What the law of a force returns.
template <class E>
using LawResult =
    Result<law_takes_time<E>, typename LawTraits<E>::Function, Probe<E>, typename LawTraits<E>::Arguments>;

/// Number `input` of those that a law is differentiated with respect to.
template <class S>
[[nodiscard]] DALEMBERT_INLINE S law_input(double value, [[maybe_unused]] int lane) {
  if constexpr (std::is_same_v<S, double>) {
    return value;
  } else {
    return S::input(value, lane);
  }
}

/// The force on each input of the one element of a pass.
template <class E, class S>
void run_law(Pass& pass) {
  constexpr int n = PointFacts<E>::inputs, rows = LawTraits<E>::rows;
  constexpr bool at_once = rows == 0 && directions_for(2 * n) == 2 * n;
  const auto& element = static_cast<const E*>(pass.elements)[pass.i];
  const typename LawTraits<E>::Function f{element};
  const int first = at_once ? 0 : pass.first;
  const int* const at = pass.at;
  const S t(pass.t);
  S r[n], v[n];
  const auto lift = [&]<int... k>(std::integer_sequence<int, k...>) DALEMBERT_INLINE_LAMBDA {
    ((r[k] = law_input<S>(pass.x[at[k]], k - first)), ...);
    ((v[k] = law_input<S>(pass.v[at[k]], n + k - first)), ...);
  };
  lift(std::make_integer_sequence<int, n>{});
  auto* const out = static_cast<S*>(pass.out);
  if constexpr (rows == 0) {
    write_forces<E>(call_in_motion<law_takes_time<E>>(f, element, t, r, v), out);
  } else {
    MultiplierOf<S, rows> lambda;
    if constexpr (rows == 1) {
      lambda = law_input<S>(pass.lambda[0], 2 * n - first);
    } else {
      for (int k = 0; k < rows; ++k) lambda[k] = law_input<S>(pass.lambda[k], 2 * n + k - first);
    }
    write_forces<E>(call_in_motion<law_takes_time<E>>(f, element, t, r, v, lambda), out);
  }
}

template <class E>
[[nodiscard]] int constraint_read(const void* force) {
  return static_cast<const E*>(force)->constraint().index;
}

template <class E>
[[nodiscard]] constexpr LawType make_law_type() {
  constexpr int rows = LawTraits<E>::rows, directions = directions_for(2 * PointFacts<E>::inputs);
  LawType its{.elements = element_type_of<E>(),
              .shape = {.kind = kind_of<E>(rows > 0 ? "Friction" : "ForceLaw"),
                        .width = PointFacts<E>::coordinates,
                        .rows = rows,
                        .dissipative = true,
                        .conservative = false,
                        .timed = law_takes_time<E> || PointFacts<E>::driven},
              .directions = directions,
              .numbers = &run_law<E, double>,
              .duals = &run_law<E, Dual<directions>>,
              .constraint = nullptr};
  if constexpr (rows > 0) its.constraint = &constraint_read<E>;
  return its;
}
template <class E>
inline constexpr LawType law_type = make_law_type<E>();

}  // namespace detail

}  // namespace dalembert
