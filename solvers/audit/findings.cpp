#include "dalembert/solvers/audit/findings.h"

#include <sstream>
#include <utility>

namespace dalembert {

std::string Subject::label(const System& system) const {
  if (kind == Kind::scene) return "scene \"" + system.layout()->scene + '"';
  if (kind == Kind::row) return system.row_label(index);
  return system.layout()->label_of_coordinate(static_cast<int>(index));
}

void Findings::add_violation(Law law, const Case& one) {
  if (std::exchange(violated_, true) && one.size * violation_.limit <= violation_.size * one.limit) return;
  law_ = law;
  violation_ = one;
}

Audit Findings::read(const System& system) const {
  Audit audit;
  for (std::size_t k = 0; k < number_of_laws; ++k) {
    const Case& one = worst_[k];
    if (one.size >= 0.0)
      audit.worst.push_back({static_cast<Law>(k), one.subject.label(system), one.time, one.size, one.limit});
  }
  return audit;
}

std::string Findings::message(const System& system) const {
  std::ostringstream what;
  what << "the result breaks a law of mechanics, " << name(law_) << ": " << violation_.subject.label(system)
       << " by " << violation_.size << " where " << violation_.limit
       << " is allowed; try a max_step (where a force varies faster than the motion), a tighter tolerance or "
          "the other stepper, or let the option audit = Audited::report show what follows";
  return what.str();
}

}  // namespace dalembert
