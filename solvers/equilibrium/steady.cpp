#include "dalembert/solvers/equilibrium/steady.h"

#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/equilibrium_solver.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/equilibrium/steady_equations.h>
#include <dalembert/solvers/equilibrium/symmetries.h>
#include <dalembert/solvers/equilibrium/tangent_modes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::span<const double> flat(const VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }
VectorXd vector_of(std::span<const double> x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size()));
}

/// Newton's iteration for (1) of the header.
class SteadySearch {
 public:
  SteadySearch(const Problem& problem, const Start& stated, const Start& start, double time,
               const std::vector<FlatKept>& keep)
      : problem_(problem),
        system_(&problem_.system()),
        time_(time),
        rows_(start.rows),
        scales_(start.scales),
        keep_(&keep),
        symmetries_(problem, start, time),
        q_(vector_of(start.q)),
        lambda_(vector_of(start.lambda)) {
    const VectorXd v = vector_of(start.v);
    decompose(v);
    require_symmetric(v);
    for (const FlatKept& one : keep) kept_.push_back(value(one, vector_of(stated.q), vector_of(stated.v)));
  }

  /// Below the root of round-off Newton's iteration leaves round-off: where nothing falls any more the state
  /// before is the one that is known best. What two roundings leave, of what is stated and of what follows,
  /// is stated exactly, and stays: beside a fast spin a correction by round-off displaces what is soft. So it
  /// is of each part of the scene that nothing couples to others: one may settle where another still moves.
  FoundSteady find() {
    constexpr int most_corrections = 50;
    constexpr double exact = 2.0 * epsilon;
    const std::size_t parts = problem_.islands().count;
    double before = std::numeric_limits<double>::infinity();
    std::vector<double> least(parts, before);
    std::vector<char> stays(parts);
    Known best{q_, lambda_, symmetries_.fields(q_) * y_};
    for (int i = 0; i < most_corrections; ++i) {
      SteadyEquations equations = linearised();
      const std::vector<double> unbalanced = equations.unbalanced();
      Known now{q_, lambda_, symmetries_.fields(q_) * y_};
      VectorXd balanced = lambda_;
      add(equations.balance(), 1.0, balanced);
      bool goes_back = false;
      for (std::size_t part = 0; part < parts; ++part) {
        if (stays[part]) continue;
        if (least[part] <= std::sqrt(epsilon) && !(unbalanced[part] < least[part])) {
          stays[part] = 1;
          goes_back = true;
        } else {
          least[part] = unbalanced[part];
          copy(part, {now.q, balanced, now.v}, best);
          stays[part] = least[part] <= exact;
        }
        if (stays[part]) copy(part, best, now);
      }
      std::tie(q_, lambda_) = std::tie(now.q, now.lambda);
      if (goes_back) decompose(now.v);
      if (std::ranges::find(stays, char{0}) == stays.end()) break;
      const auto step = equations.correction(stays);
      correct(step);
      if (step.size < epsilon || (step.size < 1e-9 && step.size >= 0.5 * before)) break;
      before = step.size;
    }
    decompose(symmetries_.fields(q_) * y_);
    return finished();
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw NoEquilibrium("Scene \"" + system_->layout()->scene + "\": no steady motion was found: " + why +
                        "; start closer to one, or keep fewer quantities");
  }

  /// The coefficients of given velocities. Where several give the same, parts turn as little as they can.
  void decompose(const VectorXd& v) {
    const MatrixXd X = symmetries_.fields(q_);
    y_ = VectorXd::Zero(symmetries_.size());
    if (y_.size() == 0) return;
    VectorXd root(q_.size());
    for (Index i = 0; i < root.size(); ++i)
      root[i] = std::sqrt(system_->masses()[static_cast<std::size_t>(i)]);
    y_ = dense::least_squares(root.asDiagonal() * X, root.asDiagonal() * v, rank_threshold);
    const MatrixXd same = dense::kernel(root.asDiagonal() * X, rank_threshold);
    if (same.cols() == 0) return;
    const MatrixXd turning = symmetries_.turning();
    y_ -= same * dense::least_squares(turning * same, turning * y_, rank_threshold);
  }

  /// Names what moves otherwise: of its velocity more than half is no symmetry's, so that no steady motion is
  /// near.
  void require_symmetric(const VectorXd& v) const {
    const VectorXd rest = v - symmetries_.fields(q_) * y_;
    const double rounding = start_tolerance * v.cwiseAbs().maxCoeff();
    const auto look = [&](const auto& all, int width) {
      for (const auto& one : all) {
        if (rest.segment(one.coordinate, width).norm() <=
            0.5 * v.segment(one.coordinate, width).norm() + rounding)
          continue;
        throw NoEquilibrium(
            "Scene \"" + system_->layout()->scene + "\": \"" + one.name +
            "\" moves as no symmetry of the scene carries on: a body must be round about the axis "
            "it spins about, with all that acts on it; ask for floquet multipliers of a motion "
            "that is periodic");
      }
    };
    look(system_->layout()->particles, system_->layout()->dimension);
    look(system_->layout()->rotors, 1);
  }

  /// Of positions and velocities: forces are known only of a motion that has been found.
  [[nodiscard]] double value(const FlatKept& one, const VectorXd& q, const VectorXd& v) const {
    const std::size_t n = system_->coordinates(), m = system_->rows(),
                      slots = system_->layout()->slot_coordinate.size();
    const std::vector<double> unknown(std::max({n, m, slots}), std::numeric_limits<double>::quiet_NaN());
    const std::span<const double> none(unknown);
    std::string why = "is no finite number of positions and velocities, which are all that it may read";
    try {
      const double x = one.value({time_, flat(q), flat(v), none.first(n), none.first(m), none.first(slots),
                                  std::numeric_limits<double>::quiet_NaN()});
      if (std::isfinite(x)) return x;
    } catch (const UndeterminedForce&) {
    } catch (const std::exception& error) {
      why = std::string("threw \"") + error.what() + '"';
    } catch (...) {
      why = "threw something that is no std::exception";
    }
    throw NoEquilibrium("Scene \"" + system_->layout()->scene + "\": \"" + one.name +
                        "\", which is to be kept, " + why);
  }

  struct Known {
    VectorXd q, lambda, v;
  };
  /// What a part has of it.
  void copy(std::size_t part, const Known& from, Known& to) const {
    const Islands& parts = problem_.islands();
    for (Index i = 0; i < q_.size(); ++i) {
      if (parts.of_coordinate[static_cast<std::size_t>(i)] != part) continue;
      to.q[i] = from.q[i];
      to.v[i] = from.v[i];
    }
    for (const std::size_t row : rows_.rows)
      if (parts.of_row(*system_, row) == part)
        to.lambda[static_cast<Index>(row)] = from.lambda[static_cast<Index>(row)];
  }

  [[nodiscard]] SteadyEquations linearised() const {
    SteadyEquations equations(*system_, problem_.islands(), symmetries_, scales_, rows_,
                              {time_, q_, lambda_, y_}, static_cast<Index>(keep_->size()));
    for (std::size_t k = 0; k < keep_->size(); ++k) {
      const double now = value((*keep_)[k], q_, symmetries_.fields(q_) * y_);
      equations.keep(static_cast<Index>(k), now - kept_[k], std::abs(now) + std::abs(kept_[k]),
                     gradient((*keep_)[k]));
    }
    return equations;
  }

  void correct(const SteadyEquations::Correction& step) {
    constexpr double longest = 0.2;
    if (!std::isfinite(step.size)) refuse("Newton's iteration diverges");
    const double part = step.size > longest ? longest / step.size : 1.0;
    q_ += part * step.q;
    y_ += part * step.y;
    add(step.lambda, part, lambda_);
  }

  void add(const VectorXd& of_rows, double part, VectorXd& lambda) const {
    for (std::size_t a = 0; a < rows_.size(); ++a)
      lambda[static_cast<Index>(rows_.rows[a])] += part * of_rows[static_cast<Index>(a)];
  }

  /// Of a kept quantity by q and y, by central differences.
  [[nodiscard]] Eigen::RowVectorXd gradient(const FlatKept& one) const {
    const Index n = q_.size();
    const double h = std::cbrt(epsilon);
    const auto at = [&](Index i, double by) {
      VectorXd q = q_, y = y_;
      (i < n ? q[i] : y[i - n]) += by;
      return value(one, q, symmetries_.fields(q) * y);
    };
    Eigen::RowVectorXd slope(n + y_.size());
    for (Index i = 0; i < slope.size(); ++i) {
      const double step = h * (i < n ? scales_.unit(static_cast<std::size_t>(i)) : 1.0 / scales_.time);
      slope[i] = (at(i, step) - at(i, -step)) / (2.0 * step);
    }
    return slope;
  }

  /// The most that a kept quantity changes by in a unit of the scene.
  [[nodiscard]] double change(const FlatKept& one) const {
    Eigen::RowVectorXd slope = gradient(one).cwiseAbs();
    for (Index i = 0; i < slope.size(); ++i)
      slope[i] *= i < q_.size() ? scales_.unit(static_cast<std::size_t>(i)) : 1.0 / scales_.time;
    return slope.size() > 0 ? slope.maxCoeff() : 0.0;
  }

  [[nodiscard]] FoundSteady finished() const {
    // What moves by less than round-off of a position in the scene's time rests.
    const bool rests = (symmetries_.fields(q_) * y_).cwiseAbs().maxCoeff() <=
                       roundings_of_a_sum * epsilon * scales_.length / scales_.time;
    const VectorXd y = rests ? VectorXd(VectorXd::Zero(y_.size())) : y_;
    auto motion = std::make_shared<UniformMotion>(symmetries_.motion(y));
    const VectorXd straight = symmetries_.fields(q_) * y;
    const double least = std::max(straight.cwiseAbs().maxCoeff() / scales_.length, 1.0 / scales_.time);
    if (motion->rate <= roundings_of_a_sum * epsilon * least) *motion = {{q_.size(), q_.size()}, straight};
    const MatrixXd same = symmetries_.commuting(q_, y), X = symmetries_.displacements(q_, same);
    motion->symmetric = X;
    motion->carried =
        symmetries_.displacements(q_, MatrixXd::Identity(symmetries_.size(), symmetries_.size()));
    const MatrixXd fixing = same * dense::kernel(X, rank_threshold);
    for (Index k = 0; k < fixing.cols(); ++k) motion->fixing.push_back(symmetries_.motion(fixing.col(k)).A);
    const EquilibriumSolver balance(problem_, flat(q_), time_, RotatingFrame(*motion), 0.0, scales_.time);
    EquilibriumSolver::State s = balance.start();
    std::ranges::copy(flat(lambda_), s.lambda.begin());
    balance.evaluate(s);
    if (!balance.is_equilibrium(s, equilibrium_tolerance)) refuse("forces do not balance");
    balance.require_lasting(s);
    const VectorXd v = vector_of(s.v);
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const double now = value((*keep_)[k], q_, v);
      if (std::abs(now - kept_[k]) >
          equilibrium_tolerance * std::max(change((*keep_)[k]), std::abs(kept_[k])))
        refuse("\"" + (*keep_)[k].name + "\" cannot be kept");
    }
    return {balance.record(s), std::move(motion)};
  }

  Problem problem_;
  const System* system_;
  double time_;
  ActiveRows rows_;
  Scales scales_;
  const std::vector<FlatKept>* keep_;
  Symmetries symmetries_;
  VectorXd q_, lambda_, y_;
  std::vector<double> kept_;
};

void require_frictionless(const System& system, const std::string& scene) {
  const auto refuse = [&](const std::string& label) {
    throw InvalidScene(
        scene + label +
        ": where friction sticks it takes any value up to its limit, and steady motions fill a "
        "region; leave it out to find the one without friction, or let a run come to one");
  };
  if (system.forces().has_friction()) refuse(system.forces().owner_of_friction(0) + " reads a multiplier");
  if (const auto rough = system.conditions().frictional_constraints(); !rough.empty())
    refuse(system.layout()->constraints[rough.front()].label());
}

void require_suited_to_steady(const System& system) {
  const std::string scene = "Steady motions of scene \"" + system.layout()->scene + "\": ";
  if (system.coordinates() > most_dense)
    throw InvalidScene(scene + "they are found up to " + std::to_string(most_dense) + " coordinates");
  if (system.rheonomic())
    throw InvalidScene(scene +
                       "a constraint changes with time; let what it drives turn freely, with its rate as "
                       "stated, or ask for floquet multipliers");
  require_frictionless(system, scene);
  for (const std::size_t c : system.conditions().released())
    throw InvalidScene(scene + system.layout()->constraints[c].label() +
                       " has been released and is not in force; put it back, or build the scene without it");
  if (const auto label = system.conditional_label(); !label.empty())
    throw InvalidScene(scene + label + " does not always hold; state it as a bilateral one");
}

}  // namespace

FoundSteady find_steady(System system, std::span<const double> q, std::span<const double> v, double time,
                        const std::vector<FlatKept>& keep, std::span<const double> beside, double longest) {
  if (!std::isfinite(time)) throw InvalidArgument("Option time of a steady motion must be finite");
  require_suited_to_steady(system);
  try {
    const Problem problem(std::move(system));
    const auto start_at = [&](std::span<const double> at, std::span<const double> rates) {
      return consistent_start(problem, at, rates,
                              {.t_end = time + longest, .t_start = time, .assemble = true});
    };
    const Start stated = start_at(q, v);
    if (beside.empty()) return SteadySearch(problem, stated, stated, time, keep).find();
    VectorXd there = vector_of(stated.q) + vector_of(beside.first(q.size())),
             rates = vector_of(stated.v) + vector_of(beside.subspan(q.size()));
    return SteadySearch(problem, stated, start_at(flat(there), flat(rates)), time, keep).find();
  } catch (const EquationFault& fault) {
    throw NoEquilibrium(fault.what());
  }
}

}  // namespace dalembert
