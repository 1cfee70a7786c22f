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

ErkStepper::FrictionSwitches::FrictionSwitches(RungeKutta& method, const System& system)
    : rk_(method), switches_(system), multipliers_(system.rows()) {}

void ErkStepper::FrictionSwitches::make_room(const Problem& problem, const Start& start) {
  if (switches_.any()) sticking_.emplace(problem, start, rk_.errors.tolerance());
  short_of_ = beyond_ = rk_.to;
  for (Slope* side : {&rk_.from.side, &rk_.to.side, &rk_.middle.side, &rk_.next.side, &short_of_.side,
                      &beyond_.side, &stage_side_, &behind_side_})
    switches_.make_room(*side);
}

/// Which side `node` is on, with the multipliers that its acceleration was found with.
void ErkStepper::FrictionSwitches::find_side(Node& node) {
  rk_.manifold.multipliers(multipliers_);
  switches_.find(node.instant(), multipliers_, node.side);
}

void ErkStepper::FrictionSwitches::find_side_again() {
  if (!any()) return;
  std::vector<double> unused(rk_.n);
  rk_.require(rk_.manifold.accelerate(rk_.to.instant(), unused));
  find_side(rk_.to);
}

/// Whether a stage of a step from `to` lies behind a switch.
void ErkStepper::FrictionSwitches::check_switch(std::size_t i, double t) {
  if (!counts(i)) return;
  rk_.manifold.multipliers(multipliers_);
  switches_.find({t, rk_.stages[i].q, rk_.stages[i].v}, multipliers_, stage_side_);
  passed_rest_ = passed_rest_ || switches_.slide_turned(rk_.to.side, stage_side_);
  if (switches_.same(rk_.to.side, stage_side_)) return;
  if (passed_switch_ && !switches_.same(behind_side_, stage_side_)) passed_several_ = true;
  passed_switch_ = true;
  std::swap(behind_side_, stage_side_);
}

bool ErkStepper::FrictionSwitches::differs(const Instant& at) {
  if (!switches_.any()) return false;
  rk_.manifold.multipliers(multipliers_);
  switches_.find(at, multipliers_, stage_side_);
  return switches_.rests(stage_side_) || !switches_.same(rk_.to.side, stage_side_);
}

/// After a step that failed, whether it passed a switch. Its end may lie off the constraints.
bool ErkStepper::FrictionSwitches::failed_behind_switch() {
  if (!switches_.any()) return false;
  if (passed_switch_) return true;
  try {
    if (!rk_.manifold.accelerate(rk_.next.instant(), rk_.next.a())) return false;
    find_side(rk_.next);
  } catch (const EquationFault&) {
    return false;
  }
  return !switches_.same(rk_.to.side, rk_.next.side);
}

double ErkStepper::FrictionSwitches::effect_of_switch(const Node& a, const Node& b, double step) {
  return rk_.errors.of_jump(most_weight * step, a, b);
}

/// That is known if all behind it lies on the side on which the step ends. So it is with a rest of what
/// slides: a step that ends behind it the run takes again; one that only has stages there shows nothing, and
/// is wrong.
double ErkStepper::FrictionSwitches::error_of_switch(double step) {
  if (!any()) return 0.0;
  find_side(rk_.next);
  if (passed_rest_ && !switches_.slide_turned(rk_.to.side, rk_.next.side))
    return std::numeric_limits<double>::infinity();
  const bool ends_behind = !switches_.same(rk_.to.side, rk_.next.side);
  if (passed_switch_ && (passed_several_ || !ends_behind || !switches_.same(behind_side_, rk_.next.side)))
    return std::numeric_limits<double>::infinity();
  passed_switch_ = ends_behind;
  return ends_behind ? effect_of_switch(rk_.to, rk_.next, step) : 0.0;
}

bool ErkStepper::FrictionSwitches::stop_short(double step) {
  if (!failed_behind_switch()) return false;
  double before = 0.0, behind = step;
  std::swap(rk_.next, beyond_);
  while (behind - before > rk_.shortest()) {
    if (before > 0.0 && effect_of_switch(short_of_, beyond_, behind - before) <= 1.0) break;
    const double middle_of_both = 0.5 * (before + behind);
    const double e = rk_.attempt(middle_of_both);
    if (rk_.singular.may_have_passed()) return false;
    if (e <= 1.0 && passed_switch_) return true;
    if (e <= 1.0) {
      before = middle_of_both;
      std::swap(rk_.next, short_of_);
    } else if (failed_behind_switch()) {
      behind = middle_of_both;
      std::swap(rk_.next, beyond_);
    } else if (before > 0.0) {
      std::swap(rk_.next, short_of_);
      rk_.h = before;
      return true;
    } else {
      return false;
    }
    ++rk_.failures;
  }
  const bool resolved = behind - before > rk_.shortest();
  if (!resolved) end = why_not_over(before > 0.0 ? short_of_ : rk_.to);
  if (before == 0.0) throw *end;
  over = behind - before;
  std::swap(rk_.next, short_of_);
  return true;
}

/// Why no step from a node, however short, leads over the switch in front of it. `next` goes straight on to
/// where it is clearly behind.
StepFailure ErkStepper::FrictionSwitches::why_not_over(Node& before) {
  const auto q = rk_.next.q(), v = rk_.next.v();
  double ahead = rk_.shortest();
  do {
    ahead *= 2.0;
    rk_.next.t = before.t + ahead;
    for (std::size_t i = 0; i < rk_.n; ++i) {
      q[i] = before.q()[i] + ahead * before.v()[i];
      v[i] = before.v()[i] + ahead * before.a()[i];
    }
    if (!rk_.manifold.accelerate(rk_.next.instant(), rk_.next.a())) break;
    find_side(rk_.next);
  } while (ahead < rk_.usual && switches_.same(before.side, rk_.next.side));
  const auto friction = switches_.turned(before.side, rk_.next.side);
  return {(friction ? switches_.friction(*friction) : std::string("the motion")) +
              " switches here, and no solution continues: either both sides drive the motion back to the "
              "switch, or it jumps by more than double precision resolves. Smooth the switch, or end the run "
              "here",
          before.t};
}

/// After a step over a switch, whether the motion behind it leads back to it at once, as it led to it from
/// the other side (Filippov): then neither of the two goes on.
bool ErkStepper::FrictionSwitches::driven_back() {
  const double jump = effect_of_switch(rk_.from, rk_.to, 1.0);
  for (double ahead = 4.0 * (rk_.to.t - rk_.from.t); ahead < 1e-3 * rk_.usual; ahead *= 8.0) {
    rk_.next.t = rk_.to.t + ahead;
    const auto q = rk_.next.q(), v = rk_.next.v();
    for (std::size_t i = 0; i < rk_.n; ++i) {
      q[i] = rk_.to.q()[i] + ahead * (rk_.to.v()[i] + 0.5 * ahead * rk_.to.a()[i]);
      v[i] = rk_.to.v()[i] + ahead * rk_.to.a()[i];
    }
    if (!rk_.manifold.accelerate(rk_.next.instant(), rk_.next.a())) return false;
    find_side(rk_.next);
    if (switches_.returns(rk_.from.side, rk_.to.side, rk_.next.side))
      return effect_of_switch(rk_.from, rk_.next, 1.0) < 0.5 * jump;
  }
  return false;
}

void ErkStepper::FrictionSwitches::go_on_behind_switch() {
  if (switches_.same(rk_.from.side, rk_.to.side)) return;
  rk_.h = rk_.usual;
  rk_.singular.forget();
  rk_.singular.remember(rk_.to.t, rk_.to.a());
  const auto friction = switches_.turned(rk_.from.side, rk_.to.side);
  if (!friction || !driven_back()) return;
  read(rk_.from, before_switch_);
  read(rk_.to, behind_switch_);
  if (sticking_->jumps(before_switch_, behind_switch_, *friction))
    end = StepFailure{sticking_->would_stick(*friction), rk_.to.t};
}

void ErkStepper::FrictionSwitches::read(const Node& node, Motion& out) const {
  const auto q = node.q(), v = node.v(), a = node.a();
  out.t = node.t;
  out.q.assign(q.begin(), q.end());
  out.v.assign(v.begin(), v.end());
  out.a.assign(a.begin(), a.end());
}

void ErkStepper::FrictionSwitches::find_first_side() {
  if (!switches_.any()) return find_side_again();
  read(rk_.to, before_switch_);
  const Departure departure = sticking_->leave(before_switch_.instant(), before_switch_.a, rk_.to.side);
  if (departure.held_by) throw StepFailure{sticking_->would_stick(*departure.held_by), rk_.to.t};
  if (departure.from_rest) std::ranges::copy(departure.a, rk_.to.a().begin());
}

}  // namespace dalembert
