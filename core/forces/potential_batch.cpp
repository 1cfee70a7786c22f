#include "dalembert/core/forces/potential_batch.h"

#include <dalembert/core/equations/scratch.h>

#include <algorithm>

namespace dalembert {

std::unique_ptr<ForceBatch> PotentialBatch::clone() const { return std::make_unique<PotentialBatch>(*this); }

void PotentialBatch::add_force(const Instant& at, const Multipliers& /*lambda*/, std::span<double> F) const {
  constexpr std::size_t most = 8;
  const auto width = static_cast<std::size_t>(type_->shape.width);
  detail::Scratch room(detail::Scratch::size_of<double>(most * width));
  const std::span V_q(room.take<double>(most * width), most * width);
  double V[most], rate[most];
  for (std::size_t first = 0; first < size(); first += most) {
    const std::size_t count = std::min(most, size() - first);
    energies_.evaluate(at, first, first + count, {.g = {V, count}, .psi = {rate, count}, .w = V_q});
    const int* place = coordinates().data() + first * width;
    for (std::size_t k = 0; k < count * width; ++k) F[static_cast<std::size_t>(place[k])] -= V_q[k];
  }
}

void PotentialBatch::power(const Instant& at, const Multipliers& /*lambda*/, std::span<double> out) const {
  const auto width = static_cast<std::size_t>(type_->shape.width);
  std::vector<double> V_q(width);
  for (std::size_t i = 0; i < size(); ++i) {
    double V = 0.0, rate = 0.0;
    energies_.evaluate(at, i, i + 1, {.g = {&V, 1}, .psi = {&rate, 1}, .w = V_q});
    out[i] = 0.0;
    const auto own = energies_.elements().coordinates(i);
    for (std::size_t k = 0; k < width; ++k) out[i] -= V_q[k] * at.v[static_cast<std::size_t>(own[k])];
  }
}

void PotentialBatch::linearise(const Instant& at, const Multipliers& /*lambda*/, std::span<double> stiffness,
                               std::span<double> /*damping*/) const {
  detail::Scratch room(detail::Scratch::size_of<double>(size()));
  double* const against = room.take<double>(size());
  std::fill_n(against, size(), -1.0);
  energies_.linearise(at, 0, size(), against, nullptr, stiffness.data());
}

void PotentialBatch::force(std::size_t element, const Instant& at, std::span<const double> /*lambda*/,
                           std::span<double> out) const {
  double V = 0.0, rate = 0.0;
  energies_.evaluate(at, element, element + 1, {.g = {&V, 1}, .psi = {&rate, 1}, .w = out});
  for (double& x : out) x = -x;
}

double PotentialBatch::energy(const Instant& at) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    double V = 0.0, rate = 0.0;
    energies_.evaluate(at, i, i + 1, {.g = {&V, 1}, .psi = {&rate, 1}});
    sum += V;
  }
  return sum;
}

}  // namespace dalembert
