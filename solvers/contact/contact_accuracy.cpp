#include "dalembert/solvers/contact/contact_accuracy.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

double ContactAccuracy::no_gap(const ContactState& contact, double rounding) const {
  return contact.gradient * rounding;
}

double ContactAccuracy::no_rate(const ContactState& contact) const {
  return 2.0 * round_off() * scales.speed() * contact.gradient;
}

double ContactAccuracy::still(const ContactState& contact) const {
  return start_tolerance * scales.speed() * contact.gradient;
}

double ContactAccuracy::no_acceleration(const ContactState& contact, double rounding) const {
  return no_gap(contact, rounding) / (duration * duration);
}

double ContactAccuracy::own_acceleration(const ContactState& contact) const {
  return scales.speed() / scales.time * contact.gradient;
}

double ContactAccuracy::error_of_gap(const ContactState& contact) const {
  return accuracy.of_positions() * scales.length * contact.gradient;
}

double ContactAccuracy::error_where_closed(const ContactState& contact, double rounding, double t,
                                           double rate) const {
  const double of_time = 8.0 * epsilon * std::abs(t * rate);
  return std::max(error_of_gap(contact), 2.0 * no_gap(contact, rounding)) + of_time;
}

}  // namespace dalembert
