#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/contact_state.h>
#include <dalembert/solvers/manifold/scales.h>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The distance to the nearest one-sided constraint that is open; infinite if there is none.
[[nodiscard]] double nearest_contact(const System& stated, const Instant& at);

/// The contacts of a run, all open, and the places of those whose gap is 0 at its start.
struct ContactsAtStart {
  std::vector<ContactState> contacts;
  std::vector<std::size_t> touching;
};
/// With the gaps of the start. Throws InconsistentStart where one is negative.
[[nodiscard]] ContactsAtStart find_contacts(const System& stated, const Scales& scales, const Instant& start,
                                            const Gaps& gaps);
/// Goes on with other equations, at an instant: what they couple, and how fast gaps grow, may differ.
void replace_equations(std::vector<ContactState>& contacts, const System& before, const System& stated,
                       const Scales& scales, const Instant& at);

}  // namespace dalembert
