#include "dalembert/solvers/contact/contact_accuracy.h"

#include <dalembert/solvers/contact/round_off.h>

namespace dalembert {

double ContactAccuracy::no_gap(const ContactState& contact, std::span<const double> q) const {
  return contact.gradient * scales.rounding(q);
}

double ContactAccuracy::no_rate(const ContactState& contact) const {
  return 2.0 * round_off() * scales.speed() * contact.gradient;
}

double ContactAccuracy::still(const ContactState& contact) const {
  return start_tolerance * scales.speed() * contact.gradient;
}

double ContactAccuracy::no_acceleration(const ContactState& contact, std::span<const double> q) const {
  return no_gap(contact, q) / (duration * duration);
}

double ContactAccuracy::own_acceleration(const ContactState& contact) const {
  return scales.speed() / scales.time * contact.gradient;
}

double ContactAccuracy::error_of_gap(const ContactState& contact) const {
  return accuracy.of_positions() * scales.length * contact.gradient;
}

}  // namespace dalembert
