#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/erk.h>
#include <dalembert/solvers/run/singularity.h>
#include <dalembert/solvers/run/switches.h>

#include <cstddef>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// An instant between two steps: positions, velocities and accelerations in one piece, of which a step moves
/// the first two thirds by the last two.
struct ErkStepper::Node {
  double t = 0.0;
  std::vector<double> x;
  double sine = 1.0;  // see Manifold,
  long rows = 0;      // of those in use after so many exchanges
  Slope side{};       // of friction laws; unset if there are none

  [[nodiscard]] std::span<const double> q() const { return std::span(x).first(n()); }
  [[nodiscard]] std::span<const double> v() const { return std::span(x).subspan(n(), n()); }
  [[nodiscard]] std::span<const double> a() const { return std::span(x).subspan(2 * n(), n()); }
  [[nodiscard]] std::span<double> q() { return std::span(x).first(n()); }
  [[nodiscard]] std::span<double> v() { return std::span(x).subspan(n(), n()); }
  [[nodiscard]] std::span<double> a() { return std::span(x).subspan(2 * n(), n()); }
  [[nodiscard]] Instant instant() const { return {t, q(), v()}; }
  [[nodiscard]] Angle angle() const { return {t, sine}; }

 private:
  [[nodiscard]] std::size_t n() const { return x.size() / 3; }
};

}  // namespace dalembert
