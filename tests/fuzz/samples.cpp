#include "verdict.h"
#include <dalembert/core/analysis/virtual_work.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dalembert::fuzz {

std::vector<double> units(const System& system, double length) {
  std::vector<double> units;
  for (const char angle : system.angles()) units.push_back(angle ? 1.0 : length);
  return units;
}

namespace {

/// Constraints hold at every sample to this fraction of the scene's length and speed (that it has, or
/// that its forces give it over its length): it is what the library itself takes for a contradiction.
/// (Independent equations hold to round-off; those that were left out because others imply them hold as well
/// as the others imply them.)
constexpr double held = 1e-8;
/// d'Alembert's principle holds to round-off of as many products as the scene has coordinates. The
/// virtual_work takes two gradients within 1e-9 of each other for one: what their forces differ by may work.
constexpr double virtual_work_threshold = 1e-9;
/// The forces give accelerations that the constraints allow: to the 1e-6 of their largest term at
/// which the library tells equations that agree from those that contradict each other. (What builds up
/// the residual speed that is tolerated, within the time the scene takes, is tolerated as well.)
constexpr double agree = 1e-6;

/// Or NaN, which marks a force that is not determined.
bool finite_or_marked(std::span<const double> x) {
  return std::ranges::none_of(x, [](double y) { return std::isinf(y); });
}

bool finite(std::span<const double> x) {
  return std::ranges::all_of(x, [](double y) { return std::isfinite(y); });
}
double largest(std::span<const double> x) {
  double most = 0.0;
  for (const double y : x) most = std::max(most, std::abs(y));
  return most;
}

/// The system as it is at a sample: one-sided constraints without a force have no rows, nor have rough ones
/// where they may slide.
System in_force(const System& system, const FlatSample& sample) {
  std::vector<std::size_t> idle = system.conditions().frictional_constraints();
  for (const std::size_t c : system.conditions().contacts()) {
    const auto row = system.layout()->constraints[c].own_rows().front();
    if (sample.lambda[row] == 0.0) idle.push_back(c);
  }
  return system.without(idle);
}

/// The numbers of one sample beside the equations evaluated there anew.
struct Check {
  const System& system;
  FlatSample sample;
  double length, speed;
  System::Evaluation e = system.evaluation();
  std::vector<double> gamma = std::vector<double>(system.rows());

  [[nodiscard]] std::string worst(const char* what, double size, double bound, std::optional<std::size_t> row,
                                  std::string& detail) const;
  [[nodiscard]] std::string run(double accuracy, std::string& detail);
  [[nodiscard]] std::string residuals(double share, std::string& detail);
  [[nodiscard]] std::string accelerations(std::string& detail);
  [[nodiscard]] std::string principle(std::string& detail) const;
};

std::string Check::worst(const char* what, double size, double bound, std::optional<std::size_t> row,
                         std::string& detail) const {
  std::ostringstream text;
  text << what << " at t = " << sample.time << " is " << size << ", bound " << bound;
  if (row) text << ", " << system.row_label(*row);
  if (size > 0.01 * bound) detail += text.str() + '\n';
  return size <= bound ? "" : text.str();
}

/// |g|/|grad g| and |psi|/|grad psi| of every equation, angles counted as arcs of the scene's length.
/// What round-off of the state itself, and of sums over it, leaves of them is allowed on top.
std::string Check::residuals(double share, std::string& detail) {
  const std::vector<double> scale = units(system, length);
  double farthest = 0.0;  // a projection moves all rows and stops at the round-off of the worst
  for (std::size_t i = 0; i < scale.size(); ++i)
    farthest = std::max(farthest, std::abs(sample.q[i]) * length / scale[i]);
  double worst_g = 0.0, worst_psi = 0.0;
  std::optional<std::size_t> row_g, row_psi;
  for (std::size_t row = 0; row < system.rows(); ++row) {
    if (!system.in_force(row)) continue;
    double gradient = 0.0, rounding = 0.0, motion = 0.0;
    for (const std::size_t k : system.row(row)) {
      const auto i = system.w_columns()[k];
      gradient = std::hypot(gradient, e.w[k] * scale[i] / length);
      rounding += std::abs(e.w[k] * sample.q[i]);
      motion += std::abs(e.w[k] * sample.v[i]);
    }
    if (row < system.holonomic_rows()) {
      const double g = (std::abs(e.g[row]) - 100.0 * epsilon * rounding) / gradient;
      if (!(g <= worst_g)) worst_g = g, row_g = row;
    }
    const double psi = (std::abs(e.psi[row]) - 100.0 * epsilon * motion) / gradient;
    if (!(psi <= worst_psi)) worst_psi = psi, row_psi = row;
  }
  const std::string g =
      worst("position residual", worst_g, share * length + 10.0 * epsilon * farthest, row_g, detail);
  return g.empty() ? worst("velocity residual", worst_psi, share * speed, row_psi, detail) : g;
}

/// W v' + gamma = 0 with v' = (F + Z)/m: a wrong force of constraint would not give it.
std::string Check::accelerations(std::string& detail) {
  system.bias({sample.time, sample.q, sample.v}, gamma);
  std::vector<double> a(e.force), size(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) size[i] = std::abs(a[i]);
  const Layout& layout = *system.layout();
  for (std::size_t s = 0; s < layout.slot_coordinate.size(); ++s) {
    a[static_cast<std::size_t>(layout.slot_coordinate[s])] += sample.forces[s];
    size[static_cast<std::size_t>(layout.slot_coordinate[s])] += std::abs(sample.forces[s]);
  }
  double most = 0.0, worst_relative = 0.0;
  std::optional<std::size_t> worst_row;
  std::vector<double> residual(gamma), terms(gamma.size());
  for (std::size_t r = 0; r < gamma.size(); ++r) {
    if (!system.in_force(r)) continue;
    terms[r] = std::abs(gamma[r]);
    double gradient = 0.0;
    for (const std::size_t k : system.row(r)) {
      const auto i = system.w_columns()[k];
      residual[r] += e.w[k] * a[i] / system.masses()[i];
      terms[r] += std::abs(e.w[k]) * size[i] / system.masses()[i];
      gradient = std::hypot(gradient, e.w[k]);
    }
    residual[r] /= gradient;
    terms[r] /= gradient;
    most = std::max(most, terms[r]);
  }
  const double scale = most + held / agree * speed * speed / length;
  for (std::size_t r = 0; r < gamma.size(); ++r) {
    const double relative = std::abs(residual[r]) / scale;
    if (std::isfinite(most) && !(relative <= worst_relative)) worst_relative = relative, worst_row = r;
  }
  return worst("acceleration residual", worst_relative, agree, worst_row, detail);
}

std::string Check::principle(std::string& detail) const {
  const VirtualWork found = virtual_work(system, sample);
  const auto n = static_cast<double>(system.coordinates());
  return worst("virtual work", found.largest,
               (virtual_work_threshold + 1000.0 * n * epsilon) * found.largest_force * n, {}, detail);
}

/// Where forces are not determined there is nothing to check, and the state is the stepper's own, right to
/// the accuracy of the run, and not projected onto the constraints.
std::string Check::run(double accuracy, std::string& detail) {
  const bool determined = finite(sample.forces);
  const Instant at{sample.time, sample.q, sample.v};
  system.evaluate(at, e);
  if (determined && system.forces().has_friction()) system.forces().add_friction(at, sample.lambda, e.force);
  const std::vector<double> scale = units(system, length);
  for (std::size_t i = 0; i < scale.size(); ++i) {
    speed = std::max(speed, std::sqrt(std::abs(e.force[i]) / system.masses()[i] / scale[i]) * length);
  }
  std::string fault = residuals(determined ? held : std::max(held, error_of_run * accuracy), detail);
  if (!determined) return fault;
  if (fault.empty()) fault = accelerations(detail);
  return fault.empty() && system.conditions().frictional_constraints().empty() ? principle(detail)
                                                                               : fault;  // friction does work
}

std::string fault_of_times(std::span<const double> times, std::span<const double> wanted,
                           std::optional<double> failed_at) {
  if (!failed_at && times.size() != wanted.size())
    return "the run has another number of samples than asked for";
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] != wanted[i]) return "a sample is at another time than asked for";
    if (failed_at && times[i] > *failed_at) return "a sample is later than the failure";
  }
  return {};
}

}  // namespace

template <int D>
std::string fault_of_run(const Draft<D>& draft, const Trajectory<D>& run, std::optional<double> failed_at,
                         std::string& detail) {
  const std::string times = fault_of_times(run.times(), sample_times(draft.plan.options), failed_at);
  if (!times.empty()) return times;
  const System system = draft.scene.system();
  double length = std::max(system.extent(draft.plan.options.t_start), draft.plan.length), speed = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const FlatSample s = run.sample(i).flat();
    if (!finite(s.q) || !finite(s.v)) return "a position or velocity is not finite";
    if (!finite_or_marked(s.lambda) || !finite_or_marked(s.forces))
      return "a force of constraint is not finite";
    if (!std::isfinite(s.energy)) return "an energy is not finite";
    speed = std::max({speed, largest(s.v), length / draft.plan.time});
  }
  for (std::size_t i = 0; i < run.size(); ++i) {
    const FlatSample sample = run.sample(i).flat();
    const System now = in_force(system, sample);
    Check check{now, sample, length, speed};
    const std::string fault = check.run(run.statistics().accuracy, detail);
    if (!fault.empty()) return fault;
  }
  return system.conditions().conditional_constraints().empty() ? "" : fault_of_contacts(draft, run, detail);
}

template std::string fault_of_run(const Draft<2>&, const Trajectory<2>&, std::optional<double>, std::string&);
template std::string fault_of_run(const Draft<3>&, const Trajectory<3>&, std::optional<double>, std::string&);

}  // namespace dalembert::fuzz
