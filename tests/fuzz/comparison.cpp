#include "comparison.h"

#include <algorithm>
#include <cmath>

namespace dalembert::fuzz {

template <int D>
Statement faster(const Draft<D>& draft, int way, double rate, double length) {
  Statement other = draft.statement();
  other.axis = way / 2;
  other.more_spin = way % 2 == 0 ? rate : -rate;
  other.more_speed = other.more_spin * length;
  other.drive = other.more_spin;
  return other;
}

template <int D>
Ending<D> run_of(const Draft<D>& draft) {
  try {
    return {.run = simulate(draft.scene, draft.plan.options, draft.events)};
  } catch (const IntegrationFailure& failure) {
    return {failure.template trajectory<D>(), std::current_exception(), failure.time(), failure.what()};
  } catch (const InconsistentStart& refusal) {
    return {.failure = std::current_exception(), .why = refusal.what()};
  }
}

namespace {

/// Positions, velocities and net forces of constraint of one sample, of every coordinate, without units. The
/// net force is what the motion determines: the sum of W^T lambda over all constraints.
struct Motion {
  std::vector<double> q, v, z;
};

struct Units {
  double length, time;
  explicit Units(const Statistics& s) : length(s.length), time(s.time) {}
  /// Those of the faster of two runs: in a part that rests there is no speed.
  Units(const Statistics& a, const Statistics& b) : Units(a.length * b.time > b.length * a.time ? a : b) {}
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
  Comparison(const Run<D>& a, const Run<D>& b, const Measure& measure)
      : a_(a.draft.scene.system()),
        b_(b.draft.scene.system()),
        x_(*a.ending.run),
        y_(*b.ending.run),
        unit_(x_.statistics(), y_.statistics()),
        measure_(measure),
        steps_(full_steps(a.draft, a.ending) + full_steps(b.draft, b.ending)) {}

  [[nodiscard]] std::size_t size() const {
    return x_.size() > measure_.first ? std::min(x_.size() - measure_.first, y_.size()) : 0;
  }
  [[nodiscard]] Distances at(std::size_t i) const {
    const Motion a = motion_of(a_, x_.sample(i + measure_.first).flat(), unit_),
                 b = motion_of(b_, y_.sample(i).flat(), unit_);
    return {apart(a.q, b.q), apart(a.v, b.v), apart(a.z, b.z)};
  }
  [[nodiscard]] double time(std::size_t i) const { return y_.times()[i]; }
  /// What the two may be apart: of scenes that are smooth a multiple of the accuracy. Steps onto a kink add
  /// up what all of them err by, `ida`'s by a twentieth of the accuracy each.
  [[nodiscard]] double error() const {
    const double accuracy = std::max(x_.statistics().accuracy, y_.statistics().accuracy);
    return accuracy * (measure_.forces ? error_of_run : std::max(error_of_run, 3.0 * steps_));
  }
  /// What an error of velocity displaces by, in this time.
  [[nodiscard]] double drift(std::size_t i) const {
    const double accuracy = std::max(x_.statistics().accuracy, y_.statistics().accuracy);
    return accuracy * (time(i) - time(0)) / unit_.time;
  }
  [[nodiscard]] const Units& unit() const { return unit_; }

 private:
  System a_, b_;
  Trajectory<D> x_, y_;
  Units unit_;
  Measure measure_;
  double steps_;
};

std::string too_far(const char* what, double time, double size, double bound, std::string& detail) {
  std::ostringstream text;
  text << what << " at t = " << time << " differ by " << size << ", bound " << bound;
  if (size > 0.01 * bound) detail += text.str() + '\n';
  return size <= bound ? "" : text.str();
}

/// What the two are apart beyond what is allowed at each sample.
template <int D>
std::string difference(const Comparison<D>& runs, const std::vector<Distances>& allowed,
                       const Measure& measure, std::string& detail) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Distances d = runs.at(i);
    std::string fault =
        too_far("positions", runs.time(i), d.q, allowed[i].q + measure.coarse / runs.unit().length, detail);
    if (fault.empty() && measure.velocities)
      fault = too_far("velocities", runs.time(i), d.v, allowed[i].v, detail);
    if (fault.empty() && measure.forces)
      fault = too_far("net forces", runs.time(i), d.z, allowed[i].z, detail);
    if (!fault.empty()) return measure.of + ": " + fault;
  }
  return {};
}

}  // namespace

/// Where the two are too far apart, what the scene makes of early errors counts as well: some enlarge them,
/// and no stepper can help that. It is how far a run is from itself begun with speeds that differ by what is
/// allowed, along each axis both ways, and gaining or losing as large a part of them in the scene's time:
/// what returns to a contact at rest strikes it or does not, even where an impact has taken other speeds.
template <int D>
std::string fault_of_comparison(const Run<D>& one, const Run<D>& two, const Run<D>& own,
                                const Measure& measure, std::string& detail) {
  const Comparison<D> runs(one, two, measure);
  const double error = runs.error(), rate = error / runs.unit().time;
  std::vector<Distances> allowed;
  for (std::size_t i = 0; i < runs.size(); ++i) allowed.push_back({error + runs.drift(i), error, error});
  const std::string fault = difference(runs, allowed, measure, detail);
  if (fault.empty()) return fault;
  for (int way = 0; way < 2 * D; ++way) {
    Draft<D> otherwise = own.draft.again(own.draft.plan, faster(own.draft, way, rate, runs.unit().length));
    fill(otherwise);
    const Ending<D> three = run_of(otherwise);
    if (!three.run) continue;
    const Comparison<D> apart({otherwise, three}, own, {});
    const std::size_t first = apart.size() - std::min(apart.size(), allowed.size());
    Distances most{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < apart.size(); ++i) {
      const Distances d = apart.at(i);
      most = {std::max(most.q, d.q), std::max(most.v, d.v), std::max(most.z, d.z)};
      if (i < first) continue;
      Distances& at = allowed[i - first];
      at = {at.q + most.q, at.v + most.v, at.z + most.z};
    }
  }
  return difference(runs, allowed, measure, detail);
}

template <int D>
std::string fault_of_twin(const Run<D>& one, const Run<D>& two, const Measure& measure, std::string& detail) {
  const std::string fault = fault_of_comparison(one, two, two, measure, detail);
  return fault.empty() ? fault : fault_of_comparison(one, two, one, measure, detail);
}

template Statement faster(const Draft<2>&, int, double, double);
template Statement faster(const Draft<3>&, int, double, double);
template Ending<2> run_of(const Draft<2>&);
template Ending<3> run_of(const Draft<3>&);
template std::string fault_of_comparison(const Run<2>&, const Run<2>&, const Run<2>&, const Measure&,
                                         std::string&);
template std::string fault_of_comparison(const Run<3>&, const Run<3>&, const Run<3>&, const Measure&,
                                         std::string&);

template std::string fault_of_twin(const Run<2>&, const Run<2>&, const Measure&, std::string&);
template std::string fault_of_twin(const Run<3>&, const Run<3>&, const Measure&, std::string&);

}  // namespace dalembert::fuzz
