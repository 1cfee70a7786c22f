#pragma once

#include <dalembert/core/equations/elements.h>

#include <string_view>
#include <utility>

/// What is compiled for each type of equation: its evaluation with the two numbers that carry derivatives,
/// and a table of facts. All else, from the state to the equation and from there to residuals, gradients and
/// blocks, is compiled once (differentiated.cpp).
namespace dalembert::detail {

/// What a pass evaluates an equation at, `count` times: for one element after another, or for one element
/// along one direction s after another. Input k has the value x[at[k]] and changes at the rate x_s[at[k]]
/// along s. Derivatives are taken in the directions of the inputs from number `first` on, as many as the
/// number has; behind the inputs comes time.
struct Pass {
  const void* elements;
  std::size_t i;  ///< the element that is at work
  int count;
  bool along_directions;  ///< x_s and v_s of the next evaluation follow, else its element and places `at`
  double t, t_s;
  const double *x, *x_s;
  const double *v = nullptr, *v_s = nullptr;  ///< velocities of the inputs, and their rates unless they are 0
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
  void (*jets)(Pass&);
  void (*duals)(Pass&);

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
  if constexpr (is_vector<G>) {
    for (int k = 0; k < rows; ++k) out[k] = S(g[k]);
  } else {
    *out = S(g);
  }
}

template <int inputs>
DALEMBERT_INLINE void next(Pass& pass) {
  if (pass.along_directions) {
    pass.x_s += inputs;
    if (pass.v_s != nullptr) pass.v_s += inputs;
  } else {
    ++pass.i;
    pass.at += inputs;
  }
}

/// (Flat: a user's lambda that stays a call at -O2 has its arguments in memory, which takes twice as long.)
template <class Q, class S>
[[gnu::flatten]] void run_pass(Pass& pass) {
  constexpr int n = Q::inputs;
  auto* out = static_cast<S*>(pass.out);
  for (; pass.count > 0; --pass.count, out += Q::rows, next<n>(pass)) {
    const int* const at = pass.at;
    const auto& element = static_cast<const typename Q::Element*>(pass.elements)[pass.i];
    typename Q::Function f{element};
    const int first = Q::at_once ? 0 : pass.first;
    S r[n];
    if constexpr (Q::on_velocities) {
      S v[n];
      const S t = S::input(pass.t, -1, pass.t_s);
      const auto lift = [&]<int... k>(std::integer_sequence<int, k...>) DALEMBERT_INLINE_LAMBDA {
        ((r[k] = S::input(pass.x[at[k]], -1, pass.x_s[at[k]])), ...);
        ((v[k] = S::input(pass.v[at[k]], k - first, pass.v_s == nullptr ? 0.0 : pass.v_s[at[k]])), ...);
      };
      lift(std::make_integer_sequence<int, n>{});
      write_rows<Q::rows>(call_in_motion<Q::takes_time>(f, element, t, r, v), out);
    } else {
      const S t = S::input(pass.t, Q::variables > n ? n - first : -1, pass.t_s);
      const auto lift = [&]<int... k>(std::integer_sequence<int, k...>) DALEMBERT_INLINE_LAMBDA {
        ((r[k] = S::input(pass.x[at[k]], k - first, pass.x_s[at[k]])), ...);
      };
      lift(std::make_integer_sequence<int, n>{});
      write_rows<Q::rows>(call_at<Q::takes_time>(f, element, t, r), out);
    }
  }
}

template <class Q>
[[nodiscard]] constexpr EquationType equation_type_of(std::string_view singular) {
  return {element_type_of<typename Q::Element>(),
          Q::rows,
          Q::variables,
          Q::directions,
          Q::on_velocities,
          singular,
          &run_pass<Q, Jet<Q::directions>>,
          &run_pass<Q, HyperDual<Q::directions>>};
}

}  // namespace dalembert::detail
