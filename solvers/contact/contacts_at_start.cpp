#include "dalembert/solvers/contact/contacts_at_start.h"

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dalembert {

namespace {

/// The length of each contact's gradient, coordinates in these units; 0 where it has none, as for a string of
/// length 0.
std::vector<double> contact_gradients(const System& stated, const Instant& at,
                                      std::span<const double> lengths) {
  const std::vector<std::size_t> contacts = stated.conditions().contacts();
  const auto of = [&](const System& system, std::size_t number, const System::Evaluation& e) {
    return gradient_length(system, e.w, lengths, stated.layout()->constraints[number].own_rows().front());
  };
  const System together = stated.without(stated.conditions().frictional_constraints());
  auto e = together.evaluation();
  std::vector<double> all;
  try {
    together.evaluate(at, e);
    for (const std::size_t number : contacts) all.push_back(of(together, number, e));
    return all;
  } catch (const EquationFault&) {  // of one of them
  }
  for (const std::size_t number : contacts) {
    std::vector<std::size_t> others = stated.conditions().conditional_constraints();
    std::erase(others, number);
    const System alone = stated.without(others);
    try {
      alone.evaluate(at, e);
      all.push_back(of(alone, number, e));
    } catch (const EquationFault&) {
      all.push_back(0.0);
    }
  }
  return all;
}

}  // namespace

double nearest_contact(const System& stated, const Instant& at) {
  std::vector<double> g(stated.rows()), rates(stated.rows());
  stated.gaps(at, g, rates);
  const std::vector<double> ones(stated.coordinates(), 1.0);
  double farthest = 0.0;
  for (const double x : at.q) farthest = std::max(farthest, std::abs(x));
  double nearest = std::numeric_limits<double>::infinity();
  const std::vector<std::size_t> contacts = stated.conditions().contacts();
  const auto lengths_of_gradients = contact_gradients(stated, at, ones);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double gradient = lengths_of_gradients[i];
    const double gap = std::abs(g[stated.layout()->constraints[contacts[i]].own_rows().front()]);
    if (gap > round_off() * farthest * gradient) nearest = std::min(nearest, gap / gradient);
  }
  return nearest;
}

ContactsAtStart find_contacts(const System& stated, const Scales& scales, const Instant& start,
                              const Gaps& gaps) {
  const Islands all = islands(stated);
  const auto gradients = contact_gradients(stated, start, scales.lengths());
  ContactsAtStart found;
  for (const std::size_t number : stated.conditions().contacts()) {
    const Contact& law = *stated.conditions().of[number].contact;
    const std::size_t i = found.contacts.size(),
                      row = stated.layout()->constraints[number].own_rows().front();
    const ContactState& c = found.contacts.emplace_back(ContactState{.number = number,
                                                                     .row = row,
                                                                     .sign = law.sign(),
                                                                     .restitution = law.restitution,
                                                                     .island = all.of_row(stated, row),
                                                                     .gradient = gradients[i]});
    // Positions are known to their rounding and to that of the time: a sample of an impact is a start.
    const double gap = gaps.gap(c),
                 rounding = c.gradient * gaps.rounding() + round_off() * std::abs(start.t * gaps.rate(c));
    const double allowed = std::max(start_tolerance * scales.length * c.gradient, rounding);
    if (std::abs(gap) <= allowed) found.touching.push_back(i);
    if (gap >= -allowed) continue;
    std::ostringstream what;
    what << stated.row_label(row) << " is violated by the initial positions: by a distance of "
         << -gap / c.gradient << " on the forbidden side at t = " << start.t << "; correct the positions";
    throw InconsistentStart(what.str());
  }
  return found;
}

void replace_equations(std::vector<ContactState>& contacts, const System& before, const System& stated,
                       const Scales& scales, const Instant& at) {
  const Islands all = islands(stated);
  const auto old_gradients = contact_gradients(before, at, scales.lengths()),
             gradients = contact_gradients(stated, at, scales.lengths());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ContactState& c = contacts[i];
    c.island = all.of_row(stated, c.row);
    // Both of one place: a gap that is no distance keeps its unit, wherever the change finds it.
    if (old_gradients[i] > 0.0 && gradients[i] > 0.0) c.gradient *= gradients[i] / old_gradients[i];
  }
}

}  // namespace dalembert
