#pragma once

#include <Eigen/Core>

#include <type_traits>

namespace dalembert {

/// A column vector of D numbers of type S: what a constraint's equation computes with, S being
/// `double` or a Dual.
template <class S, int D>
using VecOf = Eigen::Matrix<S, D, 1>;

/// A position, velocity or force in D dimensions, in the user's own consistent units.
template <int D>
using Vec = VecOf<double, D>;

/// A vector from its components, whatever mixture of numbers and Duals they are:
/// `vec(0.1 * sin(10.0 * t), 0.0)`.
template <class... S>
[[nodiscard]] auto vec(const S&... component) {
  using T = std::common_type_t<S...>;
  return VecOf<T, static_cast<int>(sizeof...(S))>{T(component)...};
}

}  // namespace dalembert
