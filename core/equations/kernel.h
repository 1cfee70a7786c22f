#pragma once

#include <dalembert/core/equations/elements.h>

#include <string_view>
#include <utility>

/// What is compiled for each type of equation: its evaluation with three numbers that carry derivatives,
/// and a table of facts. All else, from the state to the equation and from there to residuals, gradients and
/// blocks, is compiled once (differentiated.cpp).
namespace dalembert::detail {

/// What a pass evaluates an equation at, `count` times: for one element after another, whose places `at`
/// follow those of the one before, or with HyperDuals for one element along directions s after another. Input
/// k has the value x[at[k]] and changes at the rate x_s[at[k]] along s, with a HyperDual x_s[2 at[k]] and the
/// number behind it along its two. Derivatives are taken in the directions of the inputs from number `first`
/// on, as many as the number has; behind the inputs comes time.
struct Pass {
  const void* elements;
  std::size_t i;  ///< the element that is at work
  int count;
  double t, t_s;  ///< along the second of two directions 0
  const double *x, *x_s;
  const double *v = nullptr, *v_s = nullptr;  ///< velocities of the inputs, and with HyperDuals their rates
  const double* lambda = nullptr;             ///< multipliers that a law reads
  const int* at;
  int first;
  void* out;  ///< of each evaluation its rows in turn
};

/// Calls f with std::integral_constant<int, directions>.
template <class F>
void with_directions(int directions, const F& f) {
  const auto one_of = [&]<int... K>(std::integer_sequence<int, K...>) {
    (void)((directions == K + 1 && (f(std::integral_constant<int, K + 1>{}), true)) || ...);
  };
  one_of(std::make_integer_sequence<int, 9>{});
}

/// A type of equations, g(t, r) or a(t, r, v).
struct EquationType {
  ElementType elements;
  int rows;
  int variables;   ///< inputs that it is differentiated with respect to, with time if it depends on that
  int directions;  ///< of those at a time
  bool on_velocities;
  std::string_view singular;  ///< what it means if the gradient vanishes or has no value, if that is known
  void (*duals)(Pass&);
  void (*jets)(Pass&);  ///< null of energies
  void (*hyper_duals)(Pass&);

  [[nodiscard]] bool timed() const { return variables > elements.inputs; }
};

/// How an equation is called: `function(element)` is what has an operator().
template <class E, class F, bool time, bool velocities, bool is_timed, int row_count>
struct Equation {
  using Element = E;
  using Function = F;
  static constexpr bool takes_time = time;
  static constexpr bool on_velocities = velocities;
  static constexpr int rows = row_count;
  static constexpr int inputs = PointFacts<E>::inputs;
  static constexpr int variables = inputs + (is_timed && !velocities ? 1 : 0);
  static constexpr int directions = directions_for(variables);
  static constexpr bool at_once = directions == variables;
};

template <int rows, class S, class G>
DALEMBERT_INLINE void write_rows(const G& g, S* out) {
  if constexpr (Column<G>) {
    for (int k = 0; k < rows; ++k) out[k] = S(g[k]);
  } else {
    *out = S(g);
  }
}

/// Number `lane` of those that an equation is differentiated with respect to; of others -1.
template <class S>
[[nodiscard]] DALEMBERT_INLINE S lifted(double value, int lane, [[maybe_unused]] const double* rates,
                                        [[maybe_unused]] int at) {
  if constexpr (S::along == 0) {
    return S::input(value, lane);
  } else if constexpr (S::along == 1) {
    return S::input(value, lane, rates[at]);
  } else {
    return S::input(value, lane, Pair{rates[2 * at], rates[2 * at + 1]});
  }
}
/// A velocity, which a Jet holds as it is.
template <class S>
[[nodiscard]] DALEMBERT_INLINE S lifted_velocity(const Pass& pass, int k, int lane) {
  if constexpr (S::along == 1) {
    return S::input(pass.v[k], lane);
  } else {
    return lifted<S>(pass.v[k], lane, pass.v_s, k);
  }
}

/// The next element, or for a HyperDual the next two directions.
template <class Q, class S>
DALEMBERT_INLINE void next(Pass& pass) {
  if constexpr (S::along < 2) {
    ++pass.i;
    pass.at += Q::inputs;
  } else {
    pass.x_s += 2 * Q::inputs;
    if constexpr (Q::on_velocities) pass.v_s += 2 * Q::inputs;
  }
}

/// (Flat: a user's lambda that stays a call at -O2 has its arguments in memory, which takes twice as long.)
template <class Q, class S>
[[gnu::flatten]] void run_pass(Pass& pass) {
  constexpr int n = Q::inputs;
  auto* out = static_cast<S*>(pass.out);
  for (; pass.count > 0; --pass.count, out += Q::rows, next<Q, S>(pass)) {
    const int* const at = pass.at;
    const auto& element = static_cast<const typename Q::Element*>(pass.elements)[pass.i];
    typename Q::Function f{element};
    const int first = Q::at_once ? 0 : pass.first;
    const double t_s[] = {pass.t_s, 0.0};
    const S t = lifted<S>(pass.t, Q::variables > n ? n - first : -1, t_s, 0);
    S r[n], v[Q::on_velocities ? n : 1];
    const auto lift = [&]<int... k>(std::integer_sequence<int, k...>) DALEMBERT_INLINE_LAMBDA {
      ((r[k] = lifted<S>(pass.x[at[k]], Q::on_velocities ? -1 : k - first, pass.x_s, at[k])), ...);
      if constexpr (Q::on_velocities) ((v[k] = lifted_velocity<S>(pass, at[k], k - first)), ...);
    };
    lift(std::make_integer_sequence<int, n>{});
    if constexpr (Q::on_velocities) {
      write_rows<Q::rows>(call_in_motion<Q::takes_time>(f, element, t, r, v), out);
    } else {
      write_rows<Q::rows>(call_at<Q::takes_time>(f, element, t, r), out);
    }
  }
}

/// With `biased` also for their bias, which energies have none of.
template <class Q, bool biased = true>
[[nodiscard]] constexpr EquationType equation_type_of(std::string_view singular) {
  constexpr int K = Q::directions;
  EquationType its{element_type_of<typename Q::Element>(),
                   Q::rows,
                   Q::variables,
                   K,
                   Q::on_velocities,
                   singular,
                   &run_pass<Q, Dual<K>>,
                   nullptr,
                   &run_pass<Q, HyperDual<K>>};
  if constexpr (biased) its.jets = &run_pass<Q, Jet<K>>;
  return its;
}

}  // namespace dalembert::detail
