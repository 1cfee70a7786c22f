#include "dalembert/solvers/contact/contact_forces.h"

#include <dalembert/solvers/linear/rows.h>

#include <cmath>

namespace dalembert {

/// What constraints exert on each coordinate together, but for rods inside bodies; what compliant ones make
/// there of the rounding of positions; and the gradients.
void ContactForces::find(const System& in_force, const FlatSample& now, const Scales& scales) {
  if (time_ == now.time) return;
  time_ = now.time;
  in_force.evaluate({now.time, now.q, now.v}, e_);
  forces_.assign(now.a.size(), 0.0);
  noise_.assign(now.a.size(), 0.0);
  rounding_ = scales.rounding(now.q);
  const std::vector<double> lengths = scales.lengths();
  for (std::size_t r = 0; r < in_force.rows(); ++r) {
    if (!in_force.law(r).compliant() || !in_force.in_force(r)) continue;
    const double stretch = gradient_length(in_force, e_.w, lengths, r) * rounding_;
    for (const std::size_t k : in_force.row(r))
      noise_[in_force.w_columns()[k]] += std::abs(e_.w[k]) * stretch / in_force.law(r).compliance;
  }
  for (const Layout::Constraint& c : in_force.layout()->constraints) {
    if (c.internal) continue;
    std::size_t k = in_force.row(c.own_rows().front()).front();
    for (const std::size_t slot : c.slots()) {
      const double force = std::abs(now.forces[slot]);
      if (!std::isnan(force)) forces_[in_force.w_columns()[k]] += force;
      ++k;
    }
  }
}

double ContactForces::no_pull(const System& in_force, const ContactState& contact, const FlatSample& now,
                              const ContactAccuracy& known, double accepted) {
  find(in_force, now, known.scales);
  double net = 0.0, others = 0.0, inverse_mass = 0.0,
         noise = known.no_acceleration(contact, rounding_) + accepted;
  for (const std::size_t k : in_force.row(contact.row)) {
    const std::size_t i = in_force.w_columns()[k];
    const double w = e_.w[k], mass = in_force.masses()[i];
    if (!std::isnan(now.a[i])) net += w * now.a[i];
    others += std::abs(w) * (std::abs(e_.force[i]) + forces_[i]) / mass;
    noise += std::abs(w) * noise_[i] / mass;
    inverse_mass += w * w / mass;
  }
  if (!(inverse_mass > 0.0)) return 0.0;
  return (known.accuracy.of_positions() * (std::abs(net) + others) + noise) / inverse_mass;
}

}  // namespace dalembert
