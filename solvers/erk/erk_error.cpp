#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/runge_kutta.h>

#include <cmath>
#include <limits>

namespace dalembert {

namespace {

/// Newton's iteration converges if over its first step the gradients change by no more than this part
/// (Kantorovich); after a step of the method they change by the part that its error is of their radius.
constexpr double most_turned = 0.5;

using Four = std::array<detail::Pair, 2>;

/// By stages the weights of the null rules, and of the error of order 7.
constexpr auto estimating = [] {
  std::array<Four, verner87.stages> weights{};
  for (std::size_t j = 0; j < weights.size(); ++j)
    weights[j] = {detail::Pair{null_rules.third[j], null_rules.fourth[j]},
                  detail::Pair{null_rules.sixth[j], verner87.d[j]}};
  return weights;
}();

/// By which a combination of stages amplifies what each has of its own by chance.
double amplification(const std::array<double, verner87.stages>& weights) {
  double square = 0.0;
  for (const double w : weights) square += w * w;
  return std::sqrt(square);
}

const double of_step = amplification(verner87.b), of_estimate = amplification(verner87.d);  // 49 and 32

/// The error of a step whose length h is no longer small against the distance to a singularity of the motion,
/// in complex time: as of a force that quickens towards its centre. All orders count there, and their sum in
/// one difference may vanish: that of order 7 does at half the distance. Two lower ones, whose ratio tells h
/// over the distance, carry what is left of order 6 on to the error:
///
///   e = quickening E6 (E4/E3)^3. (1)
///
/// In steps by 0.15 to 0.7 of the distance of motions (1 - t)^p, p = 0.2 to 0.9, as of forces c/r^n, the true
/// error is 20 to 58 times E6 (E4/E3)^3 (test Verner87.NullRulesTellTheErrorNearASingularity). Where h is
/// short (1) is of order 10, and does not count.
double near_singularity(double e3, double e4, double e6) {
  if (e3 == 0.0) return 0.0;
  const double ratio = std::min(e4 / e3, 1.0);
  return constants.quickening * e6 * ratio * ratio * ratio;
}

}  // namespace

/// The weight of an error in each position and velocity against `allowed` at a state; of a step, below the
/// round-off in what estimates its error, which would be the same in a shorter one, none counts.
void ErkStepper::RungeKutta::weigh(const Node& at, double step, double allowed) {
  const double of_stages = constants.roundings_of_step * of_estimate * step;
  for (std::size_t i = 0; i < n; ++i) {
    const double of_velocity = of_stages * round_off.of_acceleration(i);
    const double of_projection = constants.roundings_of_step / lengths[i];
    weight[i] = 1.0 / (scales.position_error(i, at.q()[i], allowed) + of_velocity * step +
                       of_projection * round_off.of_positions());
    weight[n + i] = 1.0 / (scales.velocity_error(i, at.v()[i], allowed) + of_velocity +
                           of_projection * round_off.of_velocities());
  }
}

void ErkStepper::RungeKutta::adopt(const PathExtent& extent) {
  scales.adopt(extent);
  for (std::size_t i = 0; i < n; ++i) lengths[i] = scales.is_angle[i] ? scales.length : 1.0;
}

/// Of a sum over positions and velocities.
double ErkStepper::RungeKutta::root_mean(double sum) const {
  return std::sqrt(sum / static_cast<double>(difference.size()));
}

/// Weighted root mean square of `difference`.
double ErkStepper::RungeKutta::weighted_norm() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < difference.size(); ++i) {
    const double e = difference[i] * weight[i];
    sum += e * e;
  }
  return root_mean(sum);
}

/// The sizes of the null rules of a step, and that of its error of order 7, which stays in `difference`.
std::array<double, 4> ErkStepper::RungeKutta::estimates(double step) {
  std::array<Four, Stages::count> c;
  for (std::size_t j = 0; j < Stages::count; ++j) c[j] = {step * estimating[j][0], step * estimating[j][1]};
  Four squares{};
  for (std::size_t i = 0; i < difference.size(); ++i) {
    Four e{};
    for (std::size_t j = 0; j < Stages::count; ++j)
      for (std::size_t half : {0U, 1U}) e[half] += c[j][half] * stages.derivatives()[j][i];
    for (std::size_t half : {0U, 1U}) squares[half] += (e[half] * weight[i]) * (e[half] * weight[i]);
    difference[i] = e[1][1];
  }
  return {root_mean(squares[0][0]), root_mean(squares[0][1]), root_mean(squares[1][0]),
          root_mean(squares[1][1])};
}

/// The estimated error of a step to `next` over the tolerance, or where the estimate is doubtful over a part
/// of it.
double ErkStepper::RungeKutta::error(double step, double doubt) {
  if (scales.length_from_path) adopt(scales.extended_by(next.q(), next.v(), step, tolerance));
  weigh(next, step, tolerance / doubt);
  const auto [e3, e4, e6, e7] = estimates(step);
  const double series = near_singularity(e3, e4, std::hypot(e6, e7 / of_estimate));
  const double e = std::max({e7, series, doubt * error_of_compliant_forces(std::span(difference).first(n))});
  if (e <= 1.0) estimate(step, e7 > 0.0 ? series / e7 : 0.0);
  if (doubt != 1.0) weigh(next, step, tolerance);
  return e;
}

/// What `difference`, the error of order 7, says of a step's error, and round-off does to it: the stages' own
/// velocities are rounded, their accelerations at least so. The step, of order 8, errs by less, by its eighth
/// root if the error constants are 1 in the scene's units, but by no less than `of_order_8` times that.
void ErkStepper::RungeKutta::estimate(double step, double of_order_8) {
  estimated = {.position_noise = round_off.of_positions(),
               .velocity_noise = round_off.of_velocities(),
               .late = (next.t - to.t) - step};
  for (std::size_t i = 0; i < n; ++i) {
    const double length = lengths[i];
    estimated.position = std::max(estimated.position, std::abs(difference[i]) * length);
    estimated.velocity = std::max(estimated.velocity, std::abs(difference[n + i]) * length);
    const double of_stages = of_step * step * length, of_sum = epsilon * length;
    estimated.position_noise = std::max({estimated.position_noise, of_sum * std::abs(next.q()[i]),
                                         epsilon * of_stages * std::abs(next.v()[i])});
    estimated.velocity_noise =
        std::max(estimated.velocity_noise,
                 of_stages * std::max(round_off.of_acceleration(i), epsilon * std::abs(next.a()[i])));
  }
  const double of_order_7 = std::max(estimated.position / scales.length, estimated.velocity / scales.speed());
  const double less = std::max(std::pow(std::min(of_order_7, 1.0), 1.0 / pair.order), of_order_8);
  estimated.position *= less;
  estimated.velocity *= less;
}

/// A compliant constraint multiplies errors of position by its stiffness: its force w dq/C is to be as
/// accurate, relative to the force that moves its masses by the scene's length in the scene's time; up to
/// round-off.
double ErkStepper::RungeKutta::error_of_compliant_forces(std::span<const double> dq) const {
  if (force_of_spring.empty()) return 0.0;
  const double rounding = scales.rounding(next.q());
  double most = 0.0;
  for (std::size_t r = 0; r < force_of_spring.size(); ++r) {
    if (force_of_spring[r] == 0.0) continue;
    double stretch = 0.0, gradient = 0.0;
    for (const std::size_t j : system->row(r)) {
      stretch += manifold.equations().w[j] * dq[system->w_columns()[j]];
      gradient = std::max(gradient, std::abs(manifold.equations().w[j]));
    }
    const double allowed = system->law(r).compliance * tolerance * force_of_spring[r] + gradient * rounding;
    most = std::max(most, std::abs(stretch) / allowed);
  }
  return most;
}

/// Projects `next` onto the constraint manifold. Returns the correction over the tolerance; infinite where
/// one step of Newton's does not say where the manifold is: a state beyond the apex of a cone is moved onto
/// it.
double ErkStepper::RungeKutta::project() {
  const auto [dq, dv] = halves(difference);
  const auto q = next.q(), v = next.v();
  for (std::size_t i = 0; i < n; ++i) {
    dq[i] = -q[i];
    dv[i] = -v[i];
  }
  require(manifold.project(next.t, q, v, next.a()));
  if (manifold.turned() > most_turned) return std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    dq[i] += q[i];
    dv[i] += v[i];
  }
  return weighted_norm();
}

/// The difference of the derivatives of the last stage and of those at the end of a step, times the step, as
/// a fraction of the scene's size.
double ErkStepper::RungeKutta::disagreement(double step) {
  for (std::size_t i = 0; i < difference.size(); ++i)
    difference[i] = step * (stages.derivatives().back()[i] - next.x[n + i]);
  return tolerance * weighted_norm();
}

}  // namespace dalembert
