#include "dalembert/solvers/contact/coming_to_rest.h"

#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// w of (1).
Vector2d slip_rate(const SlipCoupling& its, double mu, const Vector2d& d) {
  const double strength = std::copysign(mu, its.N_0[0]);
  const double normal = its.N_0[0] / (1.0 + strength * its.B.row(0).dot(d));
  return its.c - strength * normal * its.S * d;
}

/// (2) of (log rho, theta, t).
Vector3d rates(const SlipCoupling& its, double mu, const Vector3d& x) {
  const Vector2d d(std::cos(x[1]), std::sin(x[1])), w = slip_rate(its, mu, d);
  return {w.dot(d), d[0] * w[1] - d[1] * w[0], std::exp(x[0])};
}

}  // namespace

std::optional<double> time_to_rest(const SlipCoupling& its, double mu, const Vector2d& u, double least) {
  constexpr double step = 0.05;  // in which log rho or theta change by as much: errors of 1e-7
  constexpr int most_steps = 20000;
  const double fastest = its.c.norm() + mu * std::abs(its.N_0[0]) * its.S.norm();
  if (fastest == 0.0) return std::nullopt;
  const double longest = 1.0 / fastest;  // what decays is stable then
  const double doubled = std::log(2.0 * u.norm()), ended = std::log(least);
  Vector3d x(std::log(u.norm()), std::atan2(u[1], u[0]), 0.0);
  for (int i = 0; i < most_steps; ++i) {
    const Vector3d k1 = rates(its, mu, x);
    const double turning = std::abs(k1[1]), h = std::min(longest, step / std::hypot(k1[0], turning));
    if (x[0] <= ended || (k1[0] < 0.0 && turning <= epsilon * fastest))
      return x[2] - (k1[0] < 0.0 ? k1[2] / k1[0] : 0.0);  // what is left is straight
    const Vector3d k2 = rates(its, mu, x + 0.5 * h * k1), k3 = rates(its, mu, x + 0.5 * h * k2),
                   k4 = rates(its, mu, x + h * k3);
    x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    if (!(x[0] < doubled)) return std::nullopt;
  }
  return std::nullopt;
}

double time_to_rest_ahead(const SlipCoupling& its, double mu, const Vector2d& u) {
  const double falls = -slip_rate(its, mu, u.normalized()).dot(u.normalized());
  return falls > 0.0 ? u.norm() / falls : std::numeric_limits<double>::infinity();
}

}  // namespace dalembert
