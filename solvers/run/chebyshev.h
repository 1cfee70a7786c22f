#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The j-th extremum of the Chebyshev polynomial of this degree over a step; its ends are the first and the
/// last.
[[nodiscard]] double chebyshev_node(double from, double to, int j, int degree);

/// Lagrange's polynomials of these nodes at t, in barycentric form, whose error is a few roundings (Berrut,
/// Trefethen, SIAM Review 46 (2004) 501).
[[nodiscard]] std::vector<double> lagrange_polynomials(double from, double to, double t, int degree);

}  // namespace dalembert
