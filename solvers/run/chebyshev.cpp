#include "dalembert/solvers/run/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dalembert {

double chebyshev_node(double from, double to, int j, int degree) {
  if (j == 0) return from;
  if (j == degree) return to;
  return 0.5 * (from + to) - 0.5 * (to - from) * std::cos(j * std::numbers::pi / degree);
}

std::vector<double> lagrange_polynomials(double from, double to, double t, int degree) {
  std::vector<double> l(static_cast<std::size_t>(degree) + 1);
  double sum = 0.0;
  for (int j = 0; j <= degree; ++j) {
    double& own = l[static_cast<std::size_t>(j)];
    const double distance = t - chebyshev_node(from, to, j, degree);
    if (distance == 0.0) {
      std::ranges::fill(l, 0.0);
      own = 1.0;
      return l;
    }
    own = (j % 2 == 0 ? 1.0 : -1.0) / distance;
    if (j == 0 || j == degree) own *= 0.5;
    sum += own;
  }
  for (double& own : l) own /= sum;
  return l;
}

}  // namespace dalembert
