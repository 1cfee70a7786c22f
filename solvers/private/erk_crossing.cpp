#include <dalembert/solvers/private/erk_state.h>
#include <dalembert/solvers/private/hermite.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// A singular position is where the angle falls to this part of what it was at the last node, or less: far
/// below what a passage at a distance shows, far above what the extrapolated state is good for.
constexpr double vanished = 1e-3;

/// Where the parabola through three points has its least value; false if it has none.
bool least_of_parabola(const std::array<Angle, 3>& at, double& t) {
  const auto pivot = [&](std::size_t i) { return at[i].sine * at[i].sine; };
  const double d01 = (pivot(1) - pivot(0)) / (at[1].t - at[0].t);
  const double d12 = (pivot(2) - pivot(1)) / (at[2].t - at[1].t);
  const double curvature = (d12 - d01) / (at[2].t - at[0].t);
  t = 0.5 * (at[0].t + at[1].t) - 0.5 * d01 / curvature;
  return curvature > 0.0;
}

}  // namespace

/// Where constraints become dependent for an instant, sin ~ |t - t*|, the motion is smooth but the
/// accelerations computed from a state that is off the constraints by e are wrong by e/sin^2, and no step
/// with stages close to t* is accurate. So the position is passed on the polynomial through q, q', q'' of the
/// last nodes (degree 11 with four), to the mirror image of the last one beyond t*, and back onto the
/// constraints there. Steps towards t* go at most half of the way, and with each the error of the polynomial
/// falls by 2^12; it is known from the polynomial through one node less.
ErkStepper::State::Crossing ErkStepper::State::cross() {
  if (steps == 0) return Crossing::none;
  const double left = time_to_singular(from.angle(), to.angle());
  if (h <= 0.5 * left) return Crossing::none;
  try {
    double singular = to.t + left;
    if (!find_singular(singular)) return Crossing::none;
    if (steps >= 2 && pass(singular)) return Crossing::passed;
    h = std::min(h, 0.5 * (singular - to.t));
  } catch (const EquationFault& error) {
    fault = error.what();
    h = std::min(h, 0.5 * left);
  }
  return Crossing::ahead;
}

/// Improves the time at which the constraints become dependent on the extrapolated motion. False if they do
/// not: if they come close only.
bool ErkStepper::State::find_singular(double& t) {
  constexpr int attempts = 4;
  const auto nodes = static_cast<std::size_t>(std::min(steps + 1, 4L));
  std::array<Angle, 3> at{from.angle(), to.angle(), {t, 0.0}};
  const double until = to.t + 4.0 * (t - to.t);
  for (int i = 0; i < attempts; ++i) {
    extrapolate(nodes, t, middle);
    at[2] = {t, manifold.sine({t, middle.q, halves(middle.va).first})};
    if (at[2].sine <= vanished * to.sine) return true;
    if (!least_of_parabola(at, t) || !(t > to.t && t < until) || t == at[2].t) return false;
    if (i > 0) at[0] = at[1];
    at[1] = at[2];
  }
  return false;
}

bool ErkStepper::State::pass(double singular) {
  const auto nodes = static_cast<std::size_t>(std::min(steps + 1, 4L));
  const double beyond = std::min(2.0 * singular - to.t, t_end);
  extrapolate(nodes, beyond, next);
  extrapolate(nodes - 1, beyond, middle);
  weigh(next);
  for (std::size_t i = 0; i < n; ++i) {
    difference[i] = next.q[i] - middle.q[i];
    difference[n + i] = next.va[i] - middle.va[i];
  }
  // What the constraints there make of an error is larger by 1/sin.
  if (!(size() <= std::min(1.0, to.sine))) return false;
  if (2.0 * singular - to.t <= t_end) {
    if (land() > most_correction) return false;
    next.sine = manifold.sine();
    if (next.sine < 0.5 * to.sine) return false;
  }
  if (beyond > singular) ++singular_positions;
  return true;
}

void ErkStepper::State::extrapolate(std::size_t nodes, double t, Node& out) const {
  const std::array<const Node*, 4> last{&to, &from, &earlier[0], &earlier[1]};
  const auto with = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
    typename Hermite<N>::Values times;
    for (std::size_t j = 0; j < N; ++j) times[j] = last[j]->t;
    const Hermite<N> polynomial(times, t);
    for (std::size_t i = 0; i < n; ++i) {
      typename Hermite<N>::Values q, v, a;
      for (std::size_t j = 0; j < N; ++j) {
        q[j] = last[j]->q[i];
        v[j] = last[j]->va[i];
        a[j] = last[j]->va[n + i];
      }
      const auto x = polynomial(q, v, a);
      out.q[i] = x.value;
      out.va[i] = x.derivative;
      out.va[n + i] = x.second;
    }
    out.t = t;
  };
  if (nodes == 2) with(std::integral_constant<std::size_t, 2>{});
  if (nodes == 3) with(std::integral_constant<std::size_t, 3>{});
  if (nodes == 4) with(std::integral_constant<std::size_t, 4>{});
}

/// Between the nodes on both sides of a singular position.
void ErkStepper::State::read_crossing(double t, std::span<double> q, std::span<double> v) const {
  Node out{t, std::vector<double>(n), std::vector<double>(2 * n)};
  extrapolate(static_cast<std::size_t>(std::min(steps + 1, 4L)), t, out);
  std::ranges::copy(out.q, q.begin());
  std::copy_n(out.va.begin(), n, v.begin());
}

}  // namespace dalembert
