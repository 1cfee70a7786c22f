#include "dalembert/solvers/equilibrium/floquet.h"

#include <dalembert/solvers/equilibrium/disturbances.h>
#include <dalembert/solvers/integrator.h>
#include <dalembert/solvers/linear/dense.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Of the periodic motion, and of the monodromy matrix.
constexpr double tolerance = 1e-12, known = 1e-11;
/// A deviation after a period that is more than the error of the steps.
constexpr double returned = 1e-6;
constexpr int fewest_steps = 16, most_steps = 8192;

void require_period(const System& system, double period) {
  if (!(std::isfinite(period) && period > 0.0)) {
    std::ostringstream what;
    what << "Floquet multipliers of scene \"" << system.layout()->scene << "\": period = " << period
         << ", must be finite and > 0";
    throw InvalidArgument(what.str());
  }
  if (const auto label = system.conditional_label(); !label.empty())
    throw InvalidScene("Floquet multipliers: " + label +
                       " does not always hold; they are defined for scenes without such constraints");
  if (system.frictional())
    throw InvalidScene("Floquet multipliers: " + system.force_of_friction(0) +
                       " reads a multiplier; they are defined for scenes without such forces");
}

/// The nodes of this many steps of a period, and its ends.
std::vector<double> node_times(double period, int steps) {
  std::vector<double> times{0.0};
  for (int k = 0; k < steps; ++k) {
    for (const double c : radau_nodes()) times.push_back(period * (k + c) / steps);
  }
  times.back() = period;
  return times;
}

/// Throws unless the motion ends as it began; wheels may have turned round.
void require_return(const Record& motion) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  const FlatSample first = motion.sample(0), last = motion.sample(motion.times.size() - 1);
  const auto compare = [&](std::span<const double> a, std::span<const double> b, double scale,
                           const char* what) {
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i]));
    if (off <= returned * scale) return;
    std::ostringstream text;
    text << "Scene \"" << motion.layout->scene << "\" is not periodic: after " << last.time << ' ' << what
         << " differ by " << off << "; begin on the periodic motion, and give its whole period";
    throw NoEquilibrium(text.str());
  };
  double force = 0.0;
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    for (const double l : motion.sample(i).lambda) force = std::max(force, std::abs(l));
  }
  const double length = motion.statistics.length, time = motion.statistics.time;
  // An angle of 1 counts as the scene's length.
  std::vector<double> q(last.q.begin(), last.q.end()), v(last.v.begin(), last.v.end());
  for (const auto& rotor : motion.layout->rotors) {
    const auto i = static_cast<std::size_t>(rotor.coordinate);
    q[i] = first.q[i] + length * std::remainder(q[i] - first.q[i], full_turn);
    v[i] = first.v[i] + length * (v[i] - first.v[i]);
  }
  compare(first.q, q, length, "positions");
  compare(first.v, v, length / std::min(time, last.time), "velocities");
  compare(first.lambda, last.lambda, force, "multipliers");
}

/// Throws unless forces and constraints respond to a disturbance at the end of the period as at its start.
void require_same_forces(const System& system, const Disturbances& first, const Disturbances& last,
                         double period) {
  // In units of the period what is smaller than 1 has no effect within it.
  const auto differ = [](const MatrixXd& a, const MatrixXd& b) {
    return (a - b).norm() > returned * std::max({a.norm(), b.norm(), 1.0});
  };
  if (!differ(first.K, last.K) && !differ(first.C, last.C) && !differ(first.W, last.W)) return;
  std::ostringstream what;
  what << "Scene \"" << system.layout()->scene << "\": its forces or constraints differ after " << period
       << ", so that is not their period; give their whole period";
  throw NoEquilibrium(what.str());
}

/// The monodromy matrix, in a basis of the disturbances that the constraints allow.
MatrixXd monodromy(const System& system, const Record& motion, double period) {
  const FlatSample start = motion.sample(0);
  auto e = system.evaluation();
  system.evaluate({start.time, start.q, start.v}, e);
  const ActiveRows rows = independent_rows(system, e.w);
  const Disturbances first(system, rows, start, period),
      last(system, rows, motion.sample(motion.times.size() - 1), period);
  require_same_forces(system, first, last, period);
  const MatrixXd basis = first.basis();
  const std::size_t steps = (motion.times.size() - 1) / 3;
  if (basis.cols() == 0) return {};  // nothing can move
  MatrixXd x = basis;
  for (std::size_t k = 0; k < steps; ++k) {
    std::vector<Disturbances> nodes;
    for (std::size_t i = 1; i <= 3; ++i) nodes.emplace_back(system, rows, motion.sample(3 * k + i), period);
    x = radau_step(nodes, 1.0 / static_cast<double>(steps), x);
  }
  return basis.transpose() * x;
}

}  // namespace

Stability Floquet::stability() const {
  const double rounding = std::sqrt(known);  // a double multiplier is known to the square root
  if (growth() > 1.0 + rounding) return Stability::unstable;
  return growth() < 1.0 - rounding ? Stability::stable : Stability::undecided;
}

Floquet find_multipliers(const std::function<System()>& system, std::span<const double> q,
                         std::span<const double> v, double period) {
  require_period(system(), period);
  MatrixXd map;
  for (int steps = fewest_steps;; steps *= 2) {
    Integrator integrator(system(), q, v,
                          {.t_end = period,
                           .times = node_times(period, steps),
                           .tolerance = tolerance,
                           .stepper = Stepper::erk});
    const auto motion = integrator.run();
    require_return(*motion);
    const MatrixXd before = std::exchange(map, monodromy(integrator.system(), *motion, period));
    // Halved steps of order 5 err by a 31st of the change.
    const bool settled =
        before.size() == map.size() && (map - before).norm() <= 31.0 * known * (1.0 + map.norm());
    if (!settled && steps < most_steps) continue;
    if (!settled)
      throw NoEquilibrium("Floquet multipliers of scene \"" + motion->layout->scene +
                          "\" do not converge: its motion is not smooth, or the period too long");
    if (map.size() == 0) return {{}, steps};
    const Eigen::VectorXcd all = dense::eigenvalues(map);
    Floquet found{{all.data(), all.data() + all.size()}, steps};
    std::ranges::stable_sort(found.multipliers, std::greater{}, [](auto m) { return std::abs(m); });
    return found;
  }
}

}  // namespace dalembert
