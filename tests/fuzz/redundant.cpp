#include "draft.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

/// Parts of a scene with redundant constraints, and the same without those.
namespace dalembert::fuzz {

namespace {

/// What supports a part: the ground, a driven point, or a body. Gives its point that is at `r`.
template <int D>
using Support = std::function<Place<D>(const Vec<D>& r)>;

template <int D>
Support<D> support_on(const typename Draft<D>::Body& body, Draft<D>& draft) {
  return [body, &draft](const Vec<D>& r) {
    return draft.point_at(body, body.axes.transpose() * (r - body.centre));
  };
}

template <int D>
Support<D> random_support(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const double kind = draft.random.uniform();
  const Vec<D> amplitude = 0.2 * plan.length * draft.random.template vector<D>();
  const double omega = draft.size(1.0 / plan.time);
  if (kind < 0.3) {
    if (const auto* body = draft.new_body()) return support_on(*body, draft);
  }
  if (kind < 0.5) {
    return [=, start = plan.options.t_start](const Vec<D>& r) {
      const SwingingPath<D> path{r, amplitude, omega, start};
      return Place<D>{driven(path), r, amplitude * omega, -1,
                      call_text("driven", write<D>(r), write<D>(amplitude), omega)};
    };
  }
  return [](const Vec<D>& r) { return Place<D>{Fixed<D>{r}, r, Vec<D>::Zero(), -1, "Fixed" + write<D>(r)}; };
}

/// A second ball, at p, beside one at `first`, which already keeps the distance between them: in full it is
/// redundant in that direction, without redundancy p keeps its distance from points to the sides.
template <int D>
void add_second_ball(Draft<D>& draft, const Support<D>& support, const Vec<D>& first, const Place<D>& p) {
  add_ball(draft, support(p.r), p, In::full);
  const double side = draft.plan.length;
  const Vec<D> axis = (p.r - first).normalized();
  Vec<D> u = axis.unitOrthogonal();
  add_distance(draft, support(p.r + side * u), p, side, In::lean);
  if constexpr (D == 3) {
    u = axis.cross(u).eval();
    add_distance(draft, support(p.r + side * u), p, side, In::lean);
  }
}

/// A body that turns about an axis: in space by two or three balls on it, in the plane by two or three pins
/// in one place.
template <int D>
void add_hinge(Draft<D>& draft) {
  const Support<D> support = random_support(draft);
  const auto* added = draft.new_body();
  const int more = 1 + draft.random.below(2);
  if (added == nullptr || !draft.take(D == 2 ? 2 : 5, {added->owner})) return;
  const Support<D> body = support_on(*added, draft);
  const Vec<D> first = added->centre + draft.plan.length * draft.random.template vector<D>();
  const Vec<D> axis = draft.random.template direction<D>();
  add_ball(draft, support(first), body(first), In::both);
  for (int i = 0; i < more; ++i) {
    const double along = draft.plan.length * draft.random.between(0.3, 1.0) * (i == 0 ? 1.0 : -1.0);
    const Place<D> p = body(D == 2 ? first : Vec<D>(first + along * axis));
    if (D == 3 && i == 0) {
      add_second_ball(draft, support, first, p);
    } else {
      add_ball(draft, support(p.r), p, In::full);
    }
  }
}

/// Where the nodes of a frame are: a polygon, or a bipyramid, whose last node sees the D before it and every
/// other those before it at good angles.
template <int D>
std::vector<Vec<D>> nodes(Draft<D>& draft) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double L = draft.plan.length, uneven = draft.random.chance(0.5) ? 0.2 : 0.0;
  const Vec<D> centre = L * draft.random.template vector<D>() + draft.origin();
  const int n = D == 2 ? 4 + draft.random.below(2) : 5, around = D == 2 ? n : 3;
  std::vector<Vec<D>> r;
  for (int i = 0; i < n; ++i) {
    Vec<D> at = Vec<D>::Zero();
    const bool apex = D == 3 && (i == 0 || i == n - 1);
    if (apex) at[D - 1] = i == 0 ? 1.0 : -1.0;
    if (!apex) {
      at[0] = std::cos(turn * i / around);
      at[1] = std::sin(turn * i / around);
    }
    r.push_back(centre + L * (at + uneven * draft.random.template vector<D>()));
  }
  return r;
}

/// Particles with more rods between them than keep them rigid, free, hung by one node or by two. Each node
/// has rods to the D before it; the others are redundant.
template <int D>
void add_frame(Draft<D>& draft) {
  std::vector<Place<D>> node;
  for (const Vec<D>& r : nodes(draft)) node.push_back(draft.new_particle(r));
  const auto n = node.size();
  for (std::size_t j = 1; j < n; ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const bool surplus = i + D < j;
      if (surplus && draft.random.chance(0.2)) continue;
      add_distance(draft, node[i], node[j], (node[j].r - node[i].r).norm(), surplus ? In::full : In::both);
    }
  }
  for (const Place<D>& p : node) (void)draft.take(D - 1, {p.owner});  // nothing else holds it
  const int hung = draft.random.below(3);
  if (hung == 0) return;
  const Support<D> support = random_support(draft);
  add_ball(draft, support(node[0].r), node[0], In::both);
  if (hung == 2) add_second_ball(draft, support, node[0].r, node[1]);
}

/// A bob on a particle that is held at a point, and on that point.
template <int D>
void add_twin_rod(Draft<D>& draft) {
  const Support<D> support = random_support(draft);
  const Vec<D> r = draft.plan.length * draft.random.template vector<D>() + draft.origin();
  const Place<D> p = draft.new_particle(r);
  const Place<D> bob = draft.new_particle(r + draft.plan.length * draft.random.template direction<D>());
  (void)draft.take(D - 1, {p.owner});
  if (!draft.take(1, {bob.owner})) return;
  const double length = (bob.r - r).norm();
  add_ball(draft, support(r), p, In::both);
  add_distance(draft, p, bob, length, In::both);
  add_distance(draft, support(r), bob, length, In::full);
}

}  // namespace

template <int D>
void add_redundant(Draft<D>& draft) {
  const int kind = draft.random.below(5);
  if (kind < 2) return add_hinge(draft);
  return kind < 4 ? add_frame(draft) : add_twin_rod(draft);
}

template void add_redundant(Draft<2>&);
template void add_redundant(Draft<3>&);

}  // namespace dalembert::fuzz
