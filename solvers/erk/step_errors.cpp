#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/step_errors.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

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

ErkStepper::StepErrors::StepErrors(const System& system, const Start& start, const Options& options)
    : system_(&system),
      tolerance_(tolerance_of_a_step(Stepper::erk, options.tolerance)),
      scales_(start.scales),
      lengths_(start.scales.lengths()),
      covered_(start.scales.extent),
      round_off_(start.q.size()),
      weight_(2 * start.q.size()),
      of_order_7_(weight_.size()),
      kept_(weight_.size()) {
  if (!system.compliant()) return;
  auto e = system.evaluation();
  system.evaluate({options.t_start, start.q, start.v}, e);
  for (std::size_t r = 0; r < start.lambda.size(); ++r) {
    const double impulse =
        system.law(r).compliant() ? impulse_of_row(system, e.w, lengths_, r, scales_.speed()) : 0.0;
    force_of_spring_.push_back(impulse / scales_.time);
  }
}

void ErkStepper::StepErrors::adopt(const PathExtent& extent) {
  scales_.adopt(extent);
  for (std::size_t i = 0; i < lengths_.size(); ++i) lengths_[i] = scales_.is_angle[i] ? scales_.length : 1.0;
}

/// The weights w at a state, against `allowed`. Of a step by h, below the round-off in what estimates
/// its error, which would be the same in a shorter one, none counts.
void ErkStepper::StepErrors::weigh(const Node& at, double h, double allowed) {
  const std::size_t n = lengths_.size();
  const double of_stages = constants.roundings_of_step * of_estimate * h;
  for (std::size_t i = 0; i < n; ++i) {
    const double of_velocity = of_stages * round_off_.of_acceleration(i);
    const double of_projection = constants.roundings_of_step / lengths_[i];
    weight_[i] = 1.0 / (scales_.position_error(i, at.q()[i], allowed) + of_velocity * h +
                        of_projection * round_off_.of_positions());
    weight_[n + i] = 1.0 / (scales_.velocity_error(i, at.v()[i], allowed) + of_velocity +
                            of_projection * round_off_.of_velocities());
  }
}

/// Of a sum over positions and velocities.
double ErkStepper::StepErrors::root_mean(double sum) const {
  return std::sqrt(sum / static_cast<double>(weight_.size()));
}

template <class Difference>
double ErkStepper::StepErrors::size(const Difference& d) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const double e = d(i) * weight_[i];
    sum += e * e;
  }
  return root_mean(sum);
}

double ErkStepper::StepErrors::distance(const Node& a, const Node& b) {
  weigh(b, 0.0, tolerance_);
  return size([&](std::size_t i) { return b.x[i] - a.x[i]; });
}

void ErkStepper::StepErrors::keep(const Node& node) {
  std::copy_n(node.x.begin(), kept_.size(), kept_.begin());
}

double ErkStepper::StepErrors::moved(const Node& node) const {
  return size([&](std::size_t i) { return node.x[i] - kept_[i]; });
}

double ErkStepper::StepErrors::of_jump(double h, const Node& a, const Node& b) const {
  const std::size_t n = lengths_.size();
  return size([&](std::size_t i) { return i < n ? 0.0 : h * (b.x[n + i] - a.x[n + i]); });
}

double ErkStepper::StepErrors::disagreement(const Step& step) const {
  const double* const last = step.k.back();
  return tolerance_ *
         size([&](std::size_t i) { return step.h * (last[i] - step.end.x[lengths_.size() + i]); });
}

/// The sizes of the null rules of a step, and that of its error of order 7.
std::array<double, 4> ErkStepper::StepErrors::estimates(const Step& step) {
  std::array<Four, Stages::count> c;
  for (std::size_t j = 0; j < c.size(); ++j) c[j] = {step.h * estimating[j][0], step.h * estimating[j][1]};
  Four squares{};
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    Four e{};
    for (std::size_t j = 0; j < c.size(); ++j)
      for (std::size_t half : {0U, 1U}) e[half] += c[j][half] * step.k[j][i];
    for (std::size_t half : {0U, 1U}) squares[half] += (e[half] * weight_[i]) * (e[half] * weight_[i]);
    of_order_7_[i] = e[1][1];
  }
  return {root_mean(squares[0][0]), root_mean(squares[0][1]), root_mean(squares[1][0]),
          root_mean(squares[1][1])};
}

double ErkStepper::StepErrors::error(const Step& step, double doubt, const System::Evaluation& equations) {
  if (scales_.length_from_path) adopt(scales_.extended_by(step.end.q(), step.end.v(), step.h, tolerance_));
  weigh(step.end, step.h, tolerance_ / doubt);
  const auto [e3, e4, e6, e7] = estimates(step);
  const double series = near_singularity(e3, e4, std::hypot(e6, e7 / of_estimate));
  const double e = std::max({e7, series, doubt * error_of_compliant_forces(step.end, equations)});
  if (e <= 1.0) estimate(step, e7 > 0.0 ? series / e7 : 0.0);
  if (doubt != 1.0) weigh(step.end, step.h, tolerance_);
  return e;
}

/// What the error of order 7 says of a step's error, and round-off does to it: the stages' own velocities are
/// rounded, their accelerations at least so. The step, of order 8, errs by less, by its eighth root if the
/// error constants are 1 in the scene's units, but by no less than `of_order_8` times that.
void ErkStepper::StepErrors::estimate(const Step& step, double of_order_8) {
  const std::size_t n = lengths_.size();
  const Node& end = step.end;
  estimated_ = {.position_noise = round_off_.of_positions(),
                .velocity_noise = round_off_.of_velocities(),
                .late = (end.t - step.start.t) - step.h};
  for (std::size_t i = 0; i < n; ++i) {
    const double length = lengths_[i];
    estimated_.position = std::max(estimated_.position, std::abs(of_order_7_[i]) * length);
    estimated_.velocity = std::max(estimated_.velocity, std::abs(of_order_7_[n + i]) * length);
    const double of_stages = of_step * step.h * length, of_sum = epsilon * length;
    estimated_.position_noise = std::max({estimated_.position_noise, of_sum * std::abs(end.q()[i]),
                                          epsilon * of_stages * std::abs(end.v()[i])});
    estimated_.velocity_noise =
        std::max(estimated_.velocity_noise,
                 of_stages * std::max(round_off_.of_acceleration(i), epsilon * std::abs(end.a()[i])));
  }
  const double of_order_7 =
      std::max(estimated_.position / scales_.length, estimated_.velocity / scales_.speed());
  const double less = std::max(std::pow(std::min(of_order_7, 1.0), 1.0 / Stages::pair.order), of_order_8);
  estimated_.position *= less;
  estimated_.velocity *= less;
}

/// A compliant constraint multiplies errors of position by its stiffness: its force w dq/C is to be as
/// accurate, relative to the force that moves its masses by the scene's length in the scene's time; up to
/// round-off.
double ErkStepper::StepErrors::error_of_compliant_forces(const Node& end,
                                                         const System::Evaluation& equations) const {
  if (force_of_spring_.empty()) return 0.0;
  const double rounding = scales_.rounding(end.q());
  double most = 0.0;
  for (std::size_t r = 0; r < force_of_spring_.size(); ++r) {
    if (force_of_spring_[r] == 0.0) continue;
    double stretch = 0.0, gradient = 0.0;
    for (const std::size_t j : system_->row(r)) {
      stretch += equations.w[j] * of_order_7_[system_->w_columns()[j]];
      gradient = std::max(gradient, std::abs(equations.w[j]));
    }
    const double allowed =
        system_->law(r).compliance * tolerance_ * force_of_spring_[r] + gradient * rounding;
    most = std::max(most, std::abs(stretch) / allowed);
  }
  return most;
}

}  // namespace dalembert
