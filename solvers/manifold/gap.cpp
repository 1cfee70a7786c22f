#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

Manifold::Gap Manifold::gap(const Instant& at, double length) {
  evaluate(at);
  if (!factorise()) return {};
  const Islands& islands = problem_.islands();
  weakest_.find(matrix_, rows_, e_.w, islands);
  const std::size_t island = weakest_.weakest_island(rows_, islands);
  const std::size_t n = at.q.size();

  // u of the rows as they are, its terms largest 1.
  std::vector<double> u(rows_.size());
  Gap gap;
  double most = 0.0, f = 0.0, rounding = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const std::size_t r = rows_.rows[k];
    if (islands.of_row(*system_, r) != island || system_->law(r).compliant()) continue;
    u[k] = weakest_.u()[k] / std::sqrt(inverse_effective_mass(*system_, e_.w, r));
    const double share = std::abs(u[k]) * gradient_length(*system_, e_.w, lengths_, r);
    if (share > most) {
      most = share;
      gap.row = r;
    }
  }
  if (most == 0.0) return {};
  for (double& x : u) x /= most;

  // n and the speed, each of largest entry 1.
  std::vector<double> direction(weakest_.n().begin(), weakest_.n().end()), moved(at.q.begin(), at.q.end());
  double longest = 0.0, speed = 0.0, farthest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (islands.of_coordinate[i] != island) direction[i] = 0.0;
    longest = std::max(longest, std::abs(direction[i]) * lengths_[i]);
    if (islands.of_coordinate[i] != island) continue;
    speed = std::max(speed, std::abs(at.v[i]) * lengths_[i]);
    farthest = std::max(farthest, std::abs(at.q[i]) * lengths_[i]);
  }
  if (longest == 0.0) return {};
  const double step = std::cbrt(epsilon) * length;
  for (std::size_t i = 0; i < n; ++i) moved[i] += step * (direction[i] /= longest);

  auto there = system_->evaluation();
  system_->evaluate({at.t, moved, at.v}, there);
  double b = 0.0, k = 0.0;
  for (std::size_t j = 0; j < u.size(); ++j) {
    const std::size_t r = rows_.rows[j];
    if (u[j] == 0.0) continue;
    if (j < rows_.holonomic) {
      f += u[j] * e_.g[r];
      rounding +=
          std::abs(u[j]) * epsilon * (farthest + length) * gradient_length(*system_, e_.w, lengths_, r);
    }
    b += u[j] * (there.psi[r] - e_.psi[r]) / step;
    for (const std::size_t i : system_->row(r))
      k += u[j] * (there.w[i] - e_.w[i]) / step * direction[system_->w_columns()[i]];
  }
  const double curvature = std::max(speed > 0.0 ? std::abs(b) / speed : 0.0, 0.5 * std::abs(k));
  if (curvature == 0.0) return {};
  gap.distance = std::sqrt(std::abs(f) / curvature);
  gap.rounding = std::sqrt(rounding / curvature);
  return gap;
}

}  // namespace dalembert
