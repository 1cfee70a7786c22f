#include "dalembert/solvers/equilibrium/static_length.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/manifold/scales.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

/// F - M A v of what rests in the frame, as a function of its displacements.
class RestForces {
 public:
  RestForces(const System& system, const RotatingFrame& frame, double time, std::span<const double> q)
      : system_(system),
        frame_(frame),
        time_(time),
        q_(q.begin(), q.end()),
        v_(q.size()),
        inertia_(q.size()),
        e_(system.evaluation()) {}

  /// With coordinate i displaced by h. Throws EquationFault.
  std::span<const double> at(std::size_t i, double h) {
    const double before = std::exchange(q_[i], q_[i] + h);
    frame_.velocity(q_, v_);
    system_.evaluate({time_, q_, v_}, e_);
    frame_.apply(v_, inertia_);
    q_[i] = before;
    for (std::size_t k = 0; k < inertia_.size(); ++k) e_.force[k] -= system_.masses()[k] * inertia_[k];
    return e_.force;
  }

 private:
  const System& system_;
  const RotatingFrame& frame_;
  double time_;
  std::vector<double> q_, v_, inertia_;
  System::Evaluation e_;
};

/// Whether a displacement of coordinate i by h changes the forces f as the column `stiffness` says, to half.
bool is_linear(RestForces& forces, std::span<const double> f, std::span<const double> stiffness,
               std::size_t i, double h) {
  try {
    const auto there = forces.at(i, h);
    double off = 0.0;
    for (std::size_t k = 0; k < f.size(); ++k) {
      const double difference = there[k] - f[k] + h * stiffness[k];
      if (!std::isfinite(difference)) return false;
      off = std::max(off, std::abs(difference));
    }
    return off < 0.5 * std::abs(h) * largest(stiffness);
  } catch (const EquationFault&) {
    return false;
  }
}

}  // namespace

double static_length(const System& system, const RotatingFrame& frame, double time, std::span<const double> q,
                     std::span<const double> lambda) {
  constexpr double farthest = 1.0 / Scales::least;
  RestForces forces(system, frame, time, q);
  const auto now = forces.at(0, 0.0);
  const std::vector<double> f(now.begin(), now.end());
  std::vector<double> v(q.size());
  frame.velocity(q, v);
  std::vector<std::vector<double>> stiffness(q.size(), std::vector<double>(q.size()));  // by columns
  for (const auto& entry : linear_terms(system, frame, {time, q, v}, lambda).stiffness)
    stiffness[entry.col()][entry.row()] += entry.value();

  double least = std::numeric_limits<double>::infinity(), to_balance = largest(q);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double k = largest(stiffness[i]);
    if (system.angles()[i] || k == 0.0) continue;
    to_balance = std::max(to_balance, std::abs(f[i]) / k);
    // Below, round-off of the forces is more than half of what the stiffness says.
    const double nearest =
        std::max({Scales::least, 1e3 * epsilon * std::abs(q[i]), 1e3 * epsilon * largest(f) / k});
    double h = farthest;
    while (h > nearest &&
           !(is_linear(forces, f, stiffness[i], i, h) && is_linear(forces, f, stiffness[i], i, -h)))
      h *= 0.5;
    if (h > nearest && h < farthest) least = std::min(least, h);
  }
  if (std::isfinite(least)) return least;
  return to_balance > Scales::least && to_balance < farthest ? to_balance : 1.0;
}

}  // namespace dalembert
