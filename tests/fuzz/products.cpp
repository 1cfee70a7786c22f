#include "draft.h"

#include <cmath>

/// Scenes of all features at once.
namespace dalembert::fuzz {

namespace {

/// A compliant rod, or in its twin the same spring as a force.
template <int D>
void add_compliant_rod(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> b = draft.mover();
  const Place<D> a = draft.other_than(b);
  const double k = plan.mass / plan.time / plan.time * draft.random.decades(0.0, 4.0);
  const double length = (b.r - a.r).norm() * draft.random.between(0.9, 1.1);
  if (!(length > 0.0)) return;
  const auto add = [&](const auto& p, const auto& q) {
    using P = std::remove_cvref_t<decltype(p)>;
    if constexpr (P::inputs > 0) {
      const std::string text = call_text("compliant", a.text, b.text, k, length);
      if (draft.statement().springs) {
        draft.add("Spring for " + text, Spring{q, p, k, length});
      } else {
        draft.add(text, compliant(Distance{q, p, length}, 1.0 / k));
      }
    }
  };
  std::visit(add, b.point, a.point);
}

/// A body on a hinge or a slide, of the ground or of another body.
template <int D>
void add_jointed(Draft<D>& draft) {
  const auto* before = draft.last_body();
  const bool on_body = before != nullptr && draft.random.chance(0.5);
  const RigidBody<D> other = on_body ? before->body : RigidBody<D>{};
  const auto* added = draft.new_body();
  const bool hinge = draft.random.chance(0.6);
  const int rows = D == 2 ? 2 : 5;
  if (added == nullptr || !draft.take(rows, {added->owner})) return;
  const RigidBody<D> body = added->body;
  const Vec<D> point = added->centre + draft.plan.length * draft.random.template vector<D>();
  const Vec<D> axis = draft.random.template direction<D>();
  const auto add = [&](const auto& a, const std::string& text) {
    const std::string where = write<D>(point) + write<D>(axis);
    if (!hinge) return draft.add(call_text("Prismatic", text, where), Prismatic{a, body, point, axis});
    if constexpr (D == 2) {
      draft.add(call_text("Revolute", text, write<D>(point)), Revolute{a, body, point});
    } else {
      draft.add(call_text("Revolute", text, where), Revolute{a, body, point, axis});
    }
  };
  if (on_body) return add(other, "a body");
  add(Ground<D>{}, "Ground");
}

/// Sliding friction that is smooth at rest, on a curve or surface.
template <int D>
void add_friction_law(Draft<D>& draft) {
  const Place<D> p = draft.particle();
  if (!draft.take(1, {p.owner})) return;
  const Vec<D> n = draft.random.template direction<D>();
  const double mu = draft.random.between(0.05, 0.8), slow = 0.1 * draft.plan.speed();
  draft.attempt(call_text("friction_law on a plane", p.text, write<D>(n), mu, slow), [&] {
    const auto plane = draft.scene.add(OnSurface{handle(p), Plane<D>{p.r, n}});
    draft.scene.add(friction_law(plane, points(handle(p)), [mu, slow](auto lambda, auto, auto v) {
      using std::abs, std::sqrt;
      return (-mu * abs(lambda) / sqrt(v.squaredNorm() + slow * slow) * v).eval();
    }));
  });
}

/// At a time or a place: gravity stated anew, or a rod let go.
template <int D>
void add_change(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Options& o = plan.options;
  const double when = o.t_start + (o.t_end - o.t_start) * draft.random.between(0.1, 0.9);
  const Place<D> p = draft.particle();
  const double there = p.r[0] + 0.1 * plan.length * draft.random.sign();
  const bool by_place = draft.random.chance(0.4);
  const auto particle = handle(p);
  const double length = plan.length, time = plan.time;
  const auto function = [=](const Sample<D>& now) {
    return by_place ? (now.position(particle)[0] - there) / length : (now.time() - when) / time;
  };
  const std::string text = by_place ? " where x of " + p.text + " = " + write(there) : " at " + write(when);
  if (draft.random.chance(0.5)) {
    const Vec<D> first = draft.arrow(plan.acceleration()), then = draft.arrow(plan.acceleration());
    return draft.attempt("gravity " + write<D>(first) + " becomes " + write<D>(then) + text, [&] {
      const auto gravity = draft.scene.add(UniformGravity<D>{first});
      draft.events.push_back({.name = "turns", .function = function, .change = [=](Scene<D>& scene) {
                                scene.replace(gravity, UniformGravity<D>{then});
                              }});
    });
  }
  if (!draft.take(1, {p.owner})) return;
  const Vec<D> pivot = p.r + plan.length * draft.random.template direction<D>();
  draft.attempt(call_text("rod", p.text, write<D>(pivot)) + " let go" + text, [&] {
    const auto rod = draft.scene.add(Distance{Fixed<D>{pivot}, particle, (p.r - pivot).norm()});
    draft.events.push_back(
        {.name = "lets go", .function = function, .change = [=](Scene<D>& scene) { scene.release(rod); }});
  });
}

template <int D>
void add_holonomic(Draft<D>& draft) {
  if (draft.random.chance(0.5)) return add_rod(draft);
  if (draft.random.chance(0.3)) return add_own_holonomic(draft);
  if constexpr (D == 2) {
    add_on_curve(draft);
  } else {
    add_on_surface(draft);
  }
}

template <int D>
void add_nonholonomic(Draft<D>& draft) {
  if (draft.random.chance(0.5)) return add_own_nonholonomic(draft);
  if constexpr (D == 2) {
    add_rolling(draft);
  } else {
    add_disk(draft);
  }
}

/// A rod on a point that swings, or a driven rotor.
template <int D>
void add_driven(Draft<D>& draft) {
  if (draft.random.chance(0.2)) return add_prescribed(draft);
  const Place<D> b = draft.mover();
  const Place<D> a = draft.ground();
  if (!draft.take(1, {b.owner})) return;
  add_distance(draft, a, b, (b.r - a.r).norm(), In::both);
}

template <int D>
void add_feature(Draft<D>& draft, Feature feature) {
  switch (feature) {
    case Feature::holonomic:
      return add_holonomic(draft);
    case Feature::nonholonomic:
      return add_nonholonomic(draft);
    case Feature::compliant:
      return add_compliant_rod(draft);
    case Feature::redundant:
      return add_redundant(draft);
    case Feature::driven:
      return add_driven(draft);
    case Feature::joint:
      return add_jointed(draft);
    case Feature::one_sided:
      return add_one_sided(draft);
    case Feature::rough:
      return add_rough(draft);
    case Feature::friction_law:
      return add_friction_law(draft);
    case Feature::kink:
      return add_kinked(draft);
    case Feature::force:
      return draft.random.chance(0.5) ? add_force(draft) : add_field(draft);
    case Feature::change:
      return add_change(draft);
    default:
      return;  // a way to run
  }
}

}  // namespace

const char* name(Feature feature) {
  constexpr std::array names{"holonomic", "nonholonomic", "compliant", "redundant",    "driven",
                             "joint",     "one-sided",    "rough",     "friction-law", "kink",
                             "force",     "change",       "restart",   "stepwise",     "dense",
                             "ida",       "erk",          "loose",     "tight"};
  static_assert(names.size() == features.size());
  return names[static_cast<std::size_t>(feature)];
}

/// Each feature stands once or twice in it, with gravity mostly.
template <int D>
void fill_product(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  for (int i = 0; i < plan.particles; ++i) draft.add_particle();
  if (draft.random.chance(0.8)) {
    const Vec<D> g = draft.arrow(plan.acceleration());
    draft.attempt(call_text("UniformGravity", write<D>(g)), [&] { draft.scene.add(UniformGravity<D>{g}); });
  }
  for (const Feature feature : plan.features) {
    for (int n = 1 + draft.random.below(2); n > 0; --n) add_feature(draft, feature);
  }
}

template void fill_product(Draft<2>&);
template void fill_product(Draft<3>&);

}  // namespace dalembert::fuzz
