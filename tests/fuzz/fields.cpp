#include "draft.h"

namespace dalembert::fuzz {

namespace {

void add_couple(Draft<2>& draft, double torque) {
  const Place<2> a = draft.particle(), b = draft.particle();
  if (a.owner == b.owner && draft.plan.kind != Plan::Kind::invalid) return;
  draft.add(call_text("Couple", a.text, b.text, torque),
            Couple{std::get<Particle<2>>(a.point), std::get<Particle<2>>(b.point), torque});
}

}  // namespace

/// Of one point or rotor, or everywhere.
template <int D>
void add_field(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Vec<D> g = draft.numbers(draft.arrow(plan.acceleration()));
  const double mass = draft.size(plan.mass), drag = draft.size(0.2 * plan.mass / plan.time);
  const double square = draft.size(0.2 * plan.mass / plan.length);
  const double sign = draft.random.sign(), torque = sign * draft.size(plan.force() * plan.length);
  const int kind = draft.random.below(D == 2 ? 6 : 5);
  if (kind == 0)
    return draft.attempt(call_text("UniformGravity", write<D>(g)),
                         [&] { draft.scene.add(UniformGravity<D>{g}); });
  if (kind == 4) {
    const Wheel w = draft.wheel();
    return draft.add(call_text("Torque", w.text, torque), Torque{w.rotor, torque});
  }
  if constexpr (D == 2) {
    if (kind == 5) return add_couple(draft, torque);
  }
  const Place<D> p = draft.mover();
  const auto add = [&](const auto& point) {
    if constexpr (std::remove_cvref_t<decltype(point)>::inputs > 0) {
      if (kind == 1)
        draft.add(call_text("PointGravity", p.text, mass, write<D>(g)), PointGravity{point, mass, g});
      if (kind == 2) draft.add(call_text("LinearDrag", p.text, drag), LinearDrag{point, drag});
      if (kind == 3) draft.add(call_text("QuadraticDrag", p.text, square), QuadraticDrag{point, square});
    }
  };
  std::visit(add, p.point);
}

/// By `potential` and `force_law`.
template <int D>
void add_own_force(Draft<D>& draft) {
  const Plan& plan = draft.plan;
  const Place<D> p = draft.particle();
  const auto& point = std::get<Particle<D>>(p.point);
  const double k = draft.size(plan.mass / plan.time / plan.time), c = draft.size(0.2 * plan.mass / plan.time);
  const double omega = draft.size(1.0 / plan.time), start = plan.options.t_start;
  const Vec<D> centre = draft.numbers(p.r + plan.length * draft.random.template vector<D>());
  const Fuse fuse = draft.fuse();
  switch (draft.random.below(4)) {
    case 0:
      return draft.add(call_text("well", p.text, k, write<D>(centre)), potential(points(point), [=](auto r) {
                         return 0.5 * k * (r - centre).squaredNorm();
                       }));
    case 1:
      return draft.add(call_text("shaken well", p.text, k, write<D>(centre), omega, write(fuse)),
                       potential(points(point), [=](auto t, auto r) {
                         using std::sin;
                         return fuse(t) * 0.5 * k * (1.0 + 0.5 * sin(omega * (t - start))) *
                                (r - centre).squaredNorm();
                       }));
    case 2:
      return draft.add(call_text("wind", p.text, c, omega, write(fuse)),
                       force_law(points(point), [=](auto t, auto, auto v) {
                         using std::cos;
                         return ((-c * fuse(t) * (1.0 + 0.5 * cos(omega * (t - start)))) * v).eval();
                       }));
    default: {
      const Place<D> q = draft.particle();
      return draft.add(
          call_text("coupling", p.text, q.text, c),
          force_law(points(point, std::get<Particle<D>>(q.point)), [=](auto, auto, auto v_a, auto v_b) {
            const auto f = (c * (v_b - v_a)).eval();
            return std::tuple{f, (-f).eval()};
          }));
    }
  }
}

template void add_field(Draft<2>&);
template void add_field(Draft<3>&);
template void add_own_force(Draft<2>&);
template void add_own_force(Draft<3>&);

}  // namespace dalembert::fuzz
