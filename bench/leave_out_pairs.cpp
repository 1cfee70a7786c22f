#include "dalembert/bench/leave_out_pairs.h"

#include <dalembert/dalembert.h>

#include <cmath>
#include <deque>
#include <numbers>
#include <utility>

namespace dalembert::bench {

namespace {

constexpr double gravity = 9.81;
/// Of the double pendulums [rad]. Released from higher, the fast one is chaotic within its 20 periods, and
/// two runs of it agree with nothing but each other's step sizes.
constexpr double steepest = std::numbers::pi / 6;

template <int D>
Vec<D> down() {
  return -gravity * Vec<D>::UnitY();
}

/// Beads along x, together 1 long and 1 heavy, released from rest; `add_rod(scene, a, b, length)`
/// states each rod.
template <int D, Point Pivot, class AddRod>
Watched<D> hanging(int beads, const Pivot& pivot, const AddRod& add_rod) {
  Watched<D> chain{Scene<D>("chain")};
  const double link = 1.0 / beads;
  for (int i = 0; i < beads; ++i) {
    const Vec<D> position = (i + 1) * link * Vec<D>::UnitX();
    const auto bead = chain.scene.add_particle({.mass = link, .position = position});
    if (i == 0) {
      add_rod(chain.scene, pivot, bead, link);
    } else {
      add_rod(chain.scene, chain.points.back(), bead, link);
    }
    chain.points.push_back(bead);
  }
  return chain;
}

constexpr auto rigid = [](auto& scene, const auto& a, const auto& b, double length) {
  scene.add(Distance{a, b, length});
};
constexpr auto timed = [](auto& scene, const auto& a, const auto& b, double length) {
  scene.add(holonomic(points(a, b), [length](auto t, auto r_a, auto r_b) {
    return (r_b - r_a).norm() - (length + 0.0 * t);
  }));
};

template <int D>
Watched<D> chain(int beads) {
  Watched<D> c = hanging<D>(beads, Fixed<D>{}, rigid);
  c.scene.add(UniformGravity<D>{down<D>()});
  return c;
}

Pair spatial_chain(int beads) {
  return {"chain", "the third coordinate", 1.0, 0.2, state(chain<3>(beads)), state(chain<2>(beads))};
}

Pair held_in_plane() {
  Watched<3> full = chain<3>(2);
  for (const Particle<3> bead : full.points) full.scene.add(OnSurface{bead, Plane<3>{}});
  return {"double-pendulum", "the third coordinate and planes that hold it", 1.0, 2.0, state(std::move(full)),
          state(chain<2>(2))};
}

Pair pinned_pivot() {
  Watched<2> full{Scene<2>("pendulum")};
  full.scene.add(UniformGravity<2>{down<2>()});
  const auto pivot = full.scene.add_particle({.mass = 1.0});
  const auto bob = full.scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  full.scene.add(Coincident{Fixed<2>{}, pivot});
  full.scene.add(Distance{pivot, bob, 1.0});
  full.points = {bob};
  return {"pendulum", "unknowns of a fixed point", 1.0, 10.0, state(std::move(full)), state(chain<2>(1))};
}

Pair idle_drive() {
  Watched<2> full = hanging<2>(1, driven([](auto t) { return vec(0.0 * t, 0.0 * t); }), rigid);
  full.scene.add(UniformGravity<2>{down<2>()});
  return {"pendulum",        "time derivatives of an idle drive", 1.0, 10.0, state(std::move(full)),
          state(chain<2>(1))};
}

Pair idle_time(int beads) {
  Watched<2> full = hanging<2>(beads, Fixed<2>{}, timed);
  full.scene.add(UniformGravity<2>{down<2>()});
  return {
      "chain", "time derivatives of idle lengths", 1.0, 0.2, state(std::move(full)), state(chain<2>(beads))};
}

Pair idle_drag(int beads) {
  Watched<2> full = chain<2>(beads);
  for (const Particle<2> bead : full.points) full.scene.add(LinearDrag{bead, 0.0});
  return {"chain",
          "a velocity-dependent force of coefficient 0",
          1.0,
          0.2,
          state(std::move(full)),
          state(chain<2>(beads))};
}

Pair varying_gravity(int beads) {
  Watched<2> full = hanging<2>(beads, Fixed<2>{}, rigid);
  for (const Particle<2> bead : full.points) full.scene.add(PointGravity{bead, 1.0 / beads, down<2>()});
  return {"chain",
          "derivatives of a force that is constant",
          1.0,
          0.2,
          state(std::move(full)),
          state(chain<2>(beads))};
}

Pair unread_forces(int beads) {
  return {.scene = "chain",
          .left_out = "forces of constraint at 990 of 1001 outputs",
          .length = 1.0,
          .t_end = 0.2,
          .full = state(chain<2>(beads)),
          .lean = state(chain<2>(beads)),
          .samples_full = 1001};
}

Pair kept_steps(int beads) {
  return {.scene = "chain",
          .left_out = "the motion between samples",
          .length = 1.0,
          .t_end = 0.2,
          .full = state(chain<2>(beads)),
          .lean = state(chain<2>(beads)),
          .dense_full = true};
}

/// A bead that rests on a rod: nothing moves it, and the motion of the rest does not know of it.
void add_idle_bead(Scene<2>& scene) {
  const auto bead = scene.add_particle({.mass = 1.0, .position = {0.0, 1.0}});
  scene.add(Distance{Fixed<2>{}, bead, 1.0});
}

/// A skate that turns at a constant rate on a slope: it does not slide down but drifts sideways, on
/// cycloids.
Watched<2> skate() {
  Watched<2> w{Scene<2>("skate")};
  const auto blade = w.scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}, .velocity = {1.0, 0.0}});
  const auto heading = w.scene.add_rotor({.inertia = 1.0, .angular_velocity = 1.0});
  w.scene.add(PointGravity{blade, 1.0, Vec<2>(0.0, -1.0)});
  w.scene.add(nonholonomic(points(blade, heading), [](auto, auto phi, auto v, auto) {
    return cos(phi[0]) * v.y() - sin(phi[0]) * v.x();
  }));
  w.points = {blade};
  return w;
}

Pair without_holonomic_rows() {
  Watched<2> full = skate();
  add_idle_bead(full.scene);
  return {"skate",       "holonomic rows (an idle bead on a rod)", 1.0, 10.0, state(std::move(full)),
          state(skate())};
}

Watched<2> on_spring() {
  Watched<2> w{Scene<2>("mass on a spring")};
  const auto mass = w.scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.0, 1.0}});
  w.scene.add(Spring{Fixed<2>{}, mass, 4.0, 0.5});
  w.points = {mass};
  return w;
}

Pair without_constraints() {
  Watched<2> full = on_spring();
  add_idle_bead(full.scene);
  return {"mass on a spring", "constraints (an idle bead on a rod)", 1.0, 10.0, state(std::move(full)),
          state(on_spring())};
}

/// A double pendulum released at rest, both rods of a length and at an angle from the vertical.
void add_double_pendulum(Watched<2>& w, double length, double angle) {
  const Vec<2> rod = length * Vec<2>(std::sin(angle), -std::cos(angle));
  const auto upper = w.scene.add_particle({.mass = 1.0, .position = rod});
  const auto lower = w.scene.add_particle({.mass = 1.0, .position = 2.0 * rod});
  w.scene.add(Distance{Fixed<2>{}, upper, length});
  w.scene.add(Distance{upper, lower, length});
  w.points.insert(w.points.end(), {upper, lower});
}

/// Double pendulums that do not know of each other, the last with rods of length `last`.
Pair islands(int count, double last, const std::string& scene) {
  Watched<2> together{Scene<2>("double pendulums")};
  together.scene.add(UniformGravity<2>{down<2>()});
  std::deque<Watched<2>> apart;
  for (int i = 0; i < count; ++i) {
    const double length = i == count - 1 ? last : 0.5;
    const double angle = steepest * (i + 1) / count;
    add_double_pendulum(together, length, angle);
    Watched<2>& alone = apart.emplace_back(Watched<2>{Scene<2>("double pendulum")});
    alone.scene.add(UniformGravity<2>{down<2>()});
    add_double_pendulum(alone, length, angle);
  }
  return {scene,
          "the other islands (each a scene of its own)",
          1.0,
          1.0,
          state(std::move(together)),
          state(std::move(apart))};
}

}  // namespace

std::vector<Pair> leave_out_pairs(int size) {
  const std::string double_pendulums = std::to_string(size) + " double pendulums";
  return {spatial_chain(size),
          held_in_plane(),
          pinned_pivot(),
          idle_drive(),
          idle_time(size),
          idle_drag(size),
          varying_gravity(size),
          unread_forces(size),
          kept_steps(size),
          without_holonomic_rows(),
          without_constraints(),
          islands(size, 0.5, double_pendulums),
          islands(size, 0.001, double_pendulums + " (one of them 20 times as fast)")};
}

}  // namespace dalembert::bench
