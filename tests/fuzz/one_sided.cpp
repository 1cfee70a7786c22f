#include "draft.h"

#include <algorithm>
#include <limits>

/// Particles among floors, walls, strings and each other.
namespace dalembert::fuzz {

namespace {

/// The gap at the start: some touch.
template <int D>
double clearance(Draft<D>& draft) {
  return draft.random.chance(0.3) ? 0.0 : draft.plan.length * draft.random.between(0.0, 0.5);
}

template <int D>
double restitution(Draft<D>& draft) {
  const double kind = draft.random.uniform(), between = draft.random.uniform();
  if (draft.plan.lossless) return 1.0;
  return kind < 0.3 ? 0.0 : kind < 0.4 ? 1.0 : between;
}

template <int D>
void add_wall(Draft<D>& draft, const Place<D>& p, const Vec<D>& r, const Vec<D>& n, double e) {
  draft.add(call_text("unilateral Plane", p.text, write<D>(r), write<D>(n), e),
            unilateral(OnSurface{handle(p), Plane<D>{r, n}}, {.restitution = e}));
}

/// One for all particles.
template <int D>
void add_floor(Draft<D>& draft) {
  const Vec<D> n = draft.random.template direction<D>();
  const Place<D> p = draft.particle();
  Vec<D> lowest = p.r;
  for (const Place<D>& q : draft.particles())
    if (n.dot(q.r - lowest) < 0.0) lowest = q.r;
  const Vec<D> r = lowest - clearance(draft) * n;
  const double e = restitution(draft);
  for (const Place<D>& q : draft.particles()) add_wall<D>(draft, q, r, n, e);
}

/// Two walls that face each other.
template <int D>
void add_gap(Draft<D>& draft) {
  const Place<D> p = draft.particle();
  const Vec<D> n = draft.random.template direction<D>();
  for (const double side : {1.0, -1.0}) {
    const Vec<D> r = p.r - side * clearance(draft) * n;
    add_wall<D>(draft, p, r, side * n, restitution(draft));
  }
}

/// Outside of a sphere, or within.
template <int D>
void add_sphere(Draft<D>& draft) {
  const Place<D> p = draft.particle();
  const Vec<D> n = draft.random.template direction<D>();
  const double radius = draft.size(draft.plan.length), gap = clearance(draft), e = restitution(draft);
  const bool outside = draft.random.chance(0.5);
  const Vec<D> centre = p.r - (outside ? radius + gap : radius - std::min(gap, 0.5 * radius)) * n;
  const Allowed allowed = outside ? Allowed::positive : Allowed::negative;
  draft.add(call_text(outside ? "unilateral Sphere" : "unilateral sphere about", p.text, write<D>(centre),
                      radius, e),
            unilateral(OnSurface{handle(p), Sphere<D>{centre, radius}}, {allowed, e}));
}

/// A string, or a distance that is not to become less: two particles that meet.
template <int D>
void add_limit(Draft<D>& draft) {
  const Place<D> b = draft.particle();
  const Place<D> a = draft.other_than(b);
  const double now = (b.r - a.r).norm(), gap = clearance(draft), e = restitution(draft);
  const bool string = draft.random.chance(0.6);
  if (!(now > 0.0)) return;
  const double length = string ? now + gap : now - std::min(gap, 0.5 * now);
  const auto add = [&](const auto& from) {
    using P = std::remove_cvref_t<decltype(from)>;
    if constexpr (!std::is_same_v<P, BodyPoint<D>>) {
      draft.add(
          call_text(string ? "unilateral string" : "unilateral contact", a.text, b.text, length, e),
          unilateral(Distance{from, handle(b), length}, {string ? Allowed::negative : Allowed::positive, e}));
    }
  };
  std::visit(add, a.point);
}

template <int D>
void add_spring(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> b = draft.particle();
  const Place<D> a = draft.other_than(b);
  const double k = draft.size(plan.mass / plan.time / plan.time), relaxed = 0.9 * (b.r - a.r).norm();
  const auto add = [&](const auto& from) {
    draft.add(call_text("Spring", a.text, b.text, k, relaxed), Spring{from, handle(b), k, relaxed});
  };
  std::visit(add, a.point);
}

}  // namespace

template <int D>
void add_passive_force(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const double kind = draft.random.uniform();
  if (kind < 0.4) {
    const Vec<D> g = draft.arrow(plan.acceleration());
    return draft.attempt(call_text("UniformGravity", write<D>(g)),
                         [&] { draft.scene.add(UniformGravity<D>{g}); });
  }
  if (kind < 0.7 || plan.lossless) return add_spring(draft);
  const Place<D> p = draft.particle();
  const double drag = draft.size(0.2 * plan.mass / plan.time),
               square = draft.size(0.2 * plan.mass / plan.length);
  if (kind < 0.85) return draft.add(call_text("LinearDrag", p.text, drag), LinearDrag{handle(p), drag});
  draft.add(call_text("QuadraticDrag", p.text, square), QuadraticDrag{handle(p), square});
}

template <int D>
void add_one_sided(Draft<D>& draft) {
  switch (draft.random.below(4)) {
    case 0:
      return add_floor(draft);
    case 1:
      return add_gap(draft);
    case 2:
      return add_sphere(draft);
    default:
      return add_limit(draft);
  }
}

template void add_passive_force(Draft<2>&);
template void add_passive_force(Draft<3>&);
template void add_one_sided(Draft<2>&);
template void add_one_sided(Draft<3>&);

}  // namespace dalembert::fuzz
