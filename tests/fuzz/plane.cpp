#include "draft.h"

#include <cmath>

namespace dalembert::fuzz {

namespace {

/// The curve at rest, shifted, or turned: all of them hold at the start.
template <class Curve>
void place_curve(Draft<2>& draft, const Place<2>& p, const Curve& curve, const std::string& text) {
  const double omega = draft.size(1.0 / draft.plan.time), start = draft.plan.options.t_start;
  const int moving = draft.random.below(5);
  if (moving == 0) {
    const SwingingPath<2> path{Vec<2>::Zero(), 0.1 * draft.plan.length * draft.random.vector<2>(), omega,
                               start};
    draft.add(call_text("OnCurve", p.text, text, "translating " + write<2>(path.amplitude), omega),
              OnCurve{handle(p), Translating{curve, path}});
  } else if (moving == 1) {
    const Vec<2> centre = draft.plan.length * draft.random.vector<2>() + p.r;
    const Swing angle{0.0, draft.random.between(-1.0, 1.0), omega, start};
    draft.add(call_text("OnCurve", p.text, text, "rotating " + write<2>(centre), angle.amplitude, omega),
              OnCurve{handle(p), Rotating{curve, centre, angle}});
  } else {
    draft.add(call_text("OnCurve", p.text, text), OnCurve{handle(p), curve});
  }
}

/// On the left of a track at its radius, and with or without slip.
void add_wheel_on_track(Draft<2>& draft) {
  const Place<2> p = draft.particle();
  const Wheel wheel = draft.wheel();
  const double radius = draft.size(draft.plan.length);
  const Vec<2> e = draft.random.direction<2>(), foot = p.r - radius * Vec<2>(-e.y(), e.x());
  const Vec<2> r_a = draft.numbers(foot - draft.plan.length * draft.random.decades(-1.0, 0.5) * e);
  const Fixed<2> a{r_a}, b{foot + draft.plan.length * e};
  if (!draft.take(1, {p.owner})) return;
  draft.add(call_text("PointLineDistance", p.text, write<2>(a.position), write<2>(b.position), radius),
            PointLineDistance{handle(p), a, b, radius});
  if (!draft.take(1, {p.owner, wheel.owner}) && !draft.random.chance(0.3)) return;
  draft.add(call_text("Rolling", p.text, wheel.text, write<2>(a.position), write<2>(b.position), radius),
            Rolling{handle(p), wheel.rotor, a, b, radius});
}

/// A bead on the line through two particles.
void add_bead_on_line(Draft<2>& draft) {
  const Place<2> p = draft.particle(), a = draft.particle(), b = draft.particle();
  const bool same = p.owner == a.owner || p.owner == b.owner || a.owner == b.owner;
  if (same && draft.plan.kind != Plan::Kind::invalid) return;
  if (!draft.take(1, {p.owner, a.owner, b.owner})) return;
  const Vec<2> e = (b.r - a.r).normalized(), d = p.r - a.r;
  const double offset = draft.number(e.x() * d.y() - e.y() * d.x());
  draft.add(call_text("PointLineDistance", p.text, a.text, b.text, offset),
            PointLineDistance{handle(p), handle(a), handle(b), offset});
}

void add_upright(Draft<2>& draft) {
  const Place<2> p = draft.particle();
  const Wheel heading = draft.wheel(), spin = draft.wheel();
  const bool same = heading.owner == spin.owner;
  if (same && draft.plan.kind == Plan::Kind::sensible) return;
  if (!draft.take(1, {p.owner})) return;
  const double radius = draft.size(draft.plan.length);
  draft.add(call_text("UprightRolling", p.text, heading.text, spin.text, radius),
            UprightRolling{handle(p), heading.rotor, spin.rotor, radius});
}

void add_heading(Draft<2>& draft) {
  const Place<2> p = draft.particle(), from = draft.particle();
  const Place<2> to = draft.ground();
  const auto* goal = std::get_if<Fixed<2>>(&to.point);
  if (goal == nullptr || !draft.take(1, {p.owner})) return;
  draft.add(call_text("KnifeEdge", p.text, from.text, to.text), KnifeEdge{handle(p), handle(from), *goal});
}

/// The prey lies ahead.
void add_pursuit(Draft<2>& draft) {
  const Place<2> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  const Vec<2> ahead = p.v.norm() > 0.0 ? p.v.normalized() : draft.random.direction<2>();
  const Vec<2> r = p.r + 3.0 * draft.plan.length * ahead;
  const SwingingPath<2> path{r, 0.1 * draft.plan.length * draft.random.vector<2>(),
                             draft.size(1.0 / draft.plan.time), draft.plan.options.t_start};
  draft.add(call_text("Pursuit", p.text, write<2>(r), write<2>(path.amplitude), path.omega),
            Pursuit{handle(p), driven(path)});
}

}  // namespace

void add_on_curve(Draft<2>& draft) {
  const Place<2> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  if (draft.random.chance(0.4)) {
    const Plane<2> line{p.r, draft.numbers(draft.arrow(1.0))};
    return place_curve(draft, p, line, "Plane<2>" + write<2>(line.normal));
  }
  const Vec<2> centre = p.r + draft.arrow(draft.plan.length);
  const Sphere<2> circle{draft.numbers(centre), draft.number((p.r - centre).norm())};
  place_curve(draft, p, circle, "Sphere<2>" + write<2>(circle.centre) + write(circle.radius));
}

void add_rolling(Draft<2>& draft) {
  switch (draft.random.below(5)) {
    case 0:
      return add_wheel_on_track(draft);
    case 1:
      return add_bead_on_line(draft);
    case 2:
      return add_upright(draft);
    case 3:
      return add_heading(draft);
    default:
      return add_pursuit(draft);
  }
}

}  // namespace dalembert::fuzz
