#pragma once

#include <dalembert/core/equations/arguments.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace dalembert {

/// What the multipliers of one constraint exert at the points it was stated for, whatever these are made
/// of. A row of W is w = u L, with u the gradient with respect to the positions of the points and L the
/// constant map that gives these, r = L q. So
///
///   u = w L^T (L L^T)^-1        for every point, and u_p^T lambda is the force at point p.       (1)
///
/// A rotor is a point with a torque; divided by its length, the scene's length, that is a force. Two points
/// that a rod pulls feel one force, which should count once: the rows u, together U, are shrunk,
///
///   U <- U max_p |u_p| / |U|        (Frobenius norms)                                            (2)
///
/// so that |U^T lambda| is the force at one point, the most loaded one if the others feel less. It is the
/// same in whatever units, by whatever equations and with whatever fixed points the constraint is stated.
template <class Element, int rows>
struct ForcesAtPoints {
  static constexpr int width = PointFacts<Element>::coordinates;
  static constexpr int inputs = PointFacts<Element>::inputs;
  using Matrix = Eigen::Matrix<double, rows, inputs, inputs == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  using Given =
      Eigen::Map<const Eigen::Matrix<double, rows, width, width == 1 ? Eigen::ColMajor : Eigen::RowMajor>>;

  [[nodiscard]] static Matrix of(const Element& element, const Given& w, std::span<const int> coordinates,
                                 std::span<const double> lengths) {
    Matrix U;
    double largest = 0.0;
    int input = 0, column = 0;
    for_each_moving_point(element, [&]<class P>(const P& point) {
      auto own = U.template middleCols<P::inputs>(input);
      own = at_point(point, w.template middleCols<P::coordinates>(column));
      own /= lengths[static_cast<std::size_t>(coordinates[static_cast<std::size_t>(column)])];
      largest = std::max(largest, own.norm());
      input += P::inputs;
      column += P::coordinates;
    });
    if (largest > 0.0) U *= largest / U.norm();
    return U;
  }

 private:
  template <Point P>
  [[nodiscard]] static Eigen::Matrix<double, rows, P::inputs> at_point(const P& point, const auto& w) {
    if constexpr (P::inputs == P::coordinates) {
      return w;
    } else {
      const auto& L = point.map();
      return w * L.transpose() * (L * L.transpose()).inverse();
    }
  }
};

}  // namespace dalembert
