#include "dalembert/core/results/audit.h"

#include <algorithm>
#include <sstream>

namespace dalembert {

const char* name(Law law) {
  constexpr std::array<const char*, number_of_laws> names{"Newton's equations",
                                                          "position",
                                                          "velocity",
                                                          "acceleration",
                                                          "compliance",
                                                          "forces at points",
                                                          "energy",
                                                          "released",
                                                          "no penetration",
                                                          "no pull",
                                                          "no force at a distance",
                                                          "friction cone",
                                                          "sliding friction",
                                                          "impulse",
                                                          "carriers of impulses",
                                                          "restitution",
                                                          "energy of an impact",
                                                          "work"};
  return names[static_cast<std::size_t>(law)];
}

bool Audit::passed() const {
  return std::ranges::all_of(worst, [](const Finding& found) { return found.size <= found.limit; });
}

std::string Audit::report() const {
  std::ostringstream out;
  for (const Finding& found : worst) {
    out << name(found.law) << ": " << found.size << " of " << found.limit << " allowed, " << found.element
        << " at t = " << found.time << '\n';
  }
  return out.str();
}

}  // namespace dalembert
