#include "dalembert/solvers/equilibrium/floquet.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/equilibrium/disturbances.h>
#include <dalembert/solvers/integrator.h>
#include <dalembert/solvers/linear/rows.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Of the periodic motion, and of the monodromy matrix.
constexpr double tolerance = 1e-12, known = 1e-11;
/// A deviation after a period that is more than the error of the steps.
constexpr double returned = 1e-6;
constexpr int most_step_halvings = 14;
/// Instants at which a period is checked; the fractions of it at which they are belong to no period of its
/// own.
constexpr int checks = 48;

void require_suited(const System& system, double period) {
  if (!(std::isfinite(period) && period > 0.0)) {
    std::ostringstream what;
    what << "Floquet multipliers of scene \"" << system.layout()->scene << "\": period = " << period
         << ", must be finite and > 0";
    throw InvalidArgument(what.str());
  }
  if (const auto label = system.conditional_label(); !label.empty())
    throw InvalidScene("Floquet multipliers: " + label +
                       " does not always hold; they are defined for scenes without such constraints");
  if (system.forces().has_friction())
    throw InvalidScene("Floquet multipliers: " + system.forces().owner_of_friction(0) +
                       " reads a multiplier; they are defined for scenes without such forces");
}

/// The ends of a period, and instants between that no part of it divides: multiples of the golden section.
std::vector<double> check_times(double period) {
  std::vector<double> times{0.0, period};
  for (int k = 1; k <= checks; ++k) times.push_back(period * std::fmod(k * std::numbers::phi, 1.0));
  std::ranges::sort(times);
  return times;
}

/// Multipliers that have no effect within the period do not differ: what they act on they would move by less
/// than `returned` of the scene's length. Such are those of springs at rest, which are round-off.
std::vector<double> multipliers_with_effect(const System& system, const Record& motion) {
  const FlatSample first = motion.sample(0), last = motion.sample(motion.times.size() - 1);
  const double period = last.time - first.time, length = motion.statistics.length;
  auto e = system.evaluation();
  system.evaluate({first.time, first.q, first.v}, e);
  const auto is_angle = system.angles();
  std::vector<double> lambda(last.lambda.begin(), last.lambda.end());
  for (std::size_t r = 0; r < lambda.size(); ++r) {
    double acceleration = 0.0;
    for (const std::size_t k : system.row(r)) {
      const std::size_t i = system.w_columns()[k];
      const double of_one = std::abs(e.w[k]) / system.masses()[i] * (is_angle[i] ? length : 1.0);
      acceleration = std::max(acceleration, of_one * std::abs(last.lambda[r] - first.lambda[r]));
    }
    if (acceleration * period * period <= returned * length) lambda[r] = first.lambda[r];
  }
  return lambda;
}

/// Throws unless the motion ends as it began; wheels may have turned round.
void require_return(const System& system, const Record& motion) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  const FlatSample first = motion.sample(0), last = motion.sample(motion.times.size() - 1);
  const auto compare = [&](std::span<const double> a, std::span<const double> b, double scale,
                           const char* what) {
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i]));
    if (off <= returned * scale) return;
    std::ostringstream text;
    text << "Scene \"" << motion.layout->scene << "\" is not periodic: after " << last.time << ' ' << what
         << " differ by " << off << "; begin on the periodic motion, and give its whole period";
    throw NoEquilibrium(text.str());
  };
  double force = 0.0;
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    for (const double l : motion.sample(i).lambda) force = std::max(force, std::abs(l));
  }
  const double length = motion.statistics.length, time = motion.statistics.time;
  // An angle of 1 counts as the scene's length.
  std::vector<double> q(last.q.begin(), last.q.end()), v(last.v.begin(), last.v.end());
  for (const auto& rotor : motion.layout->rotors) {
    const auto i = static_cast<std::size_t>(rotor.coordinate);
    q[i] = first.q[i] + length * std::remainder(q[i] - first.q[i], full_turn);
    v[i] = first.v[i] + length * (v[i] - first.v[i]);
  }
  compare(first.q, q, length, "positions");
  compare(first.v, v, length / std::min(time, last.time), "velocities");
  compare(first.lambda, multipliers_with_effect(system, motion), force, "multipliers");
}

[[noreturn]] void refuse_period(const System& system, const std::string& what, double t, double period) {
  std::ostringstream text;
  text << "Scene \"" << system.layout()->scene << "\": " << what << " differ between t = " << t << " and "
       << t + period << ", so " << period << " is not their period; give their whole period";
  throw NoEquilibrium(text.str());
}

/// Positions a period later: those of now, with the whole turns that rotors have made.
std::vector<double> positions_later(const Record& motion, std::span<const double> now) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  const FlatSample first = motion.sample(0), last = motion.sample(motion.times.size() - 1);
  std::vector<double> q(now.begin(), now.end());
  for (const auto& rotor : motion.layout->rotors) {
    const auto i = static_cast<std::size_t>(rotor.coordinate);
    q[i] += full_turn * std::round((last.q[i] - first.q[i]) / full_turn);
  }
  return q;
}

/// Throws unless the equations are the same a period later, in the same state of motion.
void require_same_equations(const System& system, const Record& motion, const FlatSample& now,
                            double period) {
  auto e = system.evaluation(), later = e;
  system.evaluate({now.time, now.q, now.v}, e);
  system.evaluate({now.time + period, positions_later(motion, now.q), now.v}, later);
  const double length = motion.statistics.length;
  std::vector<double> lengths(now.q.size(), 1.0);
  for (const auto& rotor : system.layout()->rotors)
    lengths[static_cast<std::size_t>(rotor.coordinate)] = length;
  double off = 0.0, size = length / (period * period);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double m = system.masses()[i] / lengths[i];
    off = std::max(off, std::abs(later.force[i] - e.force[i]) / m);
    size = std::max(size, std::abs(e.force[i]) / m);
  }
  if (off > returned * size) refuse_period(system, "the forces", now.time, period);
  for (std::size_t r = 0; r < system.holonomic_rows(); ++r) {
    if (std::abs(later.g[r] - e.g[r]) > returned * length * gradient_length(system, e.w, lengths, r))
      refuse_period(system, "the positions of " + system.row_label(r), now.time, period);
  }
  for (std::size_t r = 0; r < system.rows(); ++r) {
    const double speed = length / std::min(motion.statistics.time, period);
    if (std::abs(later.psi[r] - e.psi[r]) > returned * speed * gradient_length(system, e.w, lengths, r))
      refuse_period(system, "the velocities of " + system.row_label(r), now.time, period);
  }
}

/// And unless they respond to a disturbance as before. In units of the period what is smaller than 1 has no
/// effect within it.
void require_same_response(const System& system, const Disturbances& now, const Disturbances& later, double t,
                           double period) {
  const auto differ = [](const MatrixXd& a, const MatrixXd& b) {
    return (a - b).norm() > returned * std::max({a.norm(), b.norm(), 1.0});
  };
  if (differ(now.K, later.K)) refuse_period(system, "the derivatives of the forces", t, period);
  if (differ(now.C, later.C)) refuse_period(system, "the damping forces", t, period);
  if (differ(now.W, later.W) || differ(now.E, later.E)) refuse_period(system, "the constraints", t, period);
}

void require_period(const System& system, const Record& motion, const ActiveRows& rows, double period) {
  const FlatSample first = motion.sample(0), last = motion.sample(motion.times.size() - 1);
  require_same_response(system, {system, rows, first, period}, {system, rows, last, period}, 0.0, period);
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    const FlatSample now = motion.sample(i);
    const std::vector<double> q = positions_later(motion, now.q);
    FlatSample later = now;
    later.time += period;
    later.q = q;
    require_same_equations(system, motion, now, period);
    require_same_response(system, {system, rows, now, period}, {system, rows, later, period}, now.time,
                          period);
  }
}

/// The sides of what the equations compare at an instant of the motion, and the forces there on given sides.
Branches::Sides sides_at(const System& system, const FlatSample& at) {
  Branches::Sides sides;
  const Branches listening(&sides, nullptr);
  auto e = system.evaluation();
  system.evaluate({at.time, at.q, at.v}, e);
  return sides;
}
std::vector<double> forces_on(const Branches::Sides& sides, const System& system, const FlatSample& at) {
  const Branches holding(nullptr, &sides);
  auto e = system.evaluation();
  system.evaluate({at.time, at.q, at.v}, e);
  return e.force;
}
bool same(const Branches::Sides& a, const Branches::Sides& b) {
  const auto one = [](const Branches::Comparison& x, const Branches::Comparison& y) {
    return x.side == y.side && x.piece == y.piece;
  };
  return std::ranges::equal(a, b,
                            [&](const auto& x, const auto& y) { return std::ranges::equal(x, y, one); });
}

/// Throws where forces jump between two of these times: a disturbance jumps there, too, as it changes the
/// time of the jump, and that is in no derivative.
void require_no_jump(const System& system, const Record& motion, const std::vector<double>& times) {
  const auto read = [&motion](const std::vector<double>& at) {
    Record record;
    record.layout = motion.layout;
    motion.dense->read(at, record);
    return record;
  };
  const Record all = read(times);
  double size = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i)
    for (const double F : forces_on({}, system, all.sample(i))) size = std::max(size, std::abs(F));
  auto before = sides_at(system, all.sample(0));
  for (std::size_t i = 1; i < times.size(); ++i) {
    const auto here = std::exchange(before, sides_at(system, all.sample(i)));
    if (same(here, before)) continue;
    double a = times[i - 1], b = times[i];
    for (int k = 0; k < std::numeric_limits<double>::digits; ++k) {
      const double middle = 0.5 * (a + b);
      (same(here, sides_at(system, read({middle}).sample(0))) ? a : b) = middle;
    }
    const Record there = read({a, b});
    const auto F = forces_on(here, system, there.sample(0)),
               G = forces_on(sides_at(system, there.sample(1)), system, there.sample(0));
    for (std::size_t k = 0; k < F.size(); ++k) {
      if (std::abs(F[k] - G[k]) <= returned * size) continue;
      throw NoEquilibrium(
          "Floquet multipliers of scene \"" + motion.layout->scene +
          "\": its forces jump at t = " + std::to_string(a) +
          ", and with them a disturbance, which its linear equations do not tell; round them off");
    }
  }
}

/// The size of a disturbance, by its energy where the motion starts: sqrt(u^T (|K| + 1) u + w^T w). What
/// vibrates keeps it, however stiff it is, so that errors do not seem to grow with it.
class EnergyNorm {
 public:
  explicit EnergyNorm(const Disturbances& start) {
    const auto [values, vectors] = dense::symmetric_eigen(0.5 * (start.K + start.K.transpose()));
    metric_ = MatrixXd::Identity(2 * start.coordinates(), 2 * start.coordinates());
    metric_.topLeftCorner(start.coordinates(), start.coordinates()) +=
        vectors * values.cwiseAbs().asDiagonal() * vectors.transpose();
  }
  /// R with |R c| the size of x = B c, and its inverse.
  struct Root {
    MatrixXd root, inverse;
  };
  [[nodiscard]] Root of(const MatrixXd& B) const {
    const auto [values, vectors] = dense::symmetric_eigen(dense::restricted(B, metric_));
    const Eigen::VectorXd sizes = values.cwiseSqrt();
    return {vectors * sizes.asDiagonal() * vectors.transpose(),
            vectors * sizes.cwiseInverse().asDiagonal() * vectors.transpose()};
  }

 private:
  MatrixXd metric_;
};

/// The monodromy matrix, in a basis of the disturbances that the constraints allow, by steps that are halved
/// where a step and its two halves differ.
class Monodromy {
 public:
  Monodromy(const System& system, const Record& motion, const ActiveRows& rows, double period)
      : system_(&system),
        motion_(&motion),
        rows_(&rows),
        period_(period),
        norm_(Disturbances(system, rows, motion.sample(0), period)) {}

  struct Map {
    MatrixXd matrix;
    double error;  ///< of it, as a norm
    int steps;
  };
  [[nodiscard]] Map map() {
    const Step whole = steps({{0.0, 1.0}}).front();
    if (whole.start.basis.cols() == 0) return {};
    refine(whole, 0);
    const auto [c, error] = product();
    const MatrixXd back = whole.start.basis.transpose() * whole.nodes.back().basis;
    return {norm_.of(whole.start.basis).root * back * norm_.of(whole.nodes.back().basis).inverse * c, error,
            2 * static_cast<int>(maps_.size())};
  }
  /// At which the motion was looked at for that, in order.
  [[nodiscard]] std::vector<double> times() const {
    std::vector<double> all = times_;
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  /// Fractions of the period.
  struct Part {
    double from, to;
  };
  struct PartMap {
    MatrixXd matrix;
    double error;
  };
  struct Step {
    Part part;
    FreeDisturbances start;
    std::vector<FreeDisturbances> nodes;
    MatrixXd map;  ///< of R c
  };
  /// One step each over parts of the motion. (Reading it at all instants together costs least.)
  [[nodiscard]] std::vector<Step> steps(const std::vector<Part>& parts) {
    std::vector<double> times;
    for (const auto [from, to] : parts) {
      times.push_back(from * period_);
      for (const double c : radau_nodes) times.push_back((from + c * (to - from)) * period_);
      times.back() = to * period_;
    }
    times_.insert(times_.end(), times.begin(), times.end());
    Record read;
    read.layout = motion_->layout;
    motion_->dense->read(times, read);
    const auto at = [&](std::size_t i) {
      return FreeDisturbances(Disturbances(*system_, *rows_, read.sample(i), period_));
    };
    std::vector<Step> all;
    for (const Part part : parts) {
      std::size_t next = all.size() * (radau_nodes.size() + 1);
      Step step{part, at(next++), {}, {}};
      while (step.nodes.size() < radau_nodes.size()) step.nodes.push_back(at(next++));
      step.map = norm_.of(step.nodes.back().basis).root *
                 radau_step(step.start, step.nodes, part.to - part.from) * norm_.of(step.start.basis).inverse;
      all.push_back(std::move(step));
    }
    return all;
  }
  /// Two halves err by 1/(2^9 - 1) of their difference from the whole; the motion, and with it every rate, is
  /// known to `known` of itself.
  void refine(const Step& whole, int halvings) {
    const auto [from, to] = whole.part;
    const double middle = 0.5 * (from + to);
    const auto halves = steps({{from, middle}, {middle, to}});
    MatrixXd both = halves[1].map * halves[0].map;
    double rate = 1.0;
    for (const FreeDisturbances& node : whole.nodes)
      rate = std::max(rate, (norm_.of(node.across).root * node.rate * norm_.of(node.basis).inverse).norm());
    const double allowed = known * (to - from) * rate * std::max(1.0, both.norm());
    if ((both - whole.map).norm() <= (std::exp2(radau_order) - 1.0) * allowed) {
      maps_.push_back({std::move(both), allowed});
      return;
    }
    if (halvings == most_step_halvings)
      throw NoEquilibrium(
          "Floquet multipliers of scene \"" + motion_->layout->scene +
          "\" do not converge: its motion, or the stiffness of its forces, is not smooth at t = " +
          std::to_string(middle * period_) +
          ": smooth what switches there, or state as rigid what vibrates thousands of times in a period");
    refine(halves[0], halvings + 1);
    refine(halves[1], halvings + 1);
  }
  /// Of all maps: M_n ... M_1, and the sum of |M_n ... M_k+1| e_k |M_k-1 ... M_1|.
  struct Product {
    MatrixXd matrix;
    double error;
  };
  [[nodiscard]] Product product() const {
    const Index d = maps_.front().matrix.cols();
    std::vector<double> before;
    MatrixXd all = MatrixXd::Identity(d, d), after = all;
    for (const PartMap& one : maps_) {
      before.push_back(all.norm());
      all = one.matrix * all;
    }
    double error = 0.0;
    for (std::size_t k = maps_.size(); k-- > 0;) {
      error += after.norm() * maps_[k].error * before[k];
      after = after * maps_[k].matrix;
    }
    return {std::move(all), error};
  }

  const System* system_;
  const Record* motion_;
  const ActiveRows* rows_;
  double period_;
  EnergyNorm norm_;
  std::vector<PartMap> maps_{};  // of the parts of the period, in order
  std::vector<double> times_{};
};

/// The eigenvalues of a map that is known to `error`, each with its own, see the header.
Floquet multipliers_of(const MatrixXd& map, double error, int steps) {
  const auto [values, right] = dense::complex_eigen(map);
  const Eigen::MatrixXcd left = dense::inverse(right);
  struct Multiplier {
    std::complex<double> value;
    double error;
  };
  const auto d = static_cast<double>(values.size());
  const double most = std::pow(2.0 * map.norm() + error, 1.0 - 1.0 / d) * std::pow(error, 1.0 / d);
  std::vector<Multiplier> all;
  for (Index k = 0; k < values.size(); ++k) {
    const double own = d * error * left.row(k).norm() * right.col(k).norm();
    all.push_back({values[k], own < most ? own : most});
  }
  std::ranges::stable_sort(all, std::greater{}, [](const Multiplier& m) { return std::abs(m.value); });
  Floquet found{{}, steps, {}};
  for (const Multiplier& m : all) {
    found.multipliers.push_back(m.value);
    found.errors.push_back(m.error);
  }
  return found;
}

}  // namespace

Stability Floquet::stability() const {
  bool all_decay = true;
  for (std::size_t k = 0; k < multipliers.size(); ++k) {
    const double beyond = std::abs(multipliers[k]) - 1.0, error = k < errors.size() ? errors[k] : 0.0;
    if (beyond > error) return Stability::unstable;
    all_decay = all_decay && beyond < -error;
  }
  return all_decay ? Stability::stable : Stability::undecided;
}

Floquet find_multipliers(const std::function<System()>& system, std::span<const double> q,
                         std::span<const double> v, double period) {
  require_suited(system(), period);
  Integrator integrator(system(), q, v,
                        {.t_end = period,
                         .times = check_times(period),
                         .tolerance = tolerance,
                         .stepper = Stepper::erk,
                         .dense = true});
  const auto motion = integrator.run();
  const System& own = integrator.system();
  require_return(own, *motion);
  const FlatSample start = motion->sample(0);
  auto e = own.evaluation();
  own.evaluate({start.time, start.q, start.v}, e);
  const ActiveRows rows = independent_rows(own, e.w);
  require_period(own, *motion, rows, period);
  Monodromy monodromy(own, *motion, rows, period);
  const auto [matrix, error, steps] = monodromy.map();
  require_no_jump(own, *motion, monodromy.times());
  if (matrix.size() == 0) return {};  // nothing can move
  return multipliers_of(matrix, error, steps);
}

}  // namespace dalembert
