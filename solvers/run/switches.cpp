#include "dalembert/solvers/run/switches.h"

#include <dalembert/core/errors.h>

#include <algorithm>
#include <utility>

namespace dalembert {

Switches::Switches(const System& system) : system_(&system) {
  const std::size_t entries = system.forces().friction_pattern().size();
  std::string label;
  for (std::size_t k = 0; k < entries; ++k) {
    const std::string own = system.forces().owner_of_friction(k);
    if (own == std::exchange(label, own)) continue;
    first_.push_back(k);
    if (k < system.forces().stated_friction_entries()) laws_ = first_.size();
  }
  first_.push_back(entries);
}

void Switches::make_room(Slope& slope) const { slope.reserve(system_->forces().friction_pattern().size()); }

void Switches::find(const Instant& at, std::span<const double> lambda, Slope& out) const {
  out.resize(system_->forces().friction_pattern().size());
  try {
    system_->forces().friction_slope(at, lambda, out);
  } catch (const EquationFault&) {  // where it reverses it may have no derivative
    out.clear();
  }
}

/// The inner product of a friction's slopes: negative if it turned. NaN-free: an unknown one counts as not
/// turned.
double Switches::turn(const Slope& a, const Slope& b, std::size_t friction) const {
  double product = 0.0;
  for (std::size_t k = first_[friction]; k < first_[friction + 1] && k < a.size() && k < b.size(); ++k)
    product += a[k] * b[k];
  return product;
}

bool Switches::returns(const Slope& a, const Slope& b, const Slope& c) const {
  if (a.empty() || b.empty() || c.empty()) return false;
  for (std::size_t i = 0; i < laws_; ++i)
    if (turn(a, b, i) < 0.0 && !(turn(a, c, i) > 0.0)) return false;
  return true;
}

bool Switches::slide_turned(const Slope& a, const Slope& b) const {
  for (std::size_t i = laws_; i + 1 < first_.size(); ++i)
    if (turn(a, b, i) < 0.0) return true;
  return false;
}

std::optional<std::size_t> Switches::turned(const Slope& a, const Slope& b) const {
  for (std::size_t i = 0; i < laws_; ++i)
    if (turn(a, b, i) < 0.0) return i;
  return std::nullopt;
}

bool Switches::rests(const Slope& a) const {
  for (std::size_t i = 0; i < laws_; ++i)
    if (turn(a, a, i) == 0.0) return true;
  return false;
}

}  // namespace dalembert
