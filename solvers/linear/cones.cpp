#include "dalembert/solvers/linear/cones.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

/// r and s of a cone at x, and how they change along a step.
struct InCone {
  VectorXd r, along_r;
  double s = 0.0, along_s = 0.0;

  [[nodiscard]] VectorXd r_at(double part) const { return r + part * along_r; }
  [[nodiscard]] double s_at(double part) const { return s + part * along_s; }
  /// s - |r|, which is positive inside.
  [[nodiscard]] double slack(double part) const { return s_at(part) - r_at(part).norm(); }
  /// Of log(s^2 - |r|^2) along the step.
  [[nodiscard]] double slope(double part) const {
    const VectorXd R = r_at(part);
    const double S = s_at(part), size = R.norm();
    return 2.0 * (S * along_s - R.dot(along_r)) / ((S - size) * (S + size));
  }
};

/// Newton's method for (2).
class Centre {
 public:
  Centre(const ConeProgram& program, VectorXd x)
      : its_(program), x_(std::move(x)), places_(program.cones.size()) {
    for (const Cone& cone : its_.cones)
      curvatures_.emplace_back(cone.A.transpose() * cone.A - cone.e * cone.e.transpose());
  }

  void find(double m) {
    for (int step = 0; step < most_steps; ++step) {
      find_gradient_and_hessian(m);
      const VectorXd dx = -hessian_.ldlt().solve(gradient_);
      if (!dx.allFinite()) return;
      go_along(dx);
      const double part = inside(dx, m);
      if (part == 0.0) return;
      double change = 0.0;
      for (const InCone& place : places_) change = std::max(change, part * std::abs(place.slope(0.0)));
      x_ += part * dx;
      if (change <= centred) return;
    }
  }
  [[nodiscard]] const VectorXd& x() const { return x_; }

 private:
  void find_gradient_and_hessian(double m) {
    gradient_ = its_.Q * x_ + its_.c;
    hessian_ = its_.Q;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Cone& cone = its_.cones[i];
      InCone& place = places_[i];
      place.r = cone.A * x_ + cone.a;
      place.s = cone.e.dot(x_) + cone.h;
      const double size = place.r.norm(), both = 2.0 / ((place.s - size) * (place.s + size));
      const VectorXd p = both * (place.s * cone.e - cone.A.transpose() * place.r);  // of log(s^2 - |r|^2)
      gradient_ -= m * cone.weight * p;
      hessian_ += m * cone.weight * (p * p.transpose() + both * curvatures_[i]);
    }
  }
  void go_along(const VectorXd& dx) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      places_[i].along_r = its_.cones[i].A * dx;
      places_[i].along_s = its_.cones[i].e.dot(dx);
    }
  }
  /// The part of dx for which x + dx is inside, and not as far behind the lowest point on the way as x is
  /// before it; 0 if there is none.
  [[nodiscard]] double inside(const VectorXd& dx, double m) const {
    const double falls = std::abs(gradient_.dot(dx)), linear = (its_.Q * x_ + its_.c).dot(dx),
                 quadratic = dx.dot(its_.Q * dx);
    double part = 1.0;
    for (int i = 0; i < most_halvings; ++i, part *= 0.5) {
      if (std::ranges::any_of(places_, [&](const InCone& p) { return !(p.slack(part) > 0.0); })) continue;
      double slope = linear + part * quadratic;
      for (std::size_t k = 0; k < places_.size(); ++k)
        slope -= m * its_.cones[k].weight * places_[k].slope(part);
      if (std::abs(slope) < falls) return part;
      if (i > 0 && x_ + part * dx == x_) return 0.0;
    }
    return 0.0;
  }

  const ConeProgram& its_;
  VectorXd x_, gradient_;
  MatrixXd hessian_;
  std::vector<MatrixXd> curvatures_;  // of r^2 - s^2
  std::vector<InCone> places_;
};

}  // namespace

VectorXd ConeProgram::minimum(VectorXd x) const {
  Centre centre(*this, std::move(x));
  for (double m = 1.0; m >= last_m; m *= falls_by) centre.find(m);
  return centre.x();
}

}  // namespace dalembert
