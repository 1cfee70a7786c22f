#include "draft.h"

namespace dalembert::fuzz {

/// A Distance between a particle or a point of a body and any other point, as long as it is.
template <int D>
void add_rod(Draft<D>& draft) {
  const Place<D> b = draft.mover();
  const Place<D> a = draft.other_than(b);
  const double length = (b.r - a.r).norm();
  if (draft.plan.kind == Plan::Kind::sensible && !(length > 0.0)) return;
  if (!draft.take(1, {b.owner, a.owner})) return;
  add_distance(draft, a, b, draft.number(length), In::both);
}

template <int D>
void add_distance(Draft<D>& draft, const Place<D>& a, const Place<D>& b, double length, In statement) {
  const auto add = [&](const auto& p, const auto& q) {
    using P = std::remove_cvref_t<decltype(p)>;
    if constexpr (P::inputs > 0)
      draft.add(call_text("Distance", a.text, b.text, length), Distance{q, p, length}, statement);
  };
  std::visit(add, b.point, a.point);
}

template void add_distance(Draft<2>&, const Place<2>&, const Place<2>&, double, In);
template void add_distance(Draft<3>&, const Place<3>&, const Place<3>&, double, In);
template void add_rod(Draft<2>&);
template void add_rod(Draft<3>&);

}  // namespace dalembert::fuzz
