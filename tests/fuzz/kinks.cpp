#include "draft.h"

#include <Eigen/Geometry>

#include <cmath>

/// Forces and constraints that compare numbers: each is smooth on either side of a plane near the particle it
/// acts on, or before and after an instant of the run.
namespace dalembert::fuzz {

namespace {

/// What lies beyond the edge, and 0 on this side: max(x, 0).
template <class S>
S beyond(const S& x) {
  return x > 0.0 ? x : S(0.0 * x);
}

/// How far a point is past a plane.
template <int D>
struct Edge {
  Vec<D> n;
  double c;
  auto operator()(const auto& r) const { return n.dot(r) - c; }
};

/// A plane that a particle which moves at the plan's speed may well cross.
template <int D>
Edge<D> random_edge(Draft<D>& draft, const Place<D>& p) {
  const Vec<D> n = draft.random.template direction<D>();
  return {n, n.dot(p.r) + draft.plan.length * draft.random.between(-0.5, 0.5)};
}

double random_instant(Random& random, const Options& o) {
  return o.t_start + random.uniform() * (o.t_end - o.t_start);
}

template <int D>
void add_kinked_potential(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> p = draft.particle();
  const Edge<D> edge = random_edge(draft, p);
  const double f = draft.size(plan.force()), k = draft.size(10.0 * plan.force() / plan.length);
  if (draft.random.chance(0.5)) {
    return draft.add(call_text("bumper", p.text, write<D>(edge.n), edge.c, k),
                     potential(points(handle(p)), [=](auto r) {
                       const auto x = beyond(edge(r));
                       return 0.5 * k * x * x;
                     }));
  }
  draft.add(call_text("vee", p.text, write<D>(edge.n), edge.c, f), potential(points(handle(p)), [=](auto r) {
              using std::abs;
              return f * abs(edge(r));
            }));
}

template <int D>
void add_kinked_force(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> p = draft.particle();
  const Edge<D> edge = random_edge(draft, p);
  const Vec<D> f = draft.arrow(plan.force());
  const double instant = random_instant(draft.random, plan.options);
  const double c = draft.size(0.3 * plan.mass / plan.length), delay = draft.size(plan.time);
  const std::string text = p.text + ", " + write<D>(edge.n) + ", " + write(edge.c) + ", " + write<D>(f);
  switch (draft.random.below(4)) {
    case 0:
      return draft.add(call_text("gust", text, instant),
                       force_law(points(handle(p)), [=](auto t, auto, auto v) {
                         return (0.0 * v + (t >= instant ? 1.0 : 0.0) * f).eval();
                       }));
    case 1:
      return draft.add(call_text("wall of wind", text),
                       force_law(points(handle(p)), [=](auto, auto r, auto v) {
                         return (0.0 * v + (edge(r) > 0.0 ? 1.0 : 0.0) * f).eval();
                       }));
    case 2:
      return draft.add(call_text("brake", text, c), force_law(points(handle(p)), [=](auto, auto, auto v) {
                         using std::abs;
                         return ((-c * abs(edge.n.dot(v))) * v).eval();
                       }));
    default:  // chatters where its force leads to its edge from either side
      return draft.add(call_text("relay", text, delay),
                       force_law(points(handle(p)), [=](auto, auto r, auto v) {
                         const bool past = edge(r) + delay * edge.n.dot(v) > 0.0;
                         return (0.0 * v + (past ? -1.0 : 1.0) * f).eval();
                       }));
  }
}

/// With a jump of curvature, or of the acceleration of its drive, or with a corner, at which there is an
/// impact.
template <int D>
void add_kinked_holonomic(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  const Edge<D> edge = random_edge(draft, p);
  const Vec<D> n = edge.n.unitOrthogonal();
  const double instant = random_instant(draft.random, plan.options), L = plan.length;
  const double bend = draft.size(0.3 / L), push = draft.size(0.3 * plan.acceleration());
  const double past = beyond(edge(p.r));
  const std::string text = p.text + ", " + write<D>(edge.n) + ", " + write(edge.c);
  switch (draft.random.below(3)) {
    case 0:
      return draft.add(call_text("bend", text, bend),
                       holonomic(points(handle(p)), [=, c = n.dot(p.r) - bend * past * past](auto r) {
                         const auto x = beyond(edge(r));
                         return n.dot(r) - bend * x * x - c;
                       }));
    case 1:
      return draft.add(call_text("pushed plane", p.text, write<D>(n), instant, push),
                       holonomic(points(handle(p)), [=, c = n.dot(p.r)](auto t, auto r) {
                         const auto late = beyond(t - instant);
                         return n.dot(r) - 0.5 * push * late * late - c;
                       }));
    default:
      return draft.add(call_text("corner", text),
                       holonomic(points(handle(p)), [=, c = n.dot(p.r) - past](auto r) {
                         return n.dot(r) - beyond(edge(r)) - c;
                       }));
  }
}

template <int D>
void add_kinked_skate(Draft<D>& draft) {
  const Place<D> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  const Edge<D> edge = random_edge(draft, p);
  const double k = draft.size(1.0 / draft.plan.length);
  draft.add(
      call_text("kinked skate", p.text, write<D>(edge.n), edge.c, k),
      nonholonomic(points(handle(p)), [=](auto r, auto v) { return v[1] - k * beyond(edge(r)) * v[0]; }));
}

/// On a plane that it is pressed to or pulled from, with a force that reads which.
template <int D>
void add_rubbing(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  const Vec<D> n = draft.random.template direction<D>();
  const Vec<D> f = draft.arrow(plan.force());
  const double mu = draft.random.between(0.0, 0.5);
  const double slow = draft.random.chance(0.5) ? 0.01 * plan.speed() : 0.0;
  draft.add(call_text("pressed", p.text, write<D>(f)),
            force_law(points(handle(p)), [=](auto, auto, auto v) { return (0.0 * v + f).eval(); }));
  draft.attempt(call_text("rubbing", p.text, write<D>(n), mu, slow), [&] {
    const auto table =
        draft.scene.add(holonomic(points(handle(p)), [n, c = n.dot(p.r)](auto r) { return n.dot(r) - c; }));
    if (slow == 0.0) {
      draft.scene.add(friction_law(table, points(handle(p)), [=](auto N, auto, auto v) {
        return (-mu * abs(N) * v.normalized()).eval();
      }));
    } else {
      draft.scene.add(friction_law(table, points(handle(p)), [=](auto N, auto, auto v) {
        using std::sqrt;
        return (-mu * abs(N) / sqrt(v.squaredNorm() + slow * slow) * v).eval();
      }));
    }
  });
}

}  // namespace

template <int D>
void add_kinked(Draft<D>& draft) {
  const double kind = draft.random.uniform();
  if (kind < 0.25) return add_kinked_potential(draft);
  if (kind < 0.55) return add_kinked_force(draft);
  if (kind < 0.75) return add_kinked_holonomic(draft);
  return kind < 0.85 ? add_kinked_skate(draft) : add_rubbing(draft);
}

template void add_kinked(Draft<2>&);
template void add_kinked(Draft<3>&);

}  // namespace dalembert::fuzz
