#pragma once

#include <span>

/// From the numbers of the positions of points to the coordinates that these are made of, and back: compiled
/// once, whatever the sizes are, as each size costs a compiler more than it saves a processor.
namespace dalembert::detail {

/// How the numbers of the position of one point follow from its coordinates, r = L x; L by columns, none if
/// the coordinates are those numbers.
struct PointMap {
  static constexpr int most_inputs = 3;  // no position has more numbers

  const double* L;
  int inputs, coordinates;
};

/// The numbers of the positions out of coordinates x and their rates out of v; `places` of the coordinates
/// in these.
void gather_by(std::span<const PointMap> maps, const int* places, const double* x, const double* v,
               double* inputs, double* rates);

/// A gradient with respect to the positions as one with respect to the coordinates: out = L^T g, with L the
/// map of all points.
void pull_back_by(std::span<const PointMap> maps, const double* gradient, double* out);

/// A matrix of second derivatives likewise: out = L^T B L. B by columns, `out` by rows.
void pull_back_block_by(std::span<const PointMap> maps, const double* block, double* out);

/// What the multipliers of one constraint exert at the points it was stated for, whatever these are made
/// of. A row of W is w = u L, with u the gradient with respect to the positions of the points. So
///
///   u = w L^T (L L^T)^-1        for every point, and u_p^T lambda is the force at point p.       (1)
///
/// A rotor is a point with a torque; divided by its length, the scene's length, that is a force. Two points
/// that a rod pulls feel one force, which should count once: the rows u, together U, are shrunk,
///
///   U <- U max_p |u_p| / |U|        (Frobenius norms)                                            (2)
///
/// so that |U^T lambda| is the force at one point, the most loaded one if the others feel less. It is the
/// same by whatever equations and with whatever fixed points the constraint is stated; in whatever unit of
/// length, too, unless some of its rows are forces and others torques.
/// `w`, `U`: by rows; `coordinates`: the places in q of the constraint's own; `lengths`: of each place in q.
void forces_at_points(std::span<const PointMap> maps, int rows, const double* w,
                      std::span<const int> coordinates, std::span<const double> lengths, double* U);

}  // namespace dalembert::detail
