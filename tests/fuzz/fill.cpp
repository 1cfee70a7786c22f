#include "draft.h"

namespace dalembert::fuzz {

namespace {

template <int D>
void add_constraint(Draft<D>& draft) {
  const double kind = draft.random.uniform();
  if (kind < 0.32) return add_rod(draft);
  if (kind < 0.4) return add_pin(draft);
  if (kind < 0.5) return add_own_holonomic(draft);
  if (kind < 0.6) return add_own_nonholonomic(draft);
  if (kind < 0.65) return add_prescribed(draft);
  if constexpr (D == 2) {
    return kind < 0.8 ? add_on_curve(draft) : add_rolling(draft);
  } else {
    if (kind < 0.85) return add_on_surface(draft);
    return kind < 0.95 ? add_disk(draft) : add_thin_rod(draft);
  }
}

template <int D>
void add_any_force(Draft<D>& draft) {
  const double kind = draft.random.uniform();
  if (kind < 0.4) return add_force(draft);
  return kind < 0.8 ? add_field(draft) : add_own_force(draft);
}

/// At least one constraint of them is one-sided, or rough.
template <int D>
void fill_one_sided(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  for (int i = 0; i < plan.particles; ++i) draft.add_particle();
  for (int i = 0; i < plan.constraints; ++i) add_rod(draft);
  for (int i = 0; i < plan.forces; ++i) add_passive_force(draft);
  const bool rough = plan.family == Family::rough;
  for (int i = 1 + draft.random.below(4); i > 0; --i) rough ? add_rough(draft) : add_one_sided(draft);
}

}  // namespace

template <int D>
void fill(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  if (plan.family == Family::one_sided || plan.family == Family::rough) return fill_one_sided(draft);
  if (plan.family == Family::products) return fill_product(draft);
  if (plan.family == Family::redundant) add_redundant(draft);
  for (int i = 0; i < plan.bodies; ++i) draft.add_body();
  for (int i = 0; i < plan.rotors; ++i) draft.add_rotor();
  for (int i = 0; i < plan.particles; ++i) draft.add_particle();
  for (int i = 0; i < plan.constraints; ++i) add_constraint(draft);
  for (int i = 0; i < plan.forces; ++i) add_any_force(draft);
  if (plan.family == Family::kinked) {
    for (int i = 1 + draft.random.below(2); i > 0; --i) add_kinked(draft);
  }
}

template void fill(Draft<2>&);
template void fill(Draft<3>&);

}  // namespace dalembert::fuzz
