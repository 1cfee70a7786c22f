#include "draft.h"

#include <cmath>

/// Equations of velocities of a user's own, each made to hold at the start.
namespace dalembert::fuzz {

namespace {

/// v_y = tan-like slope of where it is, with or without a wind.
template <int D>
void add_skate(Draft<D>& draft) {
  const Place<D> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  const double k = draft.size(1.0 / draft.plan.length), wind = draft.number(0.1 * draft.plan.speed());
  const Fuse fuse = draft.fuse();
  if (draft.random.chance(0.5)) {
    draft.add(call_text("skate", p.text, k),
              nonholonomic(points(handle(p)), [=](auto r, auto v) { return v[1] - k * r[0] * v[0]; }));
    return;
  }
  const double omega = draft.size(1.0 / draft.plan.time), start = draft.plan.options.t_start;
  draft.add(call_text("skate in wind", p.text, k, wind, omega, write(fuse)),
            nonholonomic(points(handle(p)), [=](auto t, auto r, auto v) {
              using std::cos;
              return fuse(t) * (v[1] - cos(k * r[0]) * v[0] - wind * cos(omega * (t - start)));
            }));
}

/// Integrable: two particles that keep their distance; and a particle with a wheel.
template <int D>
void add_integrable(Draft<D>& draft) {
  const Place<D> a = draft.particle(), b = draft.particle();
  if (a.owner == b.owner && draft.plan.kind != Plan::Kind::invalid) return;
  if (!draft.take(1, {a.owner, b.owner})) return;
  draft.add(call_text("integrable rod", a.text, b.text),
            nonholonomic(points(handle(a), handle(b)),
                         [=](auto r_a, auto r_b, auto v_a, auto v_b) { return (r_b - r_a).dot(v_b - v_a); }));
}
template <int D>
void add_rack(Draft<D>& draft) {
  const Place<D> p = draft.particle();
  const Wheel w = draft.wheel();
  if (!draft.take(1, {w.owner, p.owner})) return;
  const double radius = draft.size(draft.plan.length);
  draft.add(call_text("rack", p.text, w.text, radius),
            nonholonomic(points(handle(p), w.rotor),
                         [=](auto, auto, auto v, auto spin) { return v[0] - radius * spin[0]; }));
}

}  // namespace

template <int D>
void add_own_nonholonomic(Draft<D>& draft) {
  switch (draft.random.below(3)) {
    case 0:
      return add_skate(draft);
    case 1:
      return add_integrable(draft);
    default:
      return add_rack(draft);
  }
}

template void add_own_nonholonomic(Draft<2>&);
template void add_own_nonholonomic(Draft<3>&);

}  // namespace dalembert::fuzz
