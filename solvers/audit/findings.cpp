#include "dalembert/solvers/audit/findings.h"

namespace dalembert {

std::string Subject::label(const System& system) const {
  if (kind == Kind::scene) return "scene \"" + system.layout()->scene + '"';
  if (kind == Kind::row) return system.row_label(index);
  const auto coordinate = static_cast<int>(index);
  if (const auto* particle = system.layout()->particle_at(coordinate))
    return "particle \"" + particle->name + "\" along " + "xyz"[coordinate - particle->coordinate];
  for (const auto& rotor : system.layout()->rotors)
    if (rotor.coordinate == coordinate) return "rotor \"" + rotor.name + '"';
  return "coordinate " + std::to_string(index);
}

void Findings::add(const Findings& others) {
  for (std::size_t k = 0; k < number_of_laws; ++k) {
    const Case& one = others.worst_[k];
    if (one.size >= 0.0) weigh(static_cast<Law>(k), one.subject, one.time, one.size, one.limit);
  }
}

const Findings::Case* Findings::violated(Law& law) const {
  const Case* worst = nullptr;
  for (std::size_t k = 0; k < number_of_laws; ++k) {
    const Case& one = worst_[k];
    if (one.size <= one.limit || (worst && one.size * worst->limit <= worst->size * one.limit)) continue;
    worst = &one;
    law = static_cast<Law>(k);
  }
  return worst;
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

}  // namespace dalembert
