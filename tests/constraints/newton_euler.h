#pragma once

#include <Eigen/Dense>

#include <functional>

/// What acts on a rigid body that moves in a known way, by Newton's and Euler's laws in extended precision.
/// No code of the library takes part.
namespace newton_euler {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

/// Second derivative and, with `first`, the first by central differences of order 8. With h = 0.01 and
/// motions of a few radians per time, both errors are far below 1e-12: h^8 f^(10)/3000 and 1e-19 * 6.5/h^2.
template <class F>
auto second_derivative(const F& f, Real t, Real h = 0.01L) {
  using T = decltype(f(t));
  return T((-205.0L / 72 * f(t) + 8.0L / 5 * (f(t + h) + f(t - h)) -
            1.0L / 5 * (f(t + 2 * h) + f(t - 2 * h)) + 8.0L / 315 * (f(t + 3 * h) + f(t - 3 * h)) -
            1.0L / 560 * (f(t + 4 * h) + f(t - 4 * h))) /
           (h * h));
}
template <class F>
auto first_derivative(const F& f, Real t, Real h = 0.01L) {
  using T = decltype(f(t));
  return T((4.0L / 5 * (f(t + h) - f(t - h)) - 1.0L / 5 * (f(t + 2 * h) - f(t - 2 * h)) +
            4.0L / 105 * (f(t + 3 * h) - f(t - 3 * h)) - 1.0L / 280 * (f(t + 4 * h) - f(t - 4 * h))) /
           h);
}

inline Matrix cross_matrix(const Vector& r) {
  Matrix m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}
inline Vector axial(const Matrix& m) {
  return Vector(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)) / 2;
}

/// Mass, inertia at orientation 1 about the centre, and the motion: place of the centre, rotation matrix.
struct Body {
  Real mass;
  Matrix inertia;
  std::function<Vector(Real)> centre;
  std::function<Matrix(Real)> rotation;

  /// The sum of forces and, about the centre, of torques that the motion takes:
  ///   m (r'' - g),   I alpha + omega x I omega,   R' R^T = omega x,  R'' R^T = alpha x + (omega x)^2.
  [[nodiscard]] Eigen::Matrix<Real, 6, 1> needed(Real t, const Vector& gravity) const {
    const Matrix R = rotation(t);
    const Vector omega = axial(first_derivative(rotation, t) * R.transpose());
    const Vector alpha = axial(second_derivative(rotation, t) * R.transpose());
    const Matrix I = R * inertia * R.transpose();
    Eigen::Matrix<Real, 6, 1> sum;
    sum << mass * (second_derivative(centre, t) - gravity), I * alpha + omega.cross(I * omega);
    return sum;
  }
};

/// A force (or a torque) of unknown size along a direction: one column of the equations of all bodies. Adds
/// what a unit of it does to body `i`, acting at a point with the centre at `centre`.
using Columns = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
inline void add_force(Columns& A, int body, int column, const Vector& direction, const Vector& arm) {
  A.block<3, 1>(6 * body, column) += direction;
  A.block<3, 1>(6 * body + 3, column) += arm.cross(direction);
}
inline void add_torque(Columns& A, int body, int column, const Vector& direction) {
  A.block<3, 1>(6 * body + 3, column) += direction;
}

}  // namespace newton_euler
