#include "draft.h"

#include <cmath>

/// Equations of a user's own, each made to hold at the start.
namespace dalembert::fuzz {

namespace {

/// A wave on a slope, with or without time: g = n . r + b sin(k r_x) - c - drive(t), in units of `unit`.
template <int D>
void add_wave(Draft<D>& draft) {
  const Place<D> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  const double L = draft.plan.length, unit = draft.size(1.0), b = 0.2 * L, k = draft.size(1.0 / L);
  const Vec<D> n = draft.numbers(draft.random.template direction<D>());
  const double c = n.dot(p.r) + b * std::sin(k * p.r[0]);
  const Fuse fuse = draft.fuse();
  if (draft.random.chance(0.5)) {
    draft.add(call_text("wave", p.text, write<D>(n), b, k, c, unit),
              holonomic(points(handle(p)), [=](auto r) {
                using std::sin;
                return unit * (n.dot(r) + b * sin(k * r[0]) - c);
              }));
    return;
  }
  const Swing drive{0.0, 0.1 * L, draft.size(1.0 / draft.plan.time), draft.plan.options.t_start};
  draft.add(call_text("driven wave", p.text, write<D>(n), b, k, c, unit, drive.omega, write(fuse)),
            holonomic(points(handle(p)), [=](auto t, auto r) {
              using std::sin;
              return fuse(t) * unit * (n.dot(r) + b * sin(k * r[0]) - c - drive(t));
            }));
}

/// The product of two distances from the origin's planes and the like: r_a . r_b = c.
template <int D>
void add_product(Draft<D>& draft) {
  const Place<D> a = draft.particle(), b = draft.particle();
  if (a.owner == b.owner && draft.plan.kind != Plan::Kind::invalid) return;
  if (!draft.take(1, {a.owner, b.owner})) return;
  const double c = draft.number(a.r.dot(b.r));
  draft.add(call_text("dot", a.text, b.text, c),
            holonomic(points(handle(a), handle(b)), [=](auto r_a, auto r_b) { return r_a.dot(r_b) - c; }));
}

/// Two equations at once: the first two coordinates' differences keep their product and sum of squares.
template <int D>
void add_pair(Draft<D>& draft) {
  const Place<D> a = draft.particle(), b = draft.particle();
  if (a.owner == b.owner && draft.plan.kind != Plan::Kind::invalid) return;
  if (!draft.take(1, {a.owner}) || !draft.take(1, {b.owner})) return;
  const double L = draft.plan.length;
  const Vec<D> d = (b.r - a.r) / L;
  const Vec<2> c(draft.number(d[0] * d[1]), d[0] - d[1]);
  draft.add(call_text("pair", a.text, b.text, write<2>(c)),
            holonomic(points(handle(a), handle(b)), [=](auto r_a, auto r_b) {
              const auto x = ((r_b - r_a) / L).eval();
              return vec(x[0] * x[1] - c[0], x[0] - x[1] - c[1]);
            }));
}

}  // namespace

template <int D>
void add_own_holonomic(Draft<D>& draft) {
  switch (draft.random.below(3)) {
    case 0:
      return add_wave(draft);
    case 1:
      return add_product(draft);
    default:
      return add_pair(draft);
  }
}

template <int D>
void add_prescribed(Draft<D>& draft) {
  const double omega = draft.size(1.0 / draft.plan.time), start = draft.plan.options.t_start;
  if (draft.random.chance(0.5)) {
    const Wheel w = draft.wheel();
    if (!draft.take(0, {w.owner})) return;
    const Swing angle{w.angle, draft.size(1.0), omega, start};
    draft.add(call_text("Prescribed", w.text, angle.offset, angle.amplitude, omega),
              Prescribed{w.rotor, [=](auto t) { return vec(angle(t)); }});
    return;
  }
  const Place<D> p = draft.new_particle(draft.plan.length * draft.random.template vector<D>());
  if (!draft.take(D - 1, {p.owner})) return;
  const SwingingPath<D> path{p.r, 0.2 * draft.plan.length * draft.random.template vector<D>(), omega, start};
  draft.add(call_text("Prescribed", p.text, write<D>(path.amplitude), omega), Prescribed{handle(p), path});
}

template void add_own_holonomic(Draft<2>&);
template void add_own_holonomic(Draft<3>&);
template void add_prescribed(Draft<2>&);
template void add_prescribed(Draft<3>&);

}  // namespace dalembert::fuzz
