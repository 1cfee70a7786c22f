#include "verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>

/// What a run with one-sided and rough constraints must satisfy, whatever the scene.
namespace dalembert::fuzz {

namespace {

/// Gaps that touch at the start are 0 to this part of the scene's length (rounding_of_the_user).
constexpr double touching_within = 1e-8;
/// What solving for impulses leaves of 0, of the largest (round_off of Contacts).
constexpr double round_off = 1e4 * epsilon;

/// The instants of a run in the order of time: samples, and the states before and after what happened.
struct Moment {
  FlatSample at;
  int order;  // at one time
};

template <int D>
class Contacts {
 public:
  Contacts(const Draft<D>& draft, const Trajectory<D>& run, std::string& detail)
      : draft_(draft), run_(run), detail_(detail), system_(draft.scene.system()), s_(run.statistics()) {
    const double start = draft.plan.options.t_start;
    s_.accuracy = std::max(s_.accuracy, draft.plan.options.tolerance);  // of a run without a step it is 0
    for (std::size_t i = 0; i < run.size(); ++i) {
      const FlatSample at = run.sample(i).flat();
      // Where there are impacts at the start that sample lies between them.
      if (at.time > start || run.events().empty() || run.events()[0].time > start)
        moments_.push_back({at, 0});
    }
    for (std::size_t k = 0; k < run.events().size(); ++k) {
      if (k > 0 && one_change(k - 1, k)) continue;
      moments_.push_back({run.event_sample(k).flat(), 1});
      moments_.push_back({run.sample_after(k).flat(), 1});
    }
    std::ranges::stable_sort(moments_, [](const Moment& a, const Moment& b) {
      return std::pair(a.at.time, a.order) < std::pair(b.at.time, b.order);
    });
    for (const Moment& m : moments_)
      for (const double v : m.at.v) speed_ = std::max(speed_, std::abs(v));
    for (const double m : system_.masses()) mass_ += m;
  }

  [[nodiscard]] std::string fault() {
    std::string fault = order();
    for (std::size_t i = 0; fault.empty() && i < moments_.size(); ++i) {
      fault = gaps(moments_[i].at);
      if (fault.empty()) fault = forces(moments_[i].at);
      if (fault.empty()) fault = friction(moments_[i].at);
    }
    for (std::size_t k = 0; fault.empty() && k < run_.events().size(); ++k) fault = event(k);
    if (fault.empty() && draft_.plan.still == 1.0) fault = energy();
    return fault;
  }

 private:
  [[nodiscard]] std::string too_large(const std::string& what, double time, double size, double bound) {
    std::ostringstream text;
    text << what << " at t = " << time << " is " << size << ", bound " << bound;
    if (size > 0.01 * bound) detail_ += text.str() + '\n';
    return size <= bound ? "" : text.str();
  }

  [[nodiscard]] System::Evaluation evaluated(const FlatSample& at) const {
    auto e = system_.evaluation();
    system_.evaluate({at.time, at.q, at.v}, e);
    return e;
  }
  [[nodiscard]] std::size_t row_of(std::size_t contact) const {
    return system_.layout()->constraints[contact].own_rows().front();
  }
  [[nodiscard]] double sign_of(std::size_t contact) const {
    return system_.conditions().of[contact].contact->sign();
  }

  /// Whether two that are listed happened in one change, from one state to one other.
  [[nodiscard]] bool one_change(std::size_t k, std::size_t l) const {
    return run_.event_sample(k).time() == run_.event_sample(l).time() &&
           run_.event_sample(k).energy() == run_.event_sample(l).energy() &&
           run_.sample_after(k).energy() == run_.sample_after(l).energy();
  }

  [[nodiscard]] std::string order() const {
    const auto events = run_.events();
    if (std::ranges::is_sorted(events, {}, &EventRecord::time)) return {};
    return "events are not in the order of time";
  }

  /// No gap is negative by more than the accuracy of the scene's length, times the gradient, and round-off.
  [[nodiscard]] std::string gaps(const FlatSample& at) {
    const auto e = evaluated(at);
    std::string fault;
    for (const std::size_t c : system_.conditions().contacts()) {
      double square = 0.0, rounding = 0.0;
      for (const std::size_t k : system_.row(row_of(c))) {
        square += e.w[k] * e.w[k];
        rounding += std::abs(e.w[k] * at.q[system_.w_columns()[k]]);
      }
      const double gradient = std::sqrt(square);
      const double bound =
          std::max(s_.accuracy, touching_within) * s_.length * gradient + 100.0 * epsilon * rounding;
      const double gap = sign_of(c) * e.g[row_of(c)];
      if (fault.empty()) fault = too_large("gap of " + system_.row_label(row_of(c)), at.time, -gap, bound);
    }
    return fault;
  }

  /// Forces push: to what they themselves are known to.
  [[nodiscard]] std::string forces(const FlatSample& at) {
    double largest = mass_ * s_.length / s_.time / s_.time;
    for (const double f : at.lambda)
      if (std::abs(f) > largest) largest = std::abs(f);
    for (const std::size_t c : system_.conditions().contacts()) {
      const double wrong = -sign_of(c) * at.lambda[row_of(c)];
      const std::string fault = too_large("pull of " + system_.row_label(row_of(c)), at.time, wrong,
                                          error_of_run * s_.accuracy * largest);
      if (!fault.empty()) return fault;
    }
    return {};
  }

  /// Friction is within its cone, and drives nothing.
  [[nodiscard]] std::string friction(const FlatSample& at) {
    if (system_.conditions().frictional_constraints().empty()) return {};
    const auto e = evaluated(at);
    double largest = mass_ * s_.length / s_.time / s_.time;
    for (const double f : at.lambda)
      if (std::abs(f) > largest) largest = std::abs(f);
    const double allowed = error_of_run * s_.accuracy * largest;
    for (const std::size_t c : system_.conditions().frictional_constraints()) {
      const Layout::Constraint& its = system_.layout()->constraints[c];
      const Roughness& law = *system_.conditions().of[c].roughness;
      double square = 0.0, power = 0.0;
      for (std::size_t r = row_of(c); r < row_of(c) + static_cast<std::size_t>(its.rows); ++r) {
        square += at.lambda[r] * at.lambda[r];
        power += at.lambda[r] * e.psi[r];
      }
      const double most =
          law.mu_static * std::abs(at.lambda[row_of(static_cast<std::size_t>(law.pressed_by))]);
      std::string fault =
          too_large("friction beyond its cone of " + its.label(), at.time, std::sqrt(square) - most, allowed);
      if (fault.empty())
        fault = too_large("power of friction of " + its.label(), at.time, power,
                          allowed * std::max(speed_, s_.length / s_.time));
      if (!fault.empty()) return fault;
    }
    return {};
  }

  /// Impulses push, balance the momentum, and reverse the speed of approach as restitution has it.
  [[nodiscard]] std::string event(std::size_t k) {
    const FlatSample before = run_.event_sample(k).flat(), after = run_.sample_after(k).flat();
    const Layout& layout = *system_.layout();
    const auto e = evaluated(before), e_after = [&] {
      FlatSample there = before;
      there.v = after.v;
      return evaluated(there);
    }();
    std::vector<double> momentum(before.v.size()), impulse;
    for (std::size_t i = 0; i < momentum.size(); ++i)
      momentum[i] = system_.masses()[i] * (after.v[i] - before.v[i]);
    double largest = 0.0;
    for (std::size_t c = 0; c < layout.constraints.size(); ++c) {
      impulse.push_back(0.0);
      if (system_.conditions().of[c].roughness) continue;  // an impact that presses them is refused
      const Constraint<1> handle{static_cast<int>(c), layout.constraints[c].scene};
      impulse.back() = run_.impulse(handle, k);
      largest = std::max(largest, std::abs(impulse.back()));
      for (const std::size_t w : system_.row(row_of(c)))
        momentum[system_.w_columns()[w]] -= e.w[w] * impulse.back();
    }
    const double slow = error_of_run * s_.accuracy * std::max(speed_, s_.length / s_.time);
    double unbalanced = 0.0;
    for (const double p : momentum) unbalanced = std::max(unbalanced, std::abs(p));
    // What slides in space may rest with what is left of its way in one direction (rest_in_space).
    const double stopped =
        D == 3 && !system_.conditions().frictional_constraints().empty() ? 10.0 * slow : slow;
    std::string fault = too_large("momentum out of balance", before.time, unbalanced, mass_ * stopped);
    for (const std::size_t c : system_.conditions().contacts()) {
      if (fault.empty() && !rests(before.time))
        fault = too_large("pulling impulse of " + system_.row_label(row_of(c)), before.time,
                          -sign_of(c) * impulse[c], round_off * largest);
    }
    const EventRecord& it = run_.events()[k];
    if (it.kind != EventKind::struck || !fault.empty()) return fault;
    const double restitution = system_.conditions().of[it.source].contact->restitution;
    const double left = e_after.psi[row_of(it.source)] + restitution * e.psi[row_of(it.source)];
    return too_large("rebound of " + system_.row_label(row_of(it.source)), before.time, std::abs(left),
                     2.0 * slow);
  }
  /// Whether contacts come to rest at this time: there impulses end what is left of their speeds, either way.
  [[nodiscard]] bool rests(double time) const {
    for (std::size_t k = 0; k < run_.events().size(); ++k)
      if (run_.events()[k].kind == EventKind::rested && run_.event_sample(k).time() == time) return true;
    return false;
  }

  /// What a step may err by, in energy, if it errs by the accuracy in all positions and velocities.
  [[nodiscard]] double energy_of_error(const FlatSample& at) const {
    const auto e = evaluated(at);
    double sum = 0.0;
    for (std::size_t i = 0; i < at.q.size(); ++i) {
      sum += std::abs(e.force[i]) * (s_.length + std::abs(at.q[i] - moments_.front().at.q[i]));
      sum += system_.masses()[i] * std::abs(at.v[i]) * (s_.length / s_.time + std::abs(at.v[i]));
    }
    return s_.accuracy * sum;
  }

  /// Nothing adds energy, and where nothing takes any away it stays the same.
  [[nodiscard]] std::string energy() {
    if (moments_.empty()) return {};  // it failed at the start
    double error = 0.0, largest = 0.0;
    for (const Moment& m : moments_) {
      error = std::max(error, energy_of_error(m.at));
      largest = std::max(largest, std::abs(m.at.energy));
    }
    const auto steps = static_cast<double>(s_.steps + static_cast<long>(run_.events().size()));
    const double bound = std::max(error_of_run, steps) * error + round_off * largest;
    double least = moments_.front().at.energy;
    for (const Moment& m : moments_) {
      std::string fault = too_large("gain of energy", m.at.time, m.at.energy - least, bound);
      if (fault.empty() && draft_.plan.lossless)
        fault = too_large("loss of energy", m.at.time, moments_.front().at.energy - m.at.energy, bound);
      if (!fault.empty()) return fault;
      least = std::min(least, m.at.energy);
    }
    return {};
  }

  const Draft<D>& draft_;
  const Trajectory<D>& run_;
  std::string& detail_;
  System system_;
  Statistics s_;
  std::vector<Moment> moments_;
  double speed_ = 0.0, mass_ = 0.0;
};

}  // namespace

template <int D>
std::string fault_of_contacts(const Draft<D>& draft, const Trajectory<D>& run, std::string& detail) {
  return Contacts<D>(draft, run, detail).fault();
}

template std::string fault_of_contacts(const Draft<2>&, const Trajectory<2>&, std::string&);
template std::string fault_of_contacts(const Draft<3>&, const Trajectory<3>&, std::string&);

}  // namespace dalembert::fuzz
