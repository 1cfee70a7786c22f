#include "dalembert/solvers/equilibrium/work_of_laws.h"

#include <dalembert/core/errors.h>

#include <cmath>
#include <span>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;

/// A u.
Vector turned(const RotatingFrame& frame, const Vector& u) {
  Vector out(u.size());
  frame.apply(flat(u), flat(out));
  return out;
}

}  // namespace

Work& Work::operator+=(const Work& more) {
  power += more.power;
  power_terms += more.power_terms;
  circulation += more.circulation;
  circulation_terms += more.circulation_terms;
  return *this;
}

void WorkOfLaws::OnPart::add(const Work& work, const Force& by) {
  sum += work;
  if (work.power > most) {
    most = work.power;
    drives = by;
  }
  if (work.power < least) {
    least = work.power;
    brakes = by;
  }
  if (std::abs(work.circulation) > most_circulation) {
    most_circulation = std::abs(work.circulation);
    circulates = by;
  }
}

WorkOfLaws::WorkOfLaws(const System& system, const Islands& parts, const RotatingFrame& frame, Vector units)
    : system_(&system), parts_(&parts), frame_(&frame), units_(std::move(units)) {
  for (std::size_t b = 0; b < system.forces().plain().size(); ++b)
    if (const ForceShape shape = system.forces().batch(b).shape(); !shape.conservative && shape.width > 0)
      laws_.push_back(b);
}

std::vector<char> WorkOfLaws::parts() const {
  std::vector<char> acted_on(parts_->count, 0);
  for (const std::size_t b : laws_)
    for (const int i : system_->forces().batch(b).coordinates())
      acted_on[parts_->of_coordinate[static_cast<std::size_t>(i)]] = 1;
  return acted_on;
}

/// Of all coordinates, and what they make of the forces of one batch.
struct WorkOfLaws::Velocities {
  const RelativeState& s;
  const Vector &units, u_turned, other_turned;
  Instant moving, reference;

  /// Of a force on these coordinates, with its blocks T = F_q + F_v A.
  [[nodiscard]] Work of(const ForceBatch& batch, std::size_t element, std::span<const double> F_q,
                        std::span<const double> F_v) const {
    const auto width = static_cast<std::size_t>(batch.shape().width);
    const auto own = batch.coordinates().subspan(element * width, width);
    std::vector<double> with(width), without(width);
    batch.force(element, moving, {}, with);
    batch.force(element, reference, {}, without);
    Work work;
    for (std::size_t i = 0; i < width; ++i) {
      const double a = s.u[own[i]], b = s.other[own[i]];
      double terms = std::abs(with[i]) + std::abs(without[i]);
      for (std::size_t j = 0; j < width; ++j) {
        const double k = F_q[i * width + j], d = F_v.empty() ? 0.0 : F_v[i * width + j];
        const double of_u = k * s.u[own[j]] + d * u_turned[own[j]],
                     of_other = k * s.other[own[j]] + d * other_turned[own[j]];
        work.circulation += b * of_u - a * of_other;
        work.circulation_terms += std::abs(b * of_u) + std::abs(a * of_other);
        terms += std::abs(k) * units[own[j]] + std::abs(d * s.u[own[j]]);
      }
      work.power += a * (with[i] - without[i]);
      work.power_terms += std::abs(a) * terms;
    }
    return work;
  }
};

std::vector<WorkOfLaws::OnPart> WorkOfLaws::at(double t, const RelativeState& s,
                                               const std::vector<char>& only_odd) const {
  const Vector v = s.frame + s.u, u_turned = turned(*frame_, s.u), other_turned = turned(*frame_, s.other);
  Vector reference = s.frame;
  for (Index i = 0; i < v.size(); ++i)
    if (only_odd[parts_->of_coordinate[static_cast<std::size_t>(i)]]) reference[i] -= s.u[i];
  const Velocities velocities{
      s, units_, u_turned, other_turned, {t, flat(s.q), flat(v)}, {t, flat(s.q), flat(reference)}};
  std::vector<OnPart> all(parts_->count);
  for (const std::size_t b : laws_) {
    const ForceBatch& batch = system_->forces().batch(b);
    const auto width = static_cast<std::size_t>(batch.shape().width), block = width * width;
    std::vector<double> F_q(batch.size() * block), F_v(batch.shape().dissipative ? F_q.size() : 0);
    try {
      batch.linearise({t, flat(s.q), flat(s.frame)}, {}, F_q, F_v);
      for (std::size_t e = 0; e < batch.size(); ++e) {
        const auto first = static_cast<std::size_t>(batch.coordinates()[e * width]);
        const auto own_v = std::span(std::as_const(F_v)).subspan(F_v.empty() ? 0 : e * block);
        all[parts_->of_coordinate[first]].add(
            velocities.of(batch, e, std::span(std::as_const(F_q)).subspan(e * block), own_v), {b, e});
      }
    } catch (const ElementFault& fault) {
      throw detail::named(fault, system_->forces().label(b, fault.element), t);
    }
  }
  return all;
}

}  // namespace dalembert
