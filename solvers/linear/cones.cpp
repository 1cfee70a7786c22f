#include "dalembert/solvers/linear/cones.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Cone = ConeProgram::Cone;

/// m falls to round-off by these factors; a centre needs some few Newton steps from the last one.
constexpr double last_m = 1e-14, falls_by = 0.1;
constexpr int most_steps = 40, most_halvings = 60;
/// Slacks that change by less than this part are those of the centre.
constexpr double centred = 1e-4;

/// s - |r|, which is positive inside.
double slack(const Cone& cone, const VectorXd& x) {
  return cone.e.dot(x) + cone.h - (cone.A * x + cone.a).norm();
}

/// The gradient of s^2 - |r|^2 over its value.
VectorXd relative_gradient(const Cone& cone, const VectorXd& x) {
  const double s = cone.e.dot(x) + cone.h;
  const VectorXd r = cone.A * x + cone.a;
  return 2.0 * (s * cone.e - cone.A.transpose() * r) / ((s - r.norm()) * (s + r.norm()));
}

VectorXd gradient(const ConeProgram& its, const VectorXd& x, double m) {
  VectorXd sum = its.Q * x + its.c;
  for (const Cone& cone : its.cones) sum -= m * cone.weight * relative_gradient(cone, x);
  return sum;
}

MatrixXd hessian(const ConeProgram& its, const VectorXd& x, double m) {
  MatrixXd sum = its.Q;
  for (const Cone& cone : its.cones) {
    const double s = cone.e.dot(x) + cone.h;
    const VectorXd r = cone.A * x + cone.a, p = relative_gradient(cone, x);
    const MatrixXd curvature = cone.A.transpose() * cone.A - cone.e * cone.e.transpose();
    sum += m * cone.weight * (p * p.transpose() + 2.0 / ((s - r.norm()) * (s + r.norm())) * curvature);
  }
  return sum;
}

/// Shortens dx until x + dx is inside, and not as far behind the lowest point on the way as x is before it.
bool shorten(const ConeProgram& its, const VectorXd& x, double m, const VectorXd& g, VectorXd& dx) {
  const double falls = std::abs(g.dot(dx));
  for (int i = 0; i < most_halvings; ++i, dx *= 0.5) {
    const VectorXd next = x + dx;
    const auto inside = [&](const Cone& cone) { return slack(cone, next) > 0.0; };
    if (!std::ranges::all_of(its.cones, inside)) continue;
    if (std::abs(gradient(its, next, m).dot(dx)) < falls) return true;
    if (i > 0 && next == x) return false;
  }
  return false;
}

/// x becomes the minimum of (2).
void centre(const ConeProgram& its, double m, VectorXd& x) {
  for (int step = 0; step < most_steps; ++step) {
    const VectorXd g = gradient(its, x, m);
    VectorXd dx = -hessian(its, x, m).ldlt().solve(g);
    if (!dx.allFinite() || !shorten(its, x, m, g, dx)) return;
    double change = 0.0;
    for (const Cone& cone : its.cones)
      change = std::max(change, std::abs(relative_gradient(cone, x).dot(dx)));
    x += dx;
    if (change <= centred) return;
  }
}

}  // namespace

VectorXd ConeProgram::minimum(VectorXd x) const {
  for (double m = 1.0; m >= last_m; m *= falls_by) centre(*this, m, x);
  return x;
}

}  // namespace dalembert
