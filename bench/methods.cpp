#include "dalembert/bench/methods.h"

#include <dalembert/bench/hand/chain.h>
#include <dalembert/bench/hand/integrate.h>
#include <dalembert/bench/hand/plane_pendulum.h>
#include <dalembert/bench/peers/peers.h>
#include <dalembert/models/cone_equations.h>
#include <dalembert/models/double_pendulum_equations.h>

#include <numbers>

namespace dalembert::bench {

namespace {

using models::RodAndBead;

template <int D, class Equations>
auto by_hand(Equations equations) {
  return [equations = std::move(equations)](std::span<const double> times, double tolerance) {
    return integrate_by_hand<D>(equations, times, tolerance);
  };
}

Methods<2> with_peers(Methods<2>::mapped_type hand, double gravity, const std::vector<RodAndBead>& rods) {
  Methods<2> all = peers(gravity, rods);
  all[Method::hand] = std::move(hand);
  return all;
}

}  // namespace

Methods<2> methods(const models::PlanePendulum& p) {
  return with_peers(by_hand<2>(PlanePendulumEquation(p)), p.gravity, {{p.mass, p.length, p.amplitude}});
}

Methods<2> methods(const models::DoublePendulum& p) {
  return with_peers(by_hand<2>(models::DoublePendulumEquations<double>(p)), p.gravity,
                    {{p.mass1, p.length1, p.angle1}, {p.mass2, p.length2, p.angle2}});
}

Methods<2> methods(const models::Chain& c) {
  const RodAndBead link{c.mass / c.beads, c.length / c.beads, std::numbers::pi / 2};
  return with_peers(by_hand<2>(CartesianChain(c)), c.gravity,
                    std::vector(static_cast<std::size_t>(c.beads), link));
}

Methods<3> methods(const models::ConeSlide& cone) {
  return {{Method::hand, by_hand<3>(models::ConeEquations<double>(cone))}};
}

Methods<2> methods(const models::Model<2>& model) {
  if (model.name == "plane-pendulum") return methods(models::PlanePendulum{});
  if (model.name == "double-pendulum") return methods(models::DoublePendulum{});
  if (model.name == "chain") return methods(models::Chain{});
  return {};
}

Methods<3> methods(const models::Model<3>& model) {
  if (model.name == "cone") return methods(models::ConeSlide{});
  return {};
}

}  // namespace dalembert::bench
