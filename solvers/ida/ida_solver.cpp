#include "dalembert/solvers/ida/ida_solver.h"

#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/ida/vector_operations.h>

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

IdaStepper::Solver::Solver(const Problem& problem, const Start& start, const Options& options)
    : system(&problem.system()),
      rows(start.rows),
      scales(start.scales),
      lengths(start.scales.lengths()),
      tolerance(tolerance_of_a_step(Stepper::ida, options.tolerance)),
      t_end(options.t_end),
      first_step(std::min(Accuracy(options.tolerance).first_implicit_step() * start.scales.time,
                          longest_step(options))),
      e(system->evaluation()),
      lambda(start.lambda.size()),
      impulse_row(start.rows.size()),
      compliance_row(impulse_row.size()),
      newton(problem, start.rows, start.scales.time),
      t(options.t_start) {
  y.reset(check(N_VNew_Serial(static_cast<sunindextype>(unknowns()), context.get())));
  vectorise(y.get());
  yp.reset(check(N_VClone(y.get())));
  dense.reset(check(N_VClone(y.get())));
  id.reset(check(N_VClone(y.get())));
  for (N_Vector v : {y.get(), yp.get(), id.get()}) N_VConst(0.0, v);
  const auto y0 = entries(y.get());
  const auto yp0 = entries(yp.get());
  std::ranges::copy(start.q, y0.begin());
  std::ranges::copy(start.v, y0.subspan(n()).begin());
  for (std::size_t r = 0; r < m(); ++r) y0[2 * n() + r] = start.lambda[rows.rows[r]];
  std::ranges::copy(start.v, yp0.begin());
  std::ranges::copy(start.a, yp0.subspan(n()).begin());
  std::fill_n(entries(id.get()).begin(), 2 * n(), 1.0);
  system->evaluate(instant(t, y.get()), e);
  for (std::size_t r = 0; r < m(); ++r) {
    const auto row = rows.rows[r];
    if (system->law(row).compliant()) yp0[2 * n() + r] = system->law(row).multiplier(e.psi[row]);
  }
  find_impulses();

  ida.reset(check(IDACreate(context.get())));
  make_linear_solver();
}

void IdaStepper::Solver::find_impulses() {
  lengths = scales.lengths();
  for (std::size_t r = 0; r < m(); ++r) {
    const auto row = rows.rows[r];
    impulse_row[r] = impulse_of_row(*system, e.w, lengths, row, scales.speed());
    compliance_row[r] = system->law(row).compliance / gradient_length(*system, e.w, lengths, row);
  }
}

/// IDA's multipliers, one per active row, into one per row of the system.
void IdaStepper::Solver::spread_multipliers(N_Vector x) {
  const auto active = entries(x).subspan(2 * n(), m());
  for (std::size_t r = 0; r < m(); ++r) lambda[rows.rows[r]] = active[r];
}

void IdaStepper::Solver::residual(double at, N_Vector x, N_Vector xp, N_Vector r) {
  ++evaluations;
  const Instant now = instant(at, x);
  system->evaluate(now, e);
  if (system->forces().has_friction()) {
    spread_multipliers(x);
    system->forces().add_friction(now, lambda, e.force);
  }
  evaluated_at = at;
  evaluated = x;
  const auto qp = entries(xp).subspan(0, n());
  const auto vp = entries(xp).subspan(n(), n());
  const auto active = entries(x).subspan(2 * n(), m());
  const auto rates = entries(xp).subspan(2 * n(), m());
  const auto mu = entries(x).subspan(2 * n() + m(), m_holonomic());
  const auto r1 = entries(r).subspan(0, n());
  const auto r2 = entries(r).subspan(n(), n());
  const auto r3 = entries(r).subspan(2 * n(), m());
  const auto r4 = entries(r).subspan(2 * n() + m(), m_holonomic());
  const auto masses = system->masses();
  for (std::size_t i = 0; i < n(); ++i) {
    r1[i] = masses[i] * (now.v[i] - qp[i]);
    r2[i] = e.force[i] - masses[i] * vp[i];
  }
  for (std::size_t k = 0; k < m(); ++k) {
    const auto row = rows.rows[k];
    const bool holonomic = k < m_holonomic();
    for (const std::size_t j : system->row(row)) {
      const auto i = system->w_columns()[j];
      r2[i] += e.w[j] * active[k];
      if (holonomic) r1[i] += e.w[j] * mu[k];
    }
    r3[k] = system->law(row).residual(e.psi[row], rates[k]);
    if (holonomic) r4[k] = system->law(row).residual(e.g[row], active[k]);
  }
  for (const std::size_t k : rows.parallel) r3[k] = mu[k];
}

/// Of a row, the largest |q| that it reads, in units of each coordinate.
double IdaStepper::Solver::farthest(std::size_t row, std::span<const double> q) const {
  double far = 0.0;
  for (const std::size_t k : system->row(row)) {
    const auto i = system->w_columns()[k];
    far = std::max(far, std::abs(q[i]) / scales.unit(i));
  }
  return far;
}

/// Weighs by what is asked for, but never asks for more than double precision gives Newton's corrections:
/// with q accurate to eps |q|, the v of BDF's (v - q') is accurate to eps |q|/h, M v' and with it lambda to M
/// eps |q|/h^2, mu to M eps |q|/h; of rows that make an angle with others, to 1/sin^2 times that. Newton's
/// iteration stops at a part of the weights, so these contain some roundings.
///
/// The multiplier of a compliant row also enters psi + C lambda', as C lambda/h: in steps that follow the
/// vibration of its spring that is what limits its error. In the error test it counts as the length C lambda,
/// by its share of that weight: it is a differential variable, and where nothing moves the only one. (Other
/// multipliers have no share; see IDASetSuppressAlg.)
void IdaStepper::Solver::weigh(N_Vector x, N_Vector weight) {
  double h = 0.0;
  check(IDAGetCurrentStep(ida.get(), &h), "IDAGetCurrentStep");  // 0 before the first
  if (h == 0.0) h = first_step;
  weighed_h = h;
  const auto value = entries(x);
  const auto w = entries(weight);
  const auto share = entries(id.get());
  if (scales.length_from_path) {
    scales.adopt(scales.extended_by(value.first(n()), value.subspan(n(), n()), h, tolerance));
    find_impulses();
  }
  const double eps = constants.roundings_of_newton * epsilon;
  for (std::size_t i = 0; i < n(); ++i) {
    const double noise = eps * std::abs(value[i]);
    const double speed = scales.velocity_error(i, value[n() + i], tolerance);
    w[i] = 1.0 / (scales.position_error(i, value[i], tolerance) + noise);
    w[n() + i] = 1.0 / (speed + noise / h);
  }
  const double amplified = eps / std::max(sine() * sine(), eps);
  for (std::size_t r = 0; r < m(); ++r) {
    // In units of the tolerance's own: of the scene's length, and over the step of its speed.
    const double far = farthest(rows.rows[r], value.first(n()));
    const double noise = amplified * far, noise_of_speed = noise * scales.time / h;
    // Of a multiplier far larger than its own masses explain (a heavy load on a light link) no more
    // digits than the tolerance asks for.
    const double impulse =
        impulse_row[r] * (tolerance + noise_of_speed) + tolerance * h * std::abs(value[2 * n() + r]);
    const double stretching = scales.speed() * (tolerance + eps * far * scales.time / h);
    const double weight_of_speed = compliance_row[r] / (h * stretching);
    w[2 * n() + r] = h / impulse + weight_of_speed;
    const double weight_of_length = compliance_row[r] / (scales.length * (tolerance + eps * far));
    share[2 * n() + r] = std::pow(weight_of_length / w[2 * n() + r], 2);
    if (r < m_holonomic()) w[2 * n() + m() + r] = h / (impulse_row[r] * scales.time * (tolerance + noise));
  }
  if (system->compliant()) check(IDASetId(ida.get(), id.get()), "IDASetId");
}

}  // namespace dalembert
