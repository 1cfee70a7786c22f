#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/erk/runge_kutta.h>
#include <dalembert/solvers/run/sticking.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

/// A jump of the acceleration within a step, seen by the stages behind it, changes the step's velocity by at
/// most this many times step and jump: the largest |sum_{c_j > x} b_j - (1 - x)| of the pair, for x between
/// its 9th and 10th stage.
constexpr double most_weight = 25.0;

/// Stages that enter a step. None may lie behind a switch: at some lengths those behind it cancel in the
/// error estimate, and `stop_short`, which seeks the longest step in front of it, would find just these.
bool counts(std::size_t stage) { return verner87.b[stage] != 0.0; }

}  // namespace

/// Which side `node` is on, with the multipliers that its acceleration was found with.
void ErkStepper::RungeKutta::find_side(Node& node) {
  manifold.multipliers(multipliers);
  switches.find({node.t, node.q, halves(node.va).first}, multipliers, node.side);
}

/// Of the last node, where no attempt has led.
void ErkStepper::RungeKutta::find_side_anew() {
  if (!switches.any()) return;
  std::vector<double> unused(n);
  require(manifold.accelerate({to.t, to.q, halves(to.va).first}, unused));
  find_side(to);
}

/// Whether a stage of a step from `to` lies behind a switch.
void ErkStepper::RungeKutta::check_switch(std::size_t i, double t) {
  if (!counts(i) || !switches.any()) return;
  manifold.multipliers(multipliers);
  switches.find({t, stage_q, halves(stage(i)).first}, multipliers, stage_side);
  if (switches.same(to.side, stage_side)) return;
  if (passed_switch && !switches.same(behind_side, stage_side)) passed_several = true;
  passed_switch = true;
  std::swap(behind_side, stage_side);
}

/// After a step that failed, whether it passed a switch. Its end may lie off the constraints.
bool ErkStepper::RungeKutta::failed_behind_switch() {
  if (!switches.any()) return false;
  if (passed_switch) return true;
  try {
    const auto [v, v_dot] = halves(next.va);
    if (!manifold.accelerate({next.t, next.q, v}, v_dot)) return false;
    find_side(next);
  } catch (const EquationFault&) {
    return false;
  }
  return !switches.same(to.side, next.side);
}

/// The most that a switch between two nodes, crossed in one step, may contribute to its error, over the
/// tolerance.
double ErkStepper::RungeKutta::effect_of_switch(const Node& a, const Node& b, double step) {
  const auto [dq, dv] = halves(difference);
  std::ranges::fill(dq, 0.0);
  for (std::size_t i = 0; i < n; ++i) dv[i] = most_weight * step * (b.va[n + i] - a.va[n + i]);
  return weighted_norm();
}

/// After a projection: what a switch that was passed may have done to the step, over the tolerance. That is
/// known if all behind it lies on the side on which the step ends.
double ErkStepper::RungeKutta::error_of_switch(double step) {
  if (!switches.any()) return 0.0;
  find_side(next);
  const bool ends_behind = !switches.same(to.side, next.side);
  if (passed_switch && (passed_several || !ends_behind || !switches.same(behind_side, next.side)))
    return std::numeric_limits<double>::infinity();
  passed_switch = ends_behind;
  return ends_behind ? effect_of_switch(to, next, step) : 0.0;
}

/// After a step that failed: if it passed a switch, finds by bisection the longest one in front of it, and
/// how far it is from there to behind it. True if `next` is then the end of a step.
bool ErkStepper::RungeKutta::stop_short(double step) {
  if (!failed_behind_switch()) return false;
  double before = 0.0, behind = step;
  std::swap(next, beyond);
  while (behind - before > shortest()) {
    if (before > 0.0 && effect_of_switch(short_of, beyond, behind - before) <= 1.0) break;
    const double middle_of_both = 0.5 * (before + behind);
    const double e = attempt(middle_of_both);
    if (may_have_passed()) return false;
    if (e <= 1.0 && passed_switch) return true;
    if (e <= 1.0) {
      before = middle_of_both;
      std::swap(next, short_of);
    } else if (failed_behind_switch()) {
      behind = middle_of_both;
      std::swap(next, beyond);
    } else if (before > 0.0) {
      std::swap(next, short_of);
      h = before;
      return true;
    } else {
      return false;
    }
    ++failures;
  }
  const bool resolved = behind - before > shortest();
  if (!resolved) end = why_not_over(before > 0.0 ? short_of : to);
  if (before == 0.0) throw *end;
  over = behind - before;
  std::swap(next, short_of);
  return true;
}

/// Why no step from a node, however short, leads over the switch in front of it. `next` goes straight on to
/// where it is clearly behind.
StepFailure ErkStepper::RungeKutta::why_not_over(Node& before) {
  const auto [v, v_dot] = halves(next.va);
  double ahead = shortest();
  do {
    ahead *= 2.0;
    next.t = before.t + ahead;
    for (std::size_t i = 0; i < n; ++i) {
      next.q[i] = before.q[i] + ahead * before.va[i];
      v[i] = before.va[i] + ahead * before.va[n + i];
    }
    if (!manifold.accelerate({next.t, next.q, v}, v_dot)) break;
    find_side(next);
  } while (ahead < usual && switches.same(before.side, next.side));
  const auto friction = switches.turned(before.side, next.side);
  return {(friction ? switches.friction(*friction) : std::string("the motion")) +
              " switches here, and no solution continues: either both sides drive the motion back to the "
              "switch, or it jumps by more than double precision resolves. Smooth the switch, or end the run "
              "here",
          before.t};
}

/// After a step over a switch, whether the motion behind it leads back to it at once, as it led to it from
/// the other side (Filippov): then neither of the two goes on.
bool ErkStepper::RungeKutta::driven_back() {
  const double jump = effect_of_switch(from, to, 1.0);
  for (double ahead = 4.0 * (to.t - from.t); ahead < 1e-3 * usual; ahead *= 8.0) {
    next.t = to.t + ahead;
    const auto [v, v_dot] = halves(next.va);
    for (std::size_t i = 0; i < n; ++i) {
      next.q[i] = to.q[i] + ahead * (to.va[i] + 0.5 * ahead * to.va[n + i]);
      v[i] = to.va[i] + ahead * to.va[n + i];
    }
    if (!manifold.accelerate({next.t, next.q, v}, v_dot)) return false;
    find_side(next);
    if (switches.returns(from.side, to.side, next.side))
      return effect_of_switch(from, next, 1.0) < 0.5 * jump;
  }
  return false;
}

/// After a step over a switch.
void ErkStepper::RungeKutta::go_on_behind() {
  h = usual;
  extrapolation.forget();
  extrapolation.remember(to.t, halves(to.va).second);
  const auto friction = switches.turned(from.side, to.side);
  if (!friction || !driven_back()) return;
  read(from, before_switch);
  read(to, behind_switch);
  if (sticking->jumps(before_switch, behind_switch, *friction))
    end = StepFailure{sticking->would_stick(*friction), to.t};
}

void ErkStepper::RungeKutta::read(const Node& node, Motion& out) const {
  const auto half = node.va.begin() + static_cast<std::ptrdiff_t>(n);
  out.t = node.t;
  out.q = node.q;
  out.v.assign(node.va.begin(), half);
  out.a.assign(half, node.va.end());
}

/// Before the first step: on which side it begins. A friction law has no direction where nothing slides yet.
void ErkStepper::RungeKutta::find_first_side() {
  read(to, before_switch);
  const Departure departure = sticking->leave(before_switch.instant(), before_switch.a, to.side);
  if (departure.held_by) throw StepFailure{sticking->would_stick(*departure.held_by), to.t};
  if (departure.from_rest) std::ranges::copy(departure.a, halves(to.va).second.begin());
}

}  // namespace dalembert
