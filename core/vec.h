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

/// A moment or a turning: in the plane a number, counter-clockwise; in space a vector.
template <int D>
using MomentOf = std::conditional_t<D == 2, double, Vec<3>>;

namespace detail {
/// r x F.
[[nodiscard]] inline double moment(const Vec<2>& r, const Vec<2>& F) { return r.x() * F.y() - r.y() * F.x(); }
[[nodiscard]] inline Vec<3> moment(const Vec<3>& r, const Vec<3>& F) {
  return {r.y() * F.z() - r.z() * F.y(), r.z() * F.x() - r.x() * F.z(), r.x() * F.y() - r.y() * F.x()};
}
}  // namespace detail

}  // namespace dalembert
