#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

namespace detail {

/// Makes `energy` or `force` of an element callable like a function, without hiding its arity.
template <class E>
struct EnergyOf {
  const E& element;
  auto operator()(const auto&... a) const requires requires { element.energy(a...); }
  { return element.energy(a...); }
};
template <class E>
struct ForceOf {
  const E& element;
  auto operator()(const auto&... a) const requires requires { element.force(a...); }
  { return element.force(a...); }
};

/// The force on point I out of what a force law returned: a vector for one point, a tuple or array
/// of vectors for several.
template <std::size_t I, class T>
[[nodiscard]] const auto& force_on(const T& forces) {
  if constexpr (Column<T>) {
    return forces;
  } else {
    return std::get<I>(forces);
  }
}

/// What a force law returned, as the force on each input of the element.
template <class E, class S, class Law>
DALEMBERT_INLINE void write_forces(const Law& law, S* out) {
  const auto write = [&]<std::size_t I, class P>(std::type_identity<P>) DALEMBERT_INLINE_LAMBDA {
    if constexpr (P::inputs > 0) {
      const auto& own = force_on<I>(law);
      for (int k = 0; k < P::inputs; ++k) out[PointFacts<E>::first_input[I] + k] = S(own[k]);
    }
  };
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) DALEMBERT_INLINE_LAMBDA {
    (write.template operator()<I>(std::type_identity<std::tuple_element_t<I, PointTuple<E>>>{}), ...);
  };
  each(std::make_index_sequence<PointFacts<E>::count>{});
}

}  // namespace detail

/// A force with a potential: `points()` and `energy([t,] r_1, ..., r_k)`, for any scalar type.
/// Force and stiffness follow: F_i = -dV/dr_i.
template <class E>
concept PotentialForce = ActsOnPoints<E> &&
    (detail::applicable<detail::EnergyOf<E>, detail::ProbePositions<E>> ||
     detail::applicable_with_time<detail::EnergyOf<E>, detail::Probe<E>, detail::ProbePositions<E>>);

/// A force given by its law: `points()` and `force([t,] r_1, ..., r_k, v_1, ..., v_k)`, which
/// returns the force on each point: a vector for a single point, else a std::tuple of vectors.
template <class E>
concept LawForce = ActsOnPoints<E> &&
    (detail::applicable<detail::ForceOf<E>, detail::ProbeMotion<E>> ||
     detail::applicable_with_time<detail::ForceOf<E>, detail::Probe<E>, detail::ProbeMotion<E>>);

}  // namespace dalembert
