#include "draft.h"

namespace dalembert::fuzz {

/// Between two points: Spring on anything, ElasticString and Damper on a particle.
template <int D>
void add_force(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> b = draft.mover();
  const Place<D> a = draft.other_than(b);
  const double k = draft.size(plan.mass / plan.time / plan.time);
  const double c = draft.size(0.3 * plan.mass / plan.time);
  const double relaxed = draft.random.chance(0.3) ? 0.0 : draft.number((b.r - a.r).norm() * 0.9);
  const bool on_particle = std::holds_alternative<Particle<D>>(b.point);
  const int kind = on_particle ? draft.random.below(3) : 0;
  const auto add = [&](const auto& p, const auto& q) {
    using P = std::remove_cvref_t<decltype(p)>;
    if constexpr (P::inputs > 0) {
      if (kind == 0) draft.add(call_text("Spring", a.text, b.text, k, relaxed), Spring{q, p, k, relaxed});
    }
    if constexpr (std::is_same_v<P, Particle<D>>) {
      if (kind == 1) draft.add(call_text("Damper", a.text, b.text, c), Damper{q, p, c});
      if (kind == 2 && (relaxed > 0.0 || plan.kind != Plan::Kind::sensible))
        draft.add(call_text("ElasticString", a.text, b.text, k, relaxed), ElasticString{q, p, k, relaxed});
    }
  };
  std::visit(add, b.point, a.point);
}

template void add_force(Draft<2>&);
template void add_force(Draft<3>&);

}  // namespace dalembert::fuzz
