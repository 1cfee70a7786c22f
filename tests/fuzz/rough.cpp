#include "draft.h"

#include <cmath>

/// Particles on rough planes and spheres that hold them, or that they may leave.
namespace dalembert::fuzz {

namespace {

template <int D>
auto touching(const Particle<D>& particle, const auto& surface) {
  if constexpr (D == 2) {
    return OnCurve{particle, surface};
  } else {
    return OnSurface{particle, surface};
  }
}

template <int D>
void add_friction(Draft<D>& draft, const Place<D>& p, const auto& surface, const std::string& text) {
  const bool may_leave = draft.random.chance(0.4);
  const double mu = draft.random.between(0.0, 1.0),
               more = draft.random.chance(0.5) ? 0.0 : draft.random.between(0.0, 0.5);
  draft.attempt(
      call_text("coulomb", text, write(mu), write(mu + more)) + (may_leave ? " may leave" : ""), [&] {
        const auto& particle = std::get<Particle<D>>(p.point);
        const auto touch = touching<D>(particle, surface);
        const auto presses = may_leave ? draft.scene.add(unilateral(touch)) : draft.scene.add(touch);
        if (!draft.statement().regularised || may_leave || more > 0.0) {
          draft.scene.add(coulomb(presses, Slip{particle, surface}, mu, mu + more));
        } else {
          const double slow = regularised_below * draft.plan.speed();
          draft.scene.add(friction_law(presses, points(particle), [mu, slow](auto lambda, auto, auto v) {
            using std::abs, std::sqrt;
            return (-mu * abs(lambda) / sqrt(v.squaredNorm() + slow * slow) * v).eval();
          }));
        }
      });
}

}  // namespace

template <int D>
void add_rough(Draft<D>& draft) {
  // Mostly such that it touches without an impact, whose friction is refused, and once each.
  const Place<D> p = draft.particle();
  Vec<D> n = draft.random.template direction<D>();
  if (draft.random.chance(0.9) && p.v.norm() > 0.0)
    n = (n - p.v * (n.dot(p.v) / p.v.squaredNorm())).normalized().eval();
  if (!draft.take(1, {p.owner}) && draft.random.chance(0.9)) return;
  if (draft.random.chance(0.6)) {
    const Plane<D> plane{p.r, n};
    return add_friction(draft, p, plane, call_text("Plane", p.text, write<D>(p.r), write<D>(n)));
  }
  const double radius = draft.size(draft.plan.length);
  const Sphere<D> sphere{p.r - radius * n, radius};
  add_friction(draft, p, sphere, call_text("Sphere", p.text, write<D>(sphere.centre), radius));
}

template void add_rough(Draft<2>&);
template void add_rough(Draft<3>&);

}  // namespace dalembert::fuzz
