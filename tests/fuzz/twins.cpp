#include "verdict.h"

#include <algorithm>
#include <cmath>
#include <exception>

/// One motion computed twice: of a scene and the same stated otherwise, or by the other stepper.
namespace dalembert::fuzz {

namespace {

/// A run to its end, to where it failed, or none where the start is refused.
template <int D>
struct Ending {
  std::optional<Trajectory<D>> run{};
  std::exception_ptr failure = nullptr;
  std::optional<double> failed_at{};
  std::string why{};
};

template <int D>
Ending<D> run_of(const Draft<D>& draft) {
  try {
    return {.run = simulate(draft.scene, draft.plan.options)};
  } catch (const IntegrationFailure& failure) {
    return {failure.template trajectory<D>(), std::current_exception(), failure.time(), failure.what()};
  } catch (const InconsistentStart& refusal) {
    return {.failure = std::current_exception(), .why = refusal.what()};
  }
}

/// Positions, velocities and net forces of constraint of one sample, of every coordinate, without units. The
/// net force is what the motion determines: the sum of W^T lambda over all constraints.
struct Motion {
  std::vector<double> q, v, z;
};

struct Units {
  double length, time;
  explicit Units(const Statistics& s) : length(s.length), time(s.time) {}
};

Motion motion_of(const System& system, const FlatSample& sample, const Units& unit) {
  const Layout& layout = *system.layout();
  const std::vector<double> scale = units(system, unit.length);
  Motion m{
      {sample.q.begin(), sample.q.end()}, {sample.v.begin(), sample.v.end()}, std::vector<double>(scale)};
  std::ranges::fill(m.z, 0.0);
  for (std::size_t s = 0; s < layout.slot_coordinate.size(); ++s)
    m.z[static_cast<std::size_t>(layout.slot_coordinate[s])] += sample.forces[s];
  double inertia = 0.0;
  for (std::size_t i = 0; i < scale.size(); ++i) inertia += system.masses()[i] * scale[i] * scale[i];
  for (std::size_t i = 0; i < scale.size(); ++i) {
    m.q[i] /= scale[i];
    m.v[i] /= scale[i] / unit.time;
    m.z[i] *= scale[i] / (inertia / unit.time / unit.time);
  }
  return m;
}

/// The largest difference; none where a force is not determined.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > most) most = std::abs(a[i] - b[i]);
  }
  return most;
}
struct Distances {
  double q, v, z;
};

/// Steps that err by the accuracy.
template <int D>
double full_steps(const Draft<D>& draft, const Ending<D>& ending) {
  const auto steps = static_cast<double>(ending.run->statistics().steps);
  return steps * tolerance_of_a_step(draft.plan.options.stepper, 1.0);
}

template <int D>
class Comparison {
 public:
  Comparison(const Draft<D>& a, const Ending<D>& x, const Draft<D>& b, const Ending<D>& y)
      : a_(a.scene.system()),
        b_(b.scene.system()),
        x_(*x.run),
        y_(*y.run),
        unit_(y_.statistics()),
        forces_(a.plan.family == Family::redundant),
        steps_(full_steps(a, x) + full_steps(b, y)) {}

  [[nodiscard]] std::size_t size() const { return std::min(x_.size(), y_.size()); }
  [[nodiscard]] Distances at(std::size_t i) const {
    const Motion a = motion_of(a_, x_.sample(i).flat(), unit_), b = motion_of(b_, y_.sample(i).flat(), unit_);
    return {apart(a.q, b.q), apart(a.v, b.v), apart(a.z, b.z)};
  }
  [[nodiscard]] double time(std::size_t i) const { return y_.times()[i]; }
  /// What the two may be apart: of scenes that are smooth a multiple of the accuracy. Steps onto a kink add
  /// up what all of them err by, `ida`'s by a twentieth of the accuracy each.
  [[nodiscard]] double error() const {
    const double accuracy = std::max(x_.statistics().accuracy, y_.statistics().accuracy);
    return accuracy * (forces_ ? error_of_run : std::max(error_of_run, 3.0 * steps_));
  }
  [[nodiscard]] const Units& unit() const { return unit_; }
  /// Those of kinked scenes jump at an instant that no two runs have in common.
  [[nodiscard]] bool forces() const { return forces_; }

 private:
  System a_, b_;
  Trajectory<D> x_, y_;
  Units unit_;
  bool forces_;
  double steps_;
};

std::string too_far(const char* what, double time, double size, double bound, std::string& detail) {
  std::ostringstream text;
  text << what << " of the twins at t = " << time << " differ by " << size << ", bound " << bound;
  if (size > 0.01 * bound) detail += text.str() + '\n';
  return size <= bound ? "" : text.str();
}

/// What the twins are apart beyond what is allowed at each sample.
template <int D>
std::string difference(const Comparison<D>& twins, const std::vector<Distances>& allowed,
                       std::string& detail) {
  const bool forces = twins.forces();
  for (std::size_t i = 0; i < twins.size(); ++i) {
    const Distances d = twins.at(i);
    std::string fault = too_far("positions", twins.time(i), d.q, allowed[i].q, detail);
    if (fault.empty()) fault = too_far("velocities", twins.time(i), d.v, allowed[i].v, detail);
    if (fault.empty() && forces) fault = too_far("net forces", twins.time(i), d.z, allowed[i].z, detail);
    if (!fault.empty()) return fault;
  }
  return {};
}

/// Where the twins are too far apart, what the scene makes of early errors counts as well: some enlarge them,
/// and no stepper can help that. It is how far the second twin is from itself begun with speeds that differ
/// by what is allowed, along each axis.
template <int D>
std::string fault_of_comparison(const Draft<D>& draft, const Ending<D>& one, const Draft<D>& twin,
                                const Ending<D>& two, std::string& detail) {
  const Comparison<D> twins(draft, one, twin, two);
  const double error = twins.error(), rate = error / twins.unit().time;
  std::vector<Distances> allowed(twins.size(), {error, error, error});
  const std::string fault = difference(twins, allowed, detail);
  if (fault.empty()) return fault;
  for (int axis = 0; axis < D; ++axis) {
    Draft<D> otherwise = twin.again(twin.plan, {.lean = draft.plan.family == Family::redundant,
                                                .more_speed = rate * twins.unit().length,
                                                .more_spin = rate,
                                                .axis = axis});
    fill(otherwise);
    const Ending<D> three = run_of(otherwise);
    if (!three.run) continue;
    const Comparison<D> own(otherwise, three, twin, two);
    Distances most{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < std::min(own.size(), allowed.size()); ++i) {
      const Distances d = own.at(i);
      most = {std::max(most.q, d.q), std::max(most.v, d.v), std::max(most.z, d.z)};
      allowed[i] = {allowed[i].q + most.q, allowed[i].v + most.v, allowed[i].z + most.z};
    }
  }
  return difference(twins, allowed, detail);
}

}  // namespace

template <int D>
std::string fault_of_twins(const Draft<D>& draft, std::string& detail) {
  const bool redundant = draft.plan.family == Family::redundant;
  Plan other = draft.plan;
  if (!redundant) other.options.stepper = other.options.stepper == Stepper::ida ? Stepper::erk : Stepper::ida;
  Draft<D> twin = draft.again(other, {.lean = redundant});
  fill(twin);
  const Ending<D> one = run_of(draft), two = run_of(twin);
  if (one.run.has_value() != two.run.has_value() || (redundant && one.why.empty() != two.why.empty()))
    return "only one of the twins is refused: " + one.why + two.why;
  std::string fault;
  if (one.run) fault = fault_of_run(draft, *one.run, one.failed_at, detail);
  if (one.run && fault.empty()) fault = fault_of_comparison(draft, one, twin, two, detail);
  if (fault.empty() && one.failure) std::rethrow_exception(one.failure);
  return fault;
}

template std::string fault_of_twins(const Draft<2>&, std::string&);
template std::string fault_of_twins(const Draft<3>&, std::string&);

}  // namespace dalembert::fuzz
