#include "dalembert/solvers/equilibrium/balance_equations.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

BalanceEquations::BalanceEquations(const Problem& problem, double time, RotatingFrame frame, Start start)
    : problem_(problem),
      time_(time),
      frame_(std::move(frame)),
      q0_(std::move(start.q)),
      lambda0_(std::move(start.lambda)),
      rows_(std::move(start.rows)),
      scales_(std::move(start.scales)) {
  State begin{q0_, std::vector<double>(q0_.size()), lambda0_};
  frame_.velocity(begin.q, begin.v);
  measure_stiffness(begin);
}

BalanceEquations::State BalanceEquations::start() const {
  State s{q0_, std::vector<double>(q0_.size()), lambda0_};
  evaluate(s);
  return s;
}

void BalanceEquations::share_by_particle(std::span<double> numbers) const {
  const Layout& layout = *system().layout();
  for (const auto& particle : layout.particles) {
    const auto own = numbers.subspan(static_cast<std::size_t>(particle.coordinate),
                                     static_cast<std::size_t>(layout.dimension));
    std::ranges::fill(own, *std::ranges::max_element(own));
  }
}

/// A particle is in balance if the residual is small against the forces on itself: a stiff spring elsewhere
/// holds nothing up.
void BalanceEquations::evaluate(State& s) const {
  frame_.velocity(s.q, s.v);
  auto e = system().evaluation();
  system().evaluate({time_, s.q, s.v}, e);
  std::vector<double> inertia(s.q.size()), acting(s.q.size());
  frame_.apply(s.v, inertia);
  s.force = std::move(e.force);
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    inertia[i] *= system().masses()[i];
    acting[i] = std::max({acting[i], std::abs(s.force[i]), std::abs(inertia[i])});
    s.force[i] -= inertia[i];
  }
  for (std::size_t r = 0; r < system().rows(); ++r) {
    for (const std::size_t k : system().row(r)) {
      const double Z = s.lambda[r] * e.w[k];
      double& here = acting[system().w_columns()[k]];
      here = std::max(here, std::abs(Z));
      s.force[system().w_columns()[k]] += Z;
    }
  }
  share_by_particle(acting);
  s.scale = largest(acting);
  s.round_off = true;
  for (std::size_t i = 0; i < least_force_.size(); ++i) {
    const double rounding = roundings_of_forces * epsilon * acting[i] + residual_tolerance * least_force_[i];
    s.round_off = s.round_off && std::abs(s.force[i]) <= rounding;
    acting[i] = std::max(acting[i], least_force_[i]);
  }
  s.acting = std::move(acting);
  s.distance = std::move(e.g);
  s.relative_violation = 0.0;
  const auto lengths = scales_.lengths();
  for (std::size_t r = 0; r < s.distance.size(); ++r) {
    s.distance[r] = system().law(r).residual(s.distance[r], s.lambda[r]);
    s.relative_violation =
        std::max(s.relative_violation,
                 std::abs(s.distance[r]) / gradient_length(system(), e.w, lengths, r) / scales_.length);
  }
  s.relative_residual = relative_residual(s, s.acting);
  s.round_off = s.round_off && s.relative_violation <= roundings_of_forces * epsilon;
}

double BalanceEquations::relative_residual(const State& s, std::span<const double> acting) {
  double unbalanced = 0.0;
  for (std::size_t i = 0; i < s.force.size(); ++i)
    if (s.force[i] != 0.0) unbalanced = std::max(unbalanced, std::abs(s.force[i]) / acting[i]);
  return std::max(unbalanced, s.relative_violation);
}

bool BalanceEquations::is_round_off_of_its_terms(const State& s) const {
  constexpr std::size_t most_looked_at = 100;
  std::size_t looked_at = 0;
  const Layout& layout = *system().layout();
  const auto small = [&](int coordinate, double mass, std::size_t width) {
    const auto first = static_cast<std::size_t>(coordinate);
    double unbalanced = 0.0, sum = 0.0;
    for (std::size_t i = first; i < first + width; ++i)
      unbalanced = std::max(unbalanced, std::abs(s.force[i]) / (roundings_of_forces * epsilon));
    if (unbalanced <= s.acting[first]) return true;
    if (++looked_at > most_looked_at) return false;
    std::vector<double> one(width);
    for (std::size_t f = 0; f < layout.forces.size(); ++f) {
      if (!layout.applied->on(f, {time_, s.q, s.v}, s.lambda, coordinate, mass, one)) return false;
      sum += largest(one);
    }
    return unbalanced <= sum;
  };
  return std::ranges::all_of(layout.particles,
                             [&](const auto& p) {
                               return small(p.coordinate, p.mass, static_cast<std::size_t>(layout.dimension));
                             }) &&
         std::ranges::all_of(layout.rotors, [&](const auto& r) { return small(r.coordinate, 0.0, 1); });
}

ActiveRows BalanceEquations::rows_at(const State& s) const {
  if (rows_.size() == system().rows()) return rows_;
  auto e = system().evaluation();
  system().evaluate({time_, s.q, s.v}, e);
  return independent_rows(system(), e.w);
}

/// From the stiffness at a state: shifts s that keep K + s M regular along free motions, where K is 0
/// (Newton's iteration then converges by this part of K a step), and for each coordinate the force that
/// counts as 0, made by a displacement of round-off.
///
/// Each coordinate has a shift of its own, a part of the stiffest spring on it, and where there is none of
/// the stiffest in its uncoupled part of the scene: what is soft is not held by what is stiff elsewhere. The
/// least that K's round-off allows serves where something is soft beside something stiff on the same
/// coordinate. Round-off of the rates of a motion that no force bends is neither a stiffness nor a force. Far
/// from the origin the forces have more round-off, and the shift is larger in proportion: what moves freely
/// is displaced by as little.
void BalanceEquations::measure_stiffness(const State& s) {
  const LinearTerms terms = linear_terms(system(), frame_, {time_, s.q, s.v}, s.lambda);
  const Islands& parts = problem_.islands();
  std::vector<double> own(s.q.size(), 0.0), of_part(parts.count, 0.0),
      rate(parts.count, roundings_of_a_sum * epsilon / scales_.time);
  least_force_.assign(s.q.size(), 0.0);
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    double& fastest = rate[parts.of_coordinate[i]];
    fastest = std::max(fastest, std::abs(s.v[i]) / scales_.unit(i));
  }
  for (const auto& entry : terms.stiffness) {
    const auto row = entry.row(), column = entry.col();
    const double size = std::abs(entry.value()) / system().masses()[row];
    own[row] = std::max(own[row], size);
    of_part[parts.of_coordinate[row]] = std::max(of_part[parts.of_coordinate[row]], size);
    const double rounding = 10.0 * epsilon * std::max(scales_.unit(column), std::abs(s.q[column]));
    least_force_[row] += std::abs(entry.value()) * rounding / residual_tolerance;
  }
  const double none = std::min(1.0, constants.no_stiffness * scales_.roundings_of_difference(s.q));
  stiffest_.resize(s.q.size());
  shift_.resize(s.q.size());
  least_shift_.resize(s.q.size());
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    const double part = of_part[parts.of_coordinate[i]], turning = rate[parts.of_coordinate[i]];
    const double rounding = 10.0 * epsilon * turning * turning;
    least_force_[i] += rounding * system().masses()[i] * scales_.unit(i) / residual_tolerance;
    stiffest_[i] = part > rounding ? part : 1.0 / (scales_.time * scales_.time);
    shift_[i] = none * (own[i] > rounding ? own[i] : stiffest_[i]);
    least_shift_[i] = roundings_of_forces * epsilon / constants.no_stiffness * shift_[i];
  }
  share_along_rows(terms.w);
}

/// Forces of round-off spread along constraints: the torque of a wheel that nothing turns is the round-off of
/// the force that its contact transmits.
void BalanceEquations::share_along_rows(std::span<const double> w) {
  const auto lengths = scales_.lengths();
  const auto share = [&](std::size_t r) {
    const double gradient = gradient_length(system(), w, lengths, r);
    double multiplier = 0.0;
    if (gradient == 0.0) return false;
    for (const std::size_t k : system().row(r)) {  // the part of each force along the row
      const std::size_t i = system().w_columns()[k];
      const double along = std::abs(w[k]) / lengths[i] / gradient;
      multiplier = std::max(multiplier, along * least_force_[i] / lengths[i] / gradient);
    }
    bool grew = false;
    for (const std::size_t k : system().row(r)) {
      double& here = least_force_[system().w_columns()[k]];
      grew = grew || std::abs(w[k]) * multiplier > here * (1.0 + epsilon);
      here = std::max(here, std::abs(w[k]) * multiplier);
    }
    return grew;
  };
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t r = 0; r < system().rows(); ++r) grows |= share(r);
    for (std::size_t r = system().rows(); r-- > 0;) grows |= share(r);
  }
}

}  // namespace dalembert
