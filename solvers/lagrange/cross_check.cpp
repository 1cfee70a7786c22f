#include "dalembert/solvers/lagrange/cross_check.h"

#include <dalembert/solvers/base/accuracy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

namespace dalembert {

std::string CrossCheck::report() const {
  std::ostringstream text;
  text.precision(3);
  const auto line = [&](const char* what, const Difference& d) {
    text << what << " differ by " << d.largest << ", " << d.relative() << " of " << d.unit;
    if (!d.where.empty()) text << ", at t = " << d.time << " of \"" << d.where << '"';
    text << '\n';
  };
  line("positions", position);
  line("velocities", velocity);
  line("forces of constraint", force);
  text << "at " << states << " random states:\n";
  line("positions of the embedding and of the constraints", embedded);
  line("accelerations", acceleration);
  line("forces of constraint", reaction);
  return text.str();
}

namespace detail {

std::vector<double> random_numbers(std::size_t count) {
  std::mt19937 generator(1);
  std::vector<double> x(count);
  for (double& each : x) each = static_cast<double>(generator()) / 2147483648.0 - 1.0;
  return x;
}

namespace {

std::string name_at(const Layout& layout, std::size_t coordinate) {
  const int i = static_cast<int>(coordinate);
  if (const auto* particle = layout.particle_at(i)) return particle->name;
  for (const auto& rotor : layout.rotors)
    if (rotor.coordinate == i) return rotor.name;
  return {};
}

}  // namespace

Comparison::Comparison(const System& system, const Statistics& statistics)
    : system_(&system), length_(system.coordinates(), 1.0), sum_(system.coordinates()) {
  const double length = statistics.length;
  for (const auto& rotor : system.layout()->rotors)
    length_[static_cast<std::size_t>(rotor.coordinate)] = length;
  for (Difference* d : {&found_.position, &found_.velocity, &found_.force, &found_.embedded,
                        &found_.acceleration, &found_.reaction})
    d->largest = std::numeric_limits<double>::quiet_NaN();
  found_.position.unit = found_.embedded.unit = length;
  found_.velocity.unit = statistics.time > 0.0 ? length / statistics.time : 0.0;
}

/// Angles count as lengths, torques as forces. What a run does not determine is not compared.
void Comparison::compare(double time, std::span<const double> a, std::span<const double> b, bool of_force,
                         Difference& found) const {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double unit = of_force ? 1.0 / length_[i] : length_[i];
    const double off = std::abs(a[i] - b[i]) * unit;
    if (std::isnan(off) || off <= found.largest) continue;  // largest is no number before the first
    found.largest = off;
    found.time = time;
    found.where = name_at(*system_->layout(), i);
  }
}

void Comparison::compare_forces(const FlatSample& sample, std::span<const double> Z, Difference& found) {
  const Layout& layout = *system_->layout();
  std::ranges::fill(sum_, 0.0);
  for (std::size_t slot = 0; slot < layout.slot_coordinate.size(); ++slot)
    sum_[static_cast<std::size_t>(layout.slot_coordinate[slot])] += sample.forces[slot];
  auto e = system_->evaluation();
  system_->evaluate({sample.time, sample.q, sample.v}, e);
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    for (const double force : {sum_[i], e.force[i]})
      if (std::isfinite(force)) found.unit = std::max(found.unit, std::abs(force) / length_[i]);
  }
  compare(sample.time, sum_, Z, true, found);
}

void Comparison::add(const FlatSample& sample, std::span<const double> q, std::span<const double> v,
                     std::span<const double> Z) {
  for (std::size_t i = 0; i < sum_.size(); ++i)
    found_.velocity.unit = std::max(found_.velocity.unit, std::abs(sample.v[i]) * length_[i]);
  compare(sample.time, sample.q, q, false, found_.position);
  compare(sample.time, sample.v, v, false, found_.velocity);
  compare_forces(sample, Z, found_.force);
}

void Comparison::add_state(const FlatSample& sample, std::span<const double> q, std::span<const double> a,
                           std::span<const double> Z) {
  ++found_.states;
  for (std::size_t i = 0; i < a.size(); ++i)
    found_.acceleration.unit = std::max(found_.acceleration.unit, std::abs(a[i]) * length_[i]);
  compare(sample.time, sample.q, q, false, found_.embedded);
  compare(sample.time, sample.a, a, false, found_.acceleration);
  compare_forces(sample, Z, found_.reaction);
}

void Comparison::require_same_start() const {
  for (const Difference* d : {&found_.position, &found_.velocity}) {
    if (d->relative() <= start_tolerance) continue;
    std::ostringstream what;
    what << "Scene \"" << system_->layout()->scene << "\" and the Lagrangian do not begin in the same state: "
         << (d == &found_.position ? "positions" : "velocities") << " of \"" << d->where << "\" differ by "
         << d->largest << "; correct one of them, or the embedding";
    throw InvalidArgument(what.str());
  }
}

}  // namespace detail

}  // namespace dalembert
