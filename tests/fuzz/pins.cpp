#include "draft.h"

namespace dalembert::fuzz {

/// A new particle where the other point is.
template <int D>
void add_pin(Draft<D>& draft) {
  const Place<D> b = draft.any();
  const Place<D> p = draft.new_particle(b.r);
  if (b.owner < 0) {
    if (!draft.take(D - 1, {p.owner})) return;  // leaves it nothing: a particle at a fixed point
  }
  add_ball(draft, b, p, In::both);
}

template <int D>
void add_ball(Draft<D>& draft, const Place<D>& a, const Place<D>& b, In statement) {
  const auto add = [&](const auto& p, const auto& q) {
    using P = std::remove_cvref_t<decltype(p)>;
    if constexpr (P::inputs > 0)
      draft.add(call_text("Coincident", a.text, b.text), Coincident{q, p}, statement);
  };
  std::visit(add, b.point, a.point);
}

template void add_ball(Draft<2>&, const Place<2>&, const Place<2>&, In);
template void add_ball(Draft<3>&, const Place<3>&, const Place<3>&, In);
template void add_pin(Draft<2>&);
template void add_pin(Draft<3>&);

/// In space, with its ends held by rods or pinned.
void add_thin_rod(Draft<3>& draft) {
  ThinRodState<3> state;
  state.mass = draft.size(draft.plan.mass);
  const Place<3> start = draft.ground();
  state.start = draft.numbers(start.r);
  state.end = draft.numbers(state.start + draft.plan.length * draft.random.direction<3>());
  const std::string text = call_text("add_thin_rod", state.mass, write<3>(state.start), write<3>(state.end));
  draft.attempt(text, [&] {
    const ThinRod<3> rod = add_thin_rod(draft.scene, state, draft.body_name());
    const auto* pivot = std::get_if<Fixed<3>>(&start.point);
    if (pivot != nullptr && draft.random.chance(0.5)) {
      draft.add(call_text("  Coincident", start.text, "its start"), Coincident{*pivot, rod.start()});
    }
    const Place<3> other = draft.particle();
    const double length = (other.r - state.end).norm();
    draft.add(call_text("  Distance", other.text, "its end", length),
              Distance{std::get<Particle<3>>(other.point), rod.end(), length});
  });
}

}  // namespace dalembert::fuzz
