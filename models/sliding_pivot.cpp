#include "dalembert/models/sliding_pivot.h"

#include <dalembert/models/minimal_ode.h>

#include <boost/math/quadrature/trapezoidal.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace dalembert::models {

namespace {

Real tension(const SlidingPivot& p, Real phi, Real rate) {
  const Real sine = std::sin(phi);
  return Real(p.block_mass) * p.bob_mass * (p.length * rate * rate + p.gravity * std::cos(phi)) /
         (p.block_mass + p.bob_mass * sine * sine);
}

Observation<2> observation(const SlidingPivot& p, const State& y) {
  const Real phi = y[0], pull = tension(p, phi, y[1]), mu = p.bob_mass / (Real(p.block_mass) + p.bob_mass);
  const Real x = mu * p.length * (std::sin(Real(p.angle)) - std::sin(phi));
  const VecOf<Real, 2> block = vec(x, Real(0));
  const VecOf<Real, 2> bob = block + Real(p.length) * vec(std::sin(phi), -std::cos(phi));
  const Real track = p.block_mass * Real(p.gravity) + pull * std::cos(phi);
  return {.positions = {block.cast<double>(), bob.cast<double>()},
          .forces = {static_cast<double>(pull), static_cast<double>(track)}};
}

Observed<2> observed(BlockAndBob built) {
  return {std::move(built.scene), [block = built.block, bob = built.bob, track = built.track,
                                   rod = built.rod](const Sample<2>& sample) {
            return Observation<2>{.positions = {sample.position(block), sample.position(bob)},
                                  .forces = {-sample.multiplier(rod), sample.multiplier(track)}};
          }};
}

}  // namespace

BlockAndBob SlidingPivot::scene() const {
  BlockAndBob built{.scene = Scene<2>("sliding-pivot"), .block = {}, .bob = {}, .track = {}, .rod = {}};
  built.scene.add(UniformGravity<2>{{0.0, -gravity}});
  built.block = built.scene.add_particle({.mass = block_mass});
  built.bob = built.scene.add_particle(
      {.mass = bob_mass, .position = length * Vec<2>(std::sin(angle), -std::cos(angle))});
  built.track = built.scene.add(OnCurve{built.block, Plane<2>{}});
  built.rod = built.scene.add(Distance{built.block, built.bob, length});
  return built;
}

std::vector<Observation<2>> SlidingPivot::reference(std::span<const double> times) const {
  const auto equations = [this](const State& y, State& y_rate) {  // y = (phi, phi')
    const Real phi = y[0];
    y_rate[0] = y[1];
    y_rate[1] = -std::sin(phi) * (gravity + tension(*this, phi, y[1]) / block_mass * std::cos(phi)) / length;
  };
  std::vector<Observation<2>> seen;
  integrate(equations, State{angle, 0}, times,
            [&](const State& y) { seen.push_back(observation(*this, y)); });
  return seen;
}

Observation<2> SlidingPivot::reference(double t) const { return reference(std::array{t}).front(); }

double SlidingPivot::period() const {
  const Real ratio = Real(bob_mass) / block_mass, k = std::sin(Real(angle) / 2);
  const auto integrand = [&](Real u) {
    const Real half_sine = k * std::sin(u), half_cosine_squared = 1 - half_sine * half_sine;
    const Real sine_squared = 4 * half_sine * half_sine * half_cosine_squared;
    return std::sqrt((1 + ratio * sine_squared) / half_cosine_squared);
  };
  // Periodic and smooth: the trapezoidal rule converges exponentially.
  const Real quarter =
      boost::math::quadrature::trapezoidal(integrand, Real(0), std::numbers::pi_v<Real> / 2, Real(1e-16L));
  return static_cast<double>(4 * quarter / std::sqrt(gravity / Real(length) * (1 + ratio)));
}

Model<2> SlidingPivot::model() const {
  return {.name = "sliding-pivot",
          .notes = "mex24, mex233",
          .reference = "equation of motion of the angle in extended precision, forces by Newton's law",
          .t_end = 10.0,
          .length = length,
          .force = (block_mass + bob_mass) * gravity,
          .energy = bob_mass * gravity * length,
          .scene = [*this] { return observed(scene()); },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
