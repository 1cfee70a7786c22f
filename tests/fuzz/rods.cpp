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
  const double given = draft.number(length);
  const auto add = [&](const auto& p, const auto& q) {
    using P = std::remove_cvref_t<decltype(p)>;
    if constexpr (P::inputs > 0)
      draft.add(call_text("Distance", a.text, b.text, given), Distance{q, p, given});
  };
  std::visit(add, b.point, a.point);
}

template void add_rod(Draft<2>&);
template void add_rod(Draft<3>&);

}  // namespace dalembert::fuzz
