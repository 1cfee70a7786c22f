#include "dalembert/solvers/run/diagnosis.h"

#include <dalembert/core/results/applied_forces.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

namespace dalembert {

namespace {

/// A force of about 1 in these units turns a body around within the scene's time. Unequal masses or lengths
/// can explain hundreds.
constexpr double unexplained = 1e4;
/// Times known only to this fraction of the scene's own are worth a warning.
constexpr double too_coarse = 1e-10;
/// Roundings of time in a step, at the least, of which the scene's own time is one.
constexpr double least_resolved = 16.0;

}  // namespace

std::string unbounded_multiplier(const System& system, const Scales& scales, std::span<const double> w,
                                 std::span<const double> lambda, std::span<const double> lambda_at_start) {
  const auto lengths = scales.lengths();
  double most = unexplained;
  std::optional<std::size_t> row;
  for (std::size_t r = 0; r < lambda.size(); ++r) {
    const double unit = impulse_of_row(system, w, lengths, r, scales.speed()) / scales.time;
    const double size = std::abs(lambda[r]) / std::max(unit, std::abs(lambda_at_start[r]));
    if (!(size > most)) continue;
    most = size;
    row = r;
  }
  if (!row) return {};
  std::ostringstream what;
  what << "the multiplier of " << system.row_label(*row) << " has grown to " << lambda[*row];
  if (const auto hint = system.singular_hint(*row); !hint.empty()) what << " (singular if " << hint << ')';
  return what.str();
}

namespace {

/// What belongs to one particle or rotor: its first coordinate, how many there are, and its mass, or none.
struct Mover {
  std::string name;
  int first;
  std::size_t size;
  double mass;
};

std::vector<Mover> movers(const Layout& layout) {
  std::vector<Mover> all;
  for (const auto& p : layout.particles)
    all.push_back({p.name, p.coordinate, static_cast<std::size_t>(layout.dimension), p.mass});
  for (const auto& r : layout.rotors) all.push_back({r.name, r.coordinate, 1, 0.0});
  return all;
}

std::string place_of(const Mover& mover, std::span<const double> q) {
  std::ostringstream text;
  text << mover.name << " at (";
  for (std::size_t k = 0; k < mover.size; ++k)
    text << (k > 0 ? ", " : "") << q[static_cast<std::size_t>(mover.first) + k];
  text << ')';
  return text.str();
}

double norm(const std::vector<double>& x) {
  double square = 0.0;
  for (const double entry : x) square += entry * entry;
  return std::sqrt(square);
}

/// A displacement of every coordinate, in no special direction.
std::vector<double> displacement(const Scales& scales, std::size_t coordinates, double length) {
  std::vector<double> along(coordinates);
  for (std::size_t i = 0; i < coordinates; ++i)
    along[i] = std::cos(static_cast<double>(i + 1)) * length * scales.unit(i) / scales.length;
  return along;
}

/// The largest force on a mover, in units of what turns it around within the scene's time, of those that
/// change as much within a small part of the scene's length. (A very stiff spring does not.)
std::string grown_force(const System& system, const Scales& scales, const Instant& at) {
  const Layout& layout = *system.layout();
  const std::vector<double> none(system.rows(), std::numeric_limits<double>::quiet_NaN());
  const auto all = movers(layout);
  std::vector<double> q = displacement(scales, at.q.size(), scales.length / unexplained);
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += at.q[i];
  const Instant moved{at.t, q, at.v};
  double most = unexplained;
  std::string what;
  for (std::size_t f = 0; f < layout.forces.size(); ++f) {
    for (const Mover& mover : all) {
      std::vector<double> force(mover.size);
      if (!layout.applied->on(f, at, none, mover.first, mover.mass, force)) continue;
      const auto first = static_cast<std::size_t>(mover.first);
      const double unit = system.masses()[first] * scales.unit(first) / scales.time / scales.time;
      std::vector<double> beside(mover.size);
      if (!layout.applied->on(f, moved, none, mover.first, mover.mass, beside)) continue;
      const double size = norm(force);
      for (std::size_t k = 0; k < force.size(); ++k) beside[k] -= force[k];
      if (!(size > most * unit && norm(beside) > 0.5 * size)) continue;
      most = size / unit;
      std::ostringstream text;
      text << "the force of " << layout.forces[f].label() << " has grown to " << size << " on "
           << place_of(mover, at.q) << ": it is singular there, or nearly";
      what = text.str();
    }
  }
  return what;
}

/// How much the gradients of the rows turn per length, along a displacement of every coordinate.
std::string turning_gradient(const System& system, const Scales& scales, const Instant& at) {
  const auto lengths = scales.lengths();
  const std::vector<double> along = displacement(scales, at.q.size(), 1.0);
  const Instant moved{at.t, at.q, along};
  auto e = system.evaluation();
  auto change = system.linearisation();
  system.evaluate(moved, e);
  system.linearise_constraints(moved, std::vector<double>(system.rows()), change);
  double most = unexplained;
  std::optional<std::size_t> row;
  for (std::size_t r = 0; r < system.rows(); ++r) {
    double gradient = 0.0, turn = 0.0;
    for (const std::size_t k : system.row(r)) {
      const double of_length = 1.0 / lengths[system.w_columns()[k]];
      gradient = std::hypot(gradient, of_length * e.w[k]);
      turn = std::hypot(turn, of_length * change.psi_q[k]);
    }
    if (!system.in_force(r) || !(turn * scales.length > most * gradient)) continue;
    most = turn * scales.length / gradient;
    row = r;
  }
  if (!row) return {};
  std::ostringstream what;
  what << "the equation of " << system.row_label(*row)
       << " is singular here, or nearly: its gradient turns within " << scales.length / most;
  for (const Mover& mover : movers(*system.layout()))
    for (const std::size_t k : system.row(*row))
      if (static_cast<int>(system.w_columns()[k]) == mover.first) {
        what << ", " << place_of(mover, at.q);
        break;
      }
  return what.str();
}

}  // namespace

std::string singular_here(const System& system, const Scales& scales, const Instant& at) try {
  const std::string force = grown_force(system, scales, at);
  return force.empty() ? turning_gradient(system, scales, at) : force;
} catch (...) {
  return {};  // the run is stopping: what stops it is known already
}

namespace {

/// States that differ in one velocity, or in one position.
class Beside {
 public:
  Beside(const Instant& at, std::size_t coordinate, bool in_velocity)
      : t_(at.t),
        q_(at.q.begin(), at.q.end()),
        v_(at.v.begin(), at.v.end()),
        x_(in_velocity ? &v_[coordinate] : &q_[coordinate]) {}
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  [[nodiscard]] double x() const { return *x_; }
  /// With another one; up to the next call.
  [[nodiscard]] Instant with(double x) {
    *x_ = x;
    return {t_, q_, v_};
  }

 private:
  double t_;
  std::vector<double> q_, v_;
  double* x_;
};

/// A velocity or position of a coordinate, and its force there.
struct Place {
  double x, force;
};

/// Between which places, no farther than this from that of coordinate i, its force jumps from forward to
/// backward: a smooth one changes by less and less where they are bisected. Nothing if it does not.
std::optional<std::pair<Place, Place>> reversal(const System& system, Beside& beside, std::size_t i,
                                                double distance) {
  constexpr int halvings = 30;  // 20 and 40 tell the same apart
  auto e = system.evaluation();
  const auto at = [&](double x) {
    system.evaluate(beside.with(x), e);
    return Place{x, e.force[i]};
  };
  const double here = beside.x();
  Place low = at(here - distance), high = at(here + distance);
  if (!(low.force > 0.0 && high.force < 0.0)) return std::nullopt;
  const double all = low.force - high.force;
  for (int k = 0; k < halvings; ++k) {
    const Place middle = at(0.5 * (low.x + high.x));
    (low.force - middle.force > middle.force - high.force ? high : low) = middle;
  }
  if (low.force - high.force > 0.5 * all) return std::pair(low, high);
  return std::nullopt;
}

/// The force on coordinate i of a mover that changes most from one place to another.
std::string changing_force(const System& system, Beside& beside, const Mover& mover, std::size_t i,
                           double from, double to) {
  const Layout& layout = *system.layout();
  const std::vector<double> none(system.rows(), std::numeric_limits<double>::quiet_NaN());
  std::vector<double> force(mover.size);
  const std::size_t k = i - static_cast<std::size_t>(mover.first);
  const auto at = [&](std::size_t f, double x) {
    return layout.applied->on(f, beside.with(x), none, mover.first, mover.mass, force) ? force[k] : 0.0;
  };
  double most = 0.0;
  std::string label;
  for (std::size_t f = 0; f < layout.forces.size(); ++f) {
    const double change = std::abs(at(f, to) - at(f, from));
    if (!(change > most)) continue;
    most = change;
    label = layout.forces[f].label();
  }
  return label;
}

}  // namespace

std::string force_that_jumps(const System& system, const Instant& at, std::size_t coordinate,
                             double distance) try {
  for (const Mover& mover : movers(*system.layout())) {
    const auto first = static_cast<std::size_t>(mover.first);
    if (coordinate < first || coordinate >= first + mover.size) continue;
    Beside beside(at, coordinate, false);
    const auto jump = reversal(system, beside, coordinate, distance);
    if (jump) return changing_force(system, beside, mover, coordinate, jump->first.x, jump->second.x);
  }
  return {};
} catch (...) {
  return {};  // it is a message that would say it
}

std::string chattering_force(const System& system, const Scales& scales, const Instant& at, double step,
                             double tolerance) try {
  for (const Mover& mover : movers(*system.layout())) {
    for (std::size_t k = 0; k < mover.size; ++k) {
      const std::size_t i = static_cast<std::size_t>(mover.first) + k;
      const double v = at.v[i], error = scales.velocity_error(i, v, tolerance);
      Beside beside(at, i, true);
      const auto jump =
          reversal(system, beside, i, scales.velocity_error(i, v, Accuracy(tolerance).of_forces()));
      if (!jump) continue;
      const auto& [low, high] = *jump;
      const double in_a_step = step * std::max(low.force, -high.force) / system.masses()[i];
      if (std::max(low.x - v, v - high.x) > in_a_step + error) continue;
      const std::string force = changing_force(system, beside, mover, i, low.x, high.x);
      if (force.empty()) continue;
      std::ostringstream text;
      text << "the force of " << force << " jumps where " << mover.name << " has the velocity "
           << (std::abs(low.x) > error ? low.x : 0.0)
           << " and drives it back there from both sides, as dry friction does: it would chatter. Smooth the "
              "jump, as by tanh of the velocity, or end the run here";
      return text.str();
    }
  }
  return {};
} catch (...) {
  return {};  // no reason is known: the run goes on
}

bool resolves_motion(const Scales& scales, double time) {
  return least_resolved * epsilon * std::abs(time) <= scales.time;
}

std::string coarse_time(const Scales& scales, double time) {
  const double resolution = epsilon * std::abs(time);
  if (resolution <= too_coarse * scales.time) return {};
  std::ostringstream what;
  what << "double precision resolves times here only to " << resolution
       << ": choose t_start and t_end closer to 0";
  return what.str();
}

std::string coarse_steps(double accuracy) {
  if (accuracy < 1.0) return {};
  std::ostringstream what;
  what << "the errors of all steps add up to " << accuracy
       << " times the scene's length, so that the results say nothing; ask for a tighter tolerance";
  return what.str();
}

}  // namespace dalembert
