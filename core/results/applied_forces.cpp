#include "dalembert/core/results/applied_forces.h"

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

std::span<const int> coordinates(const AppliedForces::Place& place) {
  const auto width = static_cast<std::size_t>(place.batch->shape().width);
  return place.batch->coordinates().subspan(place.element * width, width);
}

/// Adds up the entries that act on each coordinate from `first` on.
void gather(std::span<const int> coordinates, std::span<const double> force, int first,
            std::span<double> out) {
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const int place = coordinates[k] - first;
    if (place >= 0 && place < static_cast<int>(out.size())) out[static_cast<std::size_t>(place)] += force[k];
  }
}

}  // namespace

bool AppliedForces::evaluate(const Place& place, const Instant& at, std::span<const double> lambda,
                             std::vector<double>& force) {
  const ForceShape shape = place.batch->shape();
  const auto read = shape.rows > 0 ? lambda.subspan(place.first_row, static_cast<std::size_t>(shape.rows))
                                   : std::span<const double>();
  if (std::ranges::any_of(read, [](double x) { return std::isnan(x); })) return false;
  force.resize(static_cast<std::size_t>(shape.width));
  place.batch->force(place.element, at, read, force);
  return true;
}

bool AppliedForces::on(std::size_t number, const Instant& at, std::span<const double> lambda, int first,
                       double mass, std::span<double> out) const {
  const Place& place = places_[number];
  std::ranges::fill(out, 0.0);
  if (place.batch == nullptr) {
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = mass * place.acceleration[k];
    return true;
  }
  std::vector<double> force;
  if (!evaluate(place, at, lambda, force)) return false;
  gather(coordinates(place), force, first, out);
  return true;
}

void AppliedForces::raise_to_sizes(const Instant& at, std::span<const double> lambda,
                                   std::span<double> to) const {
  std::vector<double> force;
  for (const Place& place : places_) {
    if (place.batch == nullptr || !evaluate(place, at, lambda, force)) continue;
    const auto on = coordinates(place);
    for (std::size_t k = 0; k < on.size(); ++k) {
      double& its = to[static_cast<std::size_t>(on[k])];
      its = std::max(its, std::abs(force[k]));
    }
  }
}

}  // namespace dalembert
