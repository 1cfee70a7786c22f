#include "dalembert/solvers/contact/contact_accelerations.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/contact_law.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/complementarity.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace dalembert {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd ContactAccelerations::without_forces(Coupling& coupling, const std::vector<std::size_t>& touching) {
  for (const std::size_t i : touching) (*contacts_)[i].accepted = 0.0;
  const auto contact = [&](Index k) -> ContactState& {
    return (*contacts_)[touching[static_cast<std::size_t>(k)]];
  };
  VectorXd free = coupling.accelerations_without(at_);
  std::vector<Index> leaving;
  for (Index k = 0; k < free.size(); ++k) {
    const double none = round_off() * known_->own_acceleration(contact(k));
    if (std::abs(free[k]) <= none) {
      free[k] = 0.0;
      contact(k).accepted = none;
    }
    if (free[k] > 0.0) leaving.push_back(k);
  }
  if (leaving.empty()) return free;
  const Accuracy& accuracy = known_->accuracy;
  const double soon = accuracy.short_time() * known_->scales.time;
  const double known_to = constants.most_correction * accuracy.of_times() * known_->scales.time;
  std::vector<double> q(at_.q.begin(), at_.q.end());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += soon * at_.v[i];
  const VectorXd then = coupling.accelerations_without({at_.t + soon, q, at_.v});
  (void)coupling.accelerations_without(at_);  // it goes on from there
  for (const Index k : leaving) {
    if (!(then[k] < 0.0)) continue;
    const double until = soon * free[k] / (free[k] - then[k]);
    if (until <= known_to || free[k] <= accuracy.of_positions() * known_->own_acceleration(contact(k)))
      contact(k).accepted = std::exchange(free[k], 0.0);
  }
  return free;
}

std::vector<PairOfContact> ContactAccelerations::pairs(const Coupling& coupling,
                                                       const std::vector<std::size_t>& touching,
                                                       const Coupling::Places& resting,
                                                       const VectorXd& free) const {
  std::vector<PairOfContact> pairs(touching.size());
  for (const auto& island : coupling.islands()) {
    Coupling::Places own;
    std::ranges::set_intersection(island, resting, std::back_inserter(own));
    const VectorXd its = free(own);
    const Eigen::MatrixXd S = coupled(coupling, own, known_->scales, rounding_);
    const auto lambda = complementary_solution(S, its);
    if (!lambda)
      refuse(*stated_, *contacts_, those_at(island, touching), at_.t,
             "no accelerations satisfy all of them: other constraints drive them into each other");
    const VectorXd unit = units(S);
    const double largest = its.size() > 0 ? its.cwiseProduct(unit).cwiseAbs().maxCoeff() : 0.0;
    VectorXd A = its + S * *lambda;
    clear_round_off(A, unit, largest);
    for (Index k = 0; k < A.size(); ++k)
      pairs[static_cast<std::size_t>(own[static_cast<std::size_t>(k)])] = {A[k], (*lambda)[k], unit[k],
                                                                           largest};
  }
  return pairs;
}

void require_open_at_rest(const System& stated, std::span<const ContactState> contacts,
                          const ContactAccuracy& known, const Gaps& gaps, const FlatSample& now) {
  const Instant at{now.time, now.q, now.v};
  auto e = stated.evaluation();
  std::vector<double> gamma;
  for (const ContactState& c : contacts) {
    const double rate = gaps.rate(c);
    const bool rests = !c.closed && gaps.gap(c) <= known.no_gap(c, gaps.rounding()) &&
                       rate >= -known.still(c) && rate <= known.no_rate(c);
    if (!rests) continue;
    if (gamma.empty()) {
      gamma.resize(stated.rows());
      stated.evaluate_with_bias(at, e, gamma);
    }
    double acceleration = gamma[c.row], terms = std::abs(acceleration);
    for (const std::size_t k : stated.row(c.row)) {
      const std::size_t i = stated.w_columns()[k];
      acceleration += e.w[k] * now.a[i];
      terms += std::abs(e.w[k] * now.a[i]) + std::abs(e.w[k] * e.force[i] / stated.masses()[i]);
    }
    // Beside springs whose force is lost in round-off it is not known; nor, where all terms are 0, what
    // positions make of it that are known to the tolerance.
    const double none = known.accuracy.of_positions() * known.scales.speed() / known.scales.time * c.gradient;
    if (!(c.sign * acceleration < -known.accuracy.of_accelerations() * terms - none)) continue;
    throw StepFailure{
        stated.row_label(c.row) +
            " touches and would be penetrated: no forces of contact and friction were found that "
            "hold what rests there, or let it part; state fewer contacts, or make them compliant",
        now.time};
  }
}

}  // namespace dalembert
