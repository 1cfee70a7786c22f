#pragma once

#include <dalembert/core/autodiff/not_of_std.h>

#include <concepts>
#include <tuple>
#include <type_traits>
#include <utility>

namespace dalembert {

/// One argument more than there are points is time, in front: what then goes wrong first is r_b - r_a.
#define DALEMBERT_NUMBER_AND_VECTOR                                                                \
  __attribute__((                                                                                  \
      unavailable("a number and a vector have no sum: a lambda that takes one argument more than " \
                  "its points (and their velocities) gets time in front of them")))
template <Differentiated A, class S, int D>
DALEMBERT_NUMBER_AND_VECTOR VecOf<S, D> operator-(const A&, const VecOf<S, D>&);
template <Differentiated A, class S, int D>
DALEMBERT_NUMBER_AND_VECTOR VecOf<S, D> operator-(const VecOf<S, D>&, const A&);
template <Differentiated A, class S, int D>
DALEMBERT_NUMBER_AND_VECTOR VecOf<S, D> operator+(const A&, const VecOf<S, D>&);
template <Differentiated A, class S, int D>
DALEMBERT_NUMBER_AND_VECTOR VecOf<S, D> operator+(const VecOf<S, D>&, const A&);
#undef DALEMBERT_NUMBER_AND_VECTOR

}  // namespace dalembert

/// What a user's equation may be and give, as concepts: so that the compiler answers a mistake with one
/// sentence, before the equation is called.
namespace dalembert::detail {

/// A function that names the types of its arguments cannot be called with numbers that carry derivatives.
template <class F>
concept NamesItsArguments = std::is_function_v<std::remove_pointer_t<F>> || requires {
  &F::operator();
};

/// One equation, or an energy.
template <class T>
concept Number = is_differentiated<T> ||(std::is_arithmetic_v<T> && !std::same_as<T, bool>);

/// Several equations or a force: of Eigen's, too, if they outlive their evaluation (an expression refers to
/// what is gone) and none can be overlooked (as in a row, or where only the running program knows how many).
template <class T>
concept Column = is_vector<T> ||(OfEigen<T>&& requires {
  requires std::same_as<typename T::PlainObject, T> && T::ColsAtCompileTime == 1 &&
      (T::RowsAtCompileTime > 0);
});

template <class T, int D>
concept ColumnOf = Column<T> &&(T::RowsAtCompileTime == D);

/// What a constraint may return.
template <class T>
concept Equations = Number<T> || Column<T>;

/// Whether a force law that returns a T gives point number I its force.
template <std::size_t I, class P, class T>
[[nodiscard]] consteval bool is_force_on() {
  if constexpr (P::inputs == 0) {
    return true;
  } else if constexpr (Column<T>) {
    return I == 0 && ColumnOf<T, P::inputs>;
  } else if constexpr (requires { requires(I < std::tuple_size<T>::value); }) {
    return ColumnOf<std::remove_cvref_t<std::tuple_element_t<I, T>>, P::inputs>;
  } else {
    return false;
  }
}

/// What a force law may return: a column for one point, a tuple or an array of columns for several.
template <class T, class Points, class Numbers = std::make_index_sequence<std::tuple_size_v<Points>>>
inline constexpr bool are_forces = false;
template <class T, class... P, std::size_t... I>
inline constexpr bool are_forces<T, std::tuple<P...>, std::index_sequence<I...>> = (true && ... &&
                                                                                    is_force_on<I, P, T>());

}  // namespace dalembert::detail
