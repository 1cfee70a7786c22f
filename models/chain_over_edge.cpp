#include "dalembert/models/chain_over_edge.h"

#include <dalembert/solvers/base/root.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace dalembert::models {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Where on the edge, from d upwards, the other end of a link lies.
double next(const RoundedEdge& edge, double d, double link) {
  const Vec<2> from = edge.position(d);
  const auto beyond = [&](double other) { return (edge.position(other) - from).norm() - link; };
  const double far = d - 3.0 * link / edge.radius;  // between two places of the curve d changes sqrt 2 times
  return root(beyond, d, -link, far, beyond(far), eps * (1.0 + std::abs(d)));
}

}  // namespace

double ChainOverEdge::rough_until() const { return edge().radius * (3.0 + 1.25 * std::log(links)); }

double ChainOverEdge::rate() const { return std::sqrt((1.0 + friction) * gravity / length); }

double ChainOverEdge::smooth() const {
  return friction > 0.0 ? rough_until() - RoundedEdge::shortcut() * edge().radius - excess() : 0.0;
}

GuidedChain ChainOverEdge::scene() const {
  GuidedChain built{Scene<2>("chain-over-edge"), {}, {}, {}};
  Scene<2>& scene = built.scene;
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  double d = (hanging + origin()) / edge().radius;  // on the wall
  for (int i = 0; i <= links; ++i) {
    if (i > 0) d = next(edge(), d, link());
    const double share = i == 0 || i == links ? 0.5 : 1.0;
    const auto bead = scene.add_particle({.mass = share * mass / links, .position = edge().position(d)});
    if (i > 0) built.rods.push_back(scene.add(Distance{built.beads.back(), bead, link()}));
    built.beads.push_back(bead);
    built.guides.push_back(scene.add(OnCurve{bead, edge()}));
  }
  if (friction == 0.0) return built;
  // |grad g| = 1 where it is rough, but for e^(-C/R).
  const auto law = [mu = friction, end = rough_until(), width = 0.5 * edge().radius](auto lambda, auto r,
                                                                                     auto v) {
    return (-mu / (1.0 + exp((r.x() + end) / width)) * lambda * v.normalized()).eval();
  };
  for (std::size_t i = 0; i < built.beads.size(); ++i)
    built.friction.push_back(scene.add(friction_law(built.guides[i], points(built.beads[i]), law)));
  return built;
}

Event<2> ChainOverEdge::leaves(const GuidedChain& chain) const {
  return {"leaves",
          [edge = edge(), place = origin(), last = chain.beads.back()](const auto& now) {
            return edge.along(now.position(last)) - place;
          },
          Crossing::rising, true};
}

double ChainOverEdge::time() const { return std::acosh(length / net_pull()) / rate(); }

double ChainOverEdge::time_of_links() const {
  const double passed = (friction > 0.0 ? 1.0 : RoundedEdge::curved_beyond_corner) * excess();
  const double inertia = std::sqrt(1.0 + 2.0 * excess() / length);
  const double c = net_pull(), speed = rate() * std::sqrt(length * length - c * c) / (1.0 + friction);
  const double unbraked = std::pow(smooth() / ((1.0 + friction) * speed), 3);
  return inertia / rate() * std::acosh((length + (1.0 + friction) * passed) / c) +
         friction * gravity / (6.0 * length) * unbraked;
}

double ChainOverEdge::time_of_pulling() const {
  const double b = friction * length / (1.0 + friction), sum = length + 2.0 * b;
  const double h = 0.25 * (sum + std::sqrt(sum * sum + 8.0 * hanging * (hanging - 2.0 * b)));
  return std::acosh((h - b) / (hanging - b)) / rate();
}

double ChainOverEdge::tension(double hanging_now) const {
  const double rho = mass / length;
  return (1.0 + friction) * rho * gravity * hanging_now * (length - hanging_now) / length;
}

double ChainOverEdge::energy_lost() const {
  const double braked = length - hanging - origin() - smooth();
  const double end = std::numbers::pi * edge().radius;
  return friction * mass / length * gravity * (0.5 * braked * braked + end * end / 24.0);
}

namespace {

Timed timed(const ChainOverEdge& system, const EventRun& how) {
  const GuidedChain chain = system.scene();
  const double time = system.time();
  const auto run = how.run(chain.scene, {.t_end = 2.0 * time, .samples = 2}, {system.leaves(chain)});
  const auto& events = run.events();
  return {.event = "leaves, N = " + std::to_string(system.links),
          .time = events.empty() ? HappenedAt{} : HappenedAt{events.front().time, 0},
          .reference = time,
          .limit = 1.5 * (system.time_of_links() / time - 1.0)};
}

EventModel model(std::string name, std::string notes, double friction) {
  const auto events = [friction](const EventRun& how) {
    std::vector<Timed> all;
    // The implicit stepper takes ten times as many steps, in proportion to N.
    for (int links = 50; links <= (how.stepper == Stepper::erk ? 400 : 200); links *= 2)
      all.push_back(timed({.links = links, .friction = friction}, how));
    return all;
  };
  return {.name = std::move(name), .notes = std::move(notes), .events = events};
}

}  // namespace

EventModel chain_over_edge_model() { return model("chain-over-edge", "mex148", 0.0); }
EventModel chain_over_edge_friction_model() { return model("chain-over-edge-friction", "mex149", 0.2); }

}  // namespace dalembert::models
