#include "dalembert/solvers/private/erk.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/private/combination.h>
#include <dalembert/solvers/private/hermite.h>
#include <dalembert/solvers/private/manifold.h>
#include <dalembert/solvers/private/verner.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dalembert {

namespace {

constexpr auto& pair = verner87;
constexpr int stages = pair.stages;

// Step control as in Hairer, Norsett, Wanner, Solving ODEs I, II.4. With the usual safety of 0.9 a
// quarter of the steps of a pendulum are repeated; 0.8 takes a sixth less time.
constexpr double safety = 0.8;
constexpr double most_growth = 6.0;
constexpr double most_shrinking = 0.2;
constexpr double after_fault = 0.25;

/// Steps of h rho beyond this are held down by stability: |R(iy)| exceeds 1 by a thousandth at
/// y = 3.3, by a twentieth at 4.4, and |R(-x)| exceeds 1 at x = 5.9 (from the table of the pair).
constexpr double stable = 3.3;
constexpr long stability_check_interval = 8;

/// A step goes back onto the constraints by about as much as it errs. One that has to be moved by more
/// than this many times the tolerance went wrong: over a jump of a driven point, or onto another branch.
constexpr double most_correction = 10.0;

/// The 13th stage serves the error estimate only.
constexpr std::size_t last_stage_of_step = stages - 2;

std::vector<Combination<stages>> rows_of_table() {
  std::vector<Combination<stages>> rows;
  for (const auto& row : pair.a) rows.emplace_back(row);
  return rows;
}

/// Of the stages 12 and 13, both at t + h.
std::array<double, stages> difference_of_last_rows() {
  std::array<double, stages> d{};
  for (std::size_t j = 0; j < d.size(); ++j) d[j] = pair.a[12][j] - pair.a[11][j];
  return d;
}

}  // namespace

struct ErkStepper::State {
  State(const System& system, const Start& start, const Options& options);

  /// An instant between two steps: positions, and velocities and accelerations in one piece, as the
  /// first stage of the next step.
  struct Node {
    double t = 0.0;
    std::vector<double> q, va;
  };

  /// Velocities and accelerations.
  [[nodiscard]] std::pair<std::span<double>, std::span<double>> halves(std::vector<double>& x) const {
    return {std::span(x).first(n), std::span(x).subspan(n)};
  }
  static void require(bool regular);
  void run_stages(const Node& start, double step, std::size_t last);
  void finish(const Node& start, double step, Node& end) const;
  [[nodiscard]] double size(std::span<const double> dq, std::span<const double> dv, const Node& at) const;
  [[nodiscard]] double error(const Node& end, double step);
  [[nodiscard]] double land();
  [[nodiscard]] double attempt(double step);
  void watch_stability(double step);
  [[nodiscard]] double shorter(double step, double factor) const;
  [[nodiscard]] double step_towards(double wanted) const;
  void find_middle();

  std::size_t n;
  Scales scales;
  double tolerance, t_end;
  Manifold manifold;
  std::vector<Combination<stages>> a = rows_of_table();
  Combination<stages> b{pair.b}, d{pair.d}, last_difference{difference_of_last_rows()};
  Node from, to;  // the last step; before the first, both are the start
  Node middle;    // of that step, if `has_middle`
  bool has_middle = false;
  Node next;  // where a step goes until it is accepted
  std::array<std::vector<double>, stages> stage;
  std::array<const double*, stages> k{};
  std::vector<double> stage_q, difference;  // work
  double h;
  long steps = 0, failures = 0, stability_limited = 0;
  std::string fault;  // of the last attempt that failed
};

ErkStepper::State::State(const System& system, const Start& start, const Options& options)
    : n(start.q.size()),
      scales(start.scales),
      tolerance(options.tolerance),
      t_end(options.t_end),
      manifold(system, start.rows, start.scales.lever()),
      stage_q(start.q.size()),
      difference(2 * start.q.size()),
      // A third of the step that an error constant of 1 allows.
      h(std::min(0.3 * std::pow(options.tolerance, 1.0 / pair.order) * start.scales.time,
                 options.t_end - options.t_start)) {
  for (Node* node : {&from, &to, &middle, &next}) {
    node->t = options.t_start;
    node->q = start.q;
    node->va = start.v;
    node->va.insert(node->va.end(), start.a.begin(), start.a.end());
  }
  for (std::size_t i = 1; i < stage.size(); ++i) {
    stage[i].resize(2 * n);
    k[i] = stage[i].data();
  }
}

ErkStepper::ErkStepper(const System& system, const Start& start, const Options& options)
    : state_(std::make_unique<State>(system, start, options)) {}
ErkStepper::ErkStepper(ErkStepper&&) noexcept = default;
ErkStepper& ErkStepper::operator=(ErkStepper&&) noexcept = default;
ErkStepper::~ErkStepper() = default;

void ErkStepper::State::require(bool regular) {
  if (!regular) throw EquationFault("the constraints became dependent on each other");
}

/// Stages 2 to `last`: a stage's velocity is written where its derivative is kept.
void ErkStepper::State::run_stages(const Node& start, double step, std::size_t last) {
  k[0] = start.va.data();
  for (std::size_t i = 1; i <= last; ++i) {
    a[i].apply(step, k, 0, start.q.data(), stage_q.data(), n);
    a[i].apply(step, k, n, start.va.data(), stage[i].data(), n);
    const auto [v, v_dot] = halves(stage[i]);
    require(manifold.accelerate({start.t + pair.c[i] * step, stage_q, v}, v_dot));
  }
}

void ErkStepper::State::finish(const Node& start, double step, Node& end) const {
  end.t = start.t + step;
  b.apply(step, k, 0, start.q.data(), end.q.data(), n);
  b.apply(step, k, n, start.va.data(), end.va.data(), n);
}

/// Root mean square of differences of positions and velocities over what the tolerance allows.
double ErkStepper::State::size(std::span<const double> dq, std::span<const double> dv, const Node& at) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double e = dq[i] / scales.position_error(i, at.q[i], tolerance);
    const double f = dv[i] / (tolerance * (scales.coordinate[i] / scales.time + std::abs(at.va[i])));
    sum += e * e + f * f;
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(n)));
}

/// The estimated error of a step over the tolerance.
double ErkStepper::State::error(const Node& end, double step) {
  const auto [dq, dv] = halves(difference);
  d.apply(step, k, 0, nullptr, dq.data(), n);
  d.apply(step, k, n, nullptr, dv.data(), n);
  return size(dq, dv, end);
}

/// Puts `next` onto the constraints. The correction over the tolerance.
double ErkStepper::State::land() {
  const auto [dq, dv] = halves(difference);
  const auto [v, v_dot] = halves(next.va);
  for (std::size_t i = 0; i < n; ++i) {
    dq[i] = -next.q[i];
    dv[i] = -v[i];
  }
  require(manifold.land(next.t, next.q, v, v_dot));
  for (std::size_t i = 0; i < n; ++i) {
    dq[i] += next.q[i];
    dv[i] += v[i];
  }
  return size(dq, dv, next);
}

/// Tries a step into `next`. Returns its error over the tolerance; infinite, with the reason in
/// `fault`, if the equations cannot be evaluated on its way.
double ErkStepper::State::attempt(double step) {
  try {
    run_stages(to, step, stages - 1);
    finish(to, step, next);
    const double e = error(next, step);
    if (e > 1.0) return e;
    if (steps % stability_check_interval == 0) watch_stability(step);
    return std::max(e, land() / most_correction);
  } catch (const EquationFault& error) {
    fault = error.what();
    return std::numeric_limits<double>::infinity();
  }
}

/// The last two stages lie at the same time; the ratio of their derivatives' difference to their
/// own is the largest rate rho that the step has excited (Hairer, Wanner, Solving ODEs II, IV.2).
void ErkStepper::State::watch_stability(double step) {
  const double T2 = scales.time * scales.time;
  double rates = 0.0, states = 0.0;
  last_difference.apply(step, k, 0, nullptr, stage_q.data(), n);
  for (std::size_t i = 0; i < n; ++i) {
    const double dv = k[stages - 1][i] - k[stages - 2][i];
    const double da = k[stages - 1][n + i] - k[stages - 2][n + i];
    rates += dv * dv + T2 * da * da;
    states += stage_q[i] * stage_q[i] + T2 * dv * dv;
  }
  const double round_off = 100.0 * std::numeric_limits<double>::epsilon() * scales.length;
  if (states > round_off * round_off && step * step * rates > stable * stable * states) {
    stability_limited += stability_check_interval;
  }
}

double ErkStepper::State::shorter(double step, double factor) const {
  const double shortest =
      16.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(to.t), scales.time);
  if (step * factor > shortest) return step * factor;
  throw StepFailure{fault.empty() ? "the error tolerance cannot be met with any step that double precision "
                                    "resolves; ask for a looser tolerance, or look for a discontinuous or "
                                    "very stiff force"
                                  : fault,
                    to.t};
}

/// The step to try: h, or an equal part of the way to where output is wanted or the run ends, unless
/// several outputs fall into one step.
double ErkStepper::State::step_towards(double wanted) const {
  constexpr double stretch = 0.05;  // what `safety` leaves room for
  const double gap = std::min(wanted, t_end) - to.t;
  if (gap < 0.5 * h && wanted < t_end) return std::min(h, t_end - to.t);
  return gap / std::max(1.0, std::ceil(gap / h - stretch));
}

void ErkStepper::step(double wanted) {
  State& s = *state_;
  s.fault.clear();
  double growth = most_growth;
  for (;;) {
    const double step = s.step_towards(wanted);
    const double error = s.attempt(step);
    const double factor = std::isfinite(error) ? safety * std::pow(error, -1.0 / pair.order) : after_fault;
    if (error <= 1.0) {
      s.h = step * std::min(factor, growth);
      break;
    }
    ++s.failures;
    growth = 1.0;
    s.h = s.shorter(step, std::max(factor, most_shrinking));
  }
  // Round-off in the sum must not let the last part of the way fall short of its goal.
  const double goal = std::min(wanted, s.t_end);
  if (std::abs(s.next.t - goal) <= 1e-14 * std::max(std::abs(goal), s.scales.time)) s.next.t = goal;
  ++s.steps;
  s.has_middle = false;
  std::swap(s.from, s.to);
  std::swap(s.to, s.next);
}

double ErkStepper::time() const { return state_->to.t; }

/// Half a step of the method itself from where the last step began.
void ErkStepper::State::find_middle() {
  if (has_middle) return;
  const double half = 0.5 * (to.t - from.t);
  run_stages(from, half, last_stage_of_step);
  finish(from, half, middle);
  const auto [v, v_dot] = halves(middle.va);
  require(manifold.accelerate({middle.t, middle.q, v}, v_dot));
  has_middle = true;
}

void ErkStepper::interpolate(double t, std::span<double> q, std::span<double> v) {
  State& s = *state_;
  if (t == s.to.t) {
    std::ranges::copy(s.to.q, q.begin());
    std::copy_n(s.to.va.begin(), s.n, v.begin());
    return;
  }
  s.find_middle();
  const Hermite<3> polynomial({s.from.t, s.middle.t, s.to.t}, t);
  for (std::size_t i = 0; i < s.n; ++i) {
    const auto x =
        polynomial({s.from.q[i], s.middle.q[i], s.to.q[i]}, {s.from.va[i], s.middle.va[i], s.to.va[i]},
                   {s.from.va[s.n + i], s.middle.va[s.n + i], s.to.va[s.n + i]});
    q[i] = x.value;
    v[i] = x.derivative;
  }
}

void ErkStepper::count(Statistics& statistics) const {
  const State& s = *state_;
  statistics.steps += s.steps;
  statistics.evaluations += s.manifold.evaluations();
  statistics.factorisations += s.manifold.factorisations();
  statistics.error_test_failures += s.failures;
  statistics.linear_algebra = s.manifold.method();
  statistics.stability_limited += s.stability_limited;
  if (2 * s.stability_limited > s.steps)
    statistics.advice = "stiff: stability, not accuracy, held down most steps; use Stepper::ida";
}

}  // namespace dalembert
