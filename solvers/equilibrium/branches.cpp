#include "dalembert/solvers/equilibrium/branches.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/equilibrium/singular_points.h>
#include <dalembert/solvers/equilibrium/steady_continuation.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t most_points = 5000, most_branches = 50;

void validate(const BranchOptions& o) {
  std::ostringstream what;
  if (!std::isfinite(o.from) || !std::isfinite(o.to) || o.from == o.to)
    what << "Options from = " << o.from << ", to = " << o.to << ": must be finite and different";
  if (!(o.step >= 1e-4 && o.step <= 0.5))
    what << "Option step = " << o.step << ": must lie between 1e-4 and 0.5";
  if (!what.str().empty()) throw InvalidArgument(what.str());
}

class Follower {
 public:
  Follower(const Corrector& corrector, const BranchOptions& options)
      : corrector_(corrector), step_(options.step), points_(corrector_, step_) {}

  FlatDiagram follow() {
    const auto along = corrector_.tangent(corrector_.begin());
    if (!along)
      throw InvalidScene(
          "The branch of equilibria has a fold where it is to begin, at option from; begin at "
          "another value, or go from `to` to `from`");
    starts_.push_back({corrector_.begin(), *along, no_bifurcation});
    for (std::size_t b = 0; b < starts_.size(); ++b) {
      if (b < most_branches)
        follow_branch(starts_[b]);
      else
        list_branch(starts_[b]);
    }
    return std::move(found_);
  }

 private:
  /// Where a branch begins, and in what direction it goes.
  struct Start {
    Node node;
    VectorXd along;
    std::size_t origin;
  };
  /// A null vector; of what symmetries carry into its opposite only one direction counts.
  struct Axis {
    VectorXd along;
    bool one_sided;
  };

  [[nodiscard]] BranchPoint<FlatEquilibrium> point(const Node& node) const {
    return {corrector_.parameter(node), node.state, node.stiffness.least};
  }
  static double& fraction(Node& node) { return node.x[node.x.size() - 1]; }

  void follow_branch(const Start start) {
    Branch<FlatEquilibrium> branch{{point(start.node)}, start.origin, BranchEnd::lost, {}};
    Node last = start.node;
    std::optional<Node> before;
    VectorXd along = start.along;
    double step = step_;
    bool away = false;  // from where it began
    way_ = 0.0;
    folded_ = false;
    while (step > constants.shortest_branch_step * step_) {
      Node guess = last;
      guess.x += step * along;
      const double end = fraction(guess), way = end - fraction(last);
      const bool at_end = (end >= 1.0 && way > 0.0) || (end <= 0.0 && way < 0.0);
      VectorXd normal = along;
      if (at_end) {  // the last point is at the end of the range
        normal.setZero();
        normal[normal.size() - 1] = 1.0;
        guess.x = last.x + (std::clamp(end, 0.0, 1.0) - fraction(last)) / way * step * along;
        fraction(guess) = std::clamp(end, 0.0, 1.0);
      }
      const auto next = corrector_.correct(guess, normal);
      if (!next || (next->x - last.x).norm() > 2.0 * step || !corrector_.lasts(*next)) {
        step *= 0.5;
        continue;
      }
      locate(before ? &*before : nullptr, last, *next, branch.why);
      branch.points.push_back(point(*next));
      if (next->x != last.x) along = (next->x - last.x).normalized();
      const double distance = (next->x - start.node.x).norm();
      away = away || distance > step_;
      if (at_end) branch.end = BranchEnd::range;
      if (away && distance < 0.5 * step_ && along.dot(start.along) > 0.0) branch.end = BranchEnd::closed;
      if (branch.points.size() == most_points) branch.end = BranchEnd::most_points;
      if (branch.end != BranchEnd::lost) break;
      before = std::exchange(last, *next);
      step = std::min(2.0 * step, step_);
    }
    if (branch.end == BranchEnd::lost) branch.why += why_lost(last);
    found_.branches.push_back(std::move(branch));
  }
  void list_branch(const Start& start) {
    std::ostringstream text;
    text << "it is not followed: " << most_branches << " others were";
    Branch<FlatEquilibrium>& branch = found_.branches.emplace_back();
    branch.points.push_back(point(start.node));
    branch.origin = start.origin;
    branch.why = text.str();
  }
  [[nodiscard]] std::string why_lost(const Node& last) const {
    std::ostringstream text;
    text << "beyond " << corrector_.parameter(last) << " no point was found in steps of "
         << constants.shortest_branch_step * step_ << ": "
         << (corrector_.why().empty() ? "the nearest is further away" : corrector_.why());
    return text.str();
  }

  [[nodiscard]] std::string why_missed(const Node& a, const Node& b) const {
    std::ostringstream text;
    text << "between " << corrector_.parameter(a) << " and " << corrector_.parameter(b)
         << " stability changes, at a point that was not located" << (corrector_.why().empty() ? "" : ": ")
         << corrector_.why() << "; ";
    return text.str();
  }

  /// Adds the singular points between two points of a branch, and the branches that emanate there.
  /// Eigenvalues that vanish at one point make one bifurcation.
  void locate(const Node* before, const Node& a, const Node& b, std::string& why) {
    auto found = points_.between(before, a, b);
    if (found.missed) why += why_missed(a, b);
    for (auto& flutter : found.flutters) {
      auto& to = flutter.frequency > 0.0 ? found_.flutters : found_.bifurcations;
      to.push_back(point(flutter.at));
      to.back().frequency = flutter.frequency;
    }
    add_turning(before, a, b, found, why);
    const VectorXd along = (b.x - a.x).normalized();
    while (!found.zeros.empty()) {
      const Node at = found.zeros.front().at;
      const bool turns = found.zeros.front().turns;
      std::ptrdiff_t count = 0, together = 0;
      std::erase_if(found.zeros, [&](const SingularPoints::Zero& zero) {
        if (!same_place(zero.at.x, at.x)) return false;
        ++count;
        together = std::max(together, zero.count);
        return true;
      });
      if (std::ranges::any_of(located_, [&](const VectorXd& x) { return same_place(x, at.x); })) continue;
      located_.push_back(at.x);
      const std::vector<Index> places = smallest(at.stiffness.values, std::max(count, together));
      if (!corrector_.is_singular(at, places.front(), a, b))
        found_.flutters.push_back(point(at));
      else if (turns)
        found_.folds.push_back(point(at));
      else
        bifurcate(at, along, places, why);
    }
  }
  /// Where the parameter turns back there is a fold, or a fork.
  void add_turning(const Node* before, const Node& a, const Node& b, SingularPoints::Found& found,
                   std::string& why) {
    const bool folds = std::ranges::any_of(found.zeros, &SingularPoints::Zero::turns),
               folded = folded_ || folds;
    const double way = b.fraction() - a.fraction();
    // Less is round-off of points that are known to the accuracy asked of an equilibrium.
    const bool is_known = std::abs(way) > std::sqrt(rank_threshold) * (b.x - a.x).norm();
    const bool turned = is_known && std::exchange(way_, way) * way < 0.0;
    folded_ = is_known ? folds && !turned : folded;
    if (before == nullptr || !turned || folded) return;
    if (auto fork = points_.turning(*before, b))
      found.zeros.push_back(std::move(*fork));
    else
      why += why_turned(*before, b);
  }
  void bifurcate(const Node& found, const VectorXd& own, const std::vector<Index>& places, std::string& why) {
    found_.bifurcations.push_back(point(found));
    const auto orbits = corrector_.orbits(found, places);
    std::vector<Axis> axes;
    for (const auto& [shapes, one_branch] : orbits) {
      for (const Index shape : shapes) {
        axes.push_back({corrector_.direction(found.stiffness.shapes.col(shape)), one_branch});
        if (one_branch) break;  // the others are this one, carried around
      }
    }
    bool emanates = false, everywhere = true;
    for (const VectorXd& direction : directions(axes)) {
      const bool there = switch_branch(found, own, direction, direction);
      emanates |= there;
      everywhere &= there;
    }
    if (!emanates || (axes.size() == 1 && !everywhere))
      emanates |= switch_along_the_parameter(found, own, axes, places);
    if (!emanates) why += why_none(found);
    if (axes.size() > 1) why += why_not_all(found, places.size());
  }
  /// With t the tangent without any null vector z: a branch that touches z meets another along t; one that
  /// hardly moves while the parameter changes leaves along t + k z. Across t the equations are quadratic in k
  /// then, and Newton's iteration from outside ends at the outer root.
  bool switch_along_the_parameter(const Node& found, const VectorXd& own, const std::vector<Axis>& axes,
                                  const std::vector<Index>& places) {
    const VectorXd t = along_the_parameter(found, places);
    const bool forwards = switch_branch(found, own, t, t), backwards = switch_branch(found, own, -t, -t);
    bool emanates = forwards || backwards;
    if (forwards && backwards) return true;
    for (const auto& [z, one_sided] : axes) {
      for (const double side : {1.0, -1.0}) {
        if (one_sided && side < 0.0) continue;
        emanates |= switch_branch(found, own, t + side * z, t);
        emanates |= switch_branch(found, own, side * z - t, -t);
      }
    }
    return emanates;
  }
  /// Where the parameter does nothing at all, as to a column in line, no tangent is told.
  [[nodiscard]] VectorXd along_the_parameter(const Node& found, const std::vector<Index>& places) const {
    Eigen::MatrixXd shapes(found.x.size(), std::ssize(places));
    for (Index k = 0; k < shapes.cols(); ++k)
      shapes.col(k) = corrector_.direction(found.stiffness.shapes.col(places[static_cast<std::size_t>(k)]));
    const Eigen::MatrixXd none = orthonormal_span(std::move(shapes));
    const VectorXd t = corrector_.tangent(found).value_or(VectorXd::Unit(found.x.size(), found.x.size() - 1));
    return (t - none * VectorXd(none.transpose() * t)).normalized();
  }
  [[nodiscard]] std::string why_none(const Node& found) const {
    std::ostringstream text;
    text << "at " << corrector_.parameter(found)
         << " no point of a branch that emanates was found: " << not_found_ << "; ";
    return text.str();
  }
  [[nodiscard]] std::string why_not_all(const Node& found, std::size_t count) const {
    std::ostringstream text;
    text << "at " << corrector_.parameter(found) << ' ' << count
         << " eigenvalues are 0 at once: more branches may emanate than were found; ";
    return text.str();
  }
  [[nodiscard]] std::string why_turned(const Node& a, const Node& b) const {
    std::ostringstream text;
    text << "between " << corrector_.parameter(a) << " and " << corrector_.parameter(b)
         << " the branch turns back, at a point that was not located; ";
    return text.str();
  }
  [[nodiscard]] bool same_place(const VectorXd& a, const VectorXd& b) const {
    return (a - b).norm() < constants.shortest_branch_step * step_;
  }

  static std::vector<Index> smallest(const VectorXd& values, std::ptrdiff_t count) {
    std::vector<Index> places(static_cast<std::size_t>(values.size()));
    std::iota(places.begin(), places.end(), Index{0});
    std::ranges::stable_sort(places, {}, [&](Index k) { return std::abs(values[k]); });
    places.resize(static_cast<std::size_t>(std::min(count, std::ssize(places))));
    return places;
  }

  /// Along each axis, and of two along their bisectors.
  static std::vector<VectorXd> directions(const std::vector<Axis>& axes) {
    std::vector<VectorXd> all;
    const auto add = [&](const VectorXd& direction, bool one_sided) {
      all.emplace_back(direction.normalized());
      if (!one_sided) all.emplace_back(-direction.normalized());
    };
    for (const auto& [along, one_sided] : axes) add(along, one_sided);
    if (axes.size() == 2) {
      const auto& [a, b] = std::tie(axes[0], axes[1]);
      add(a.along + b.along, a.one_sided || b.one_sided);
      if (!(a.one_sided && b.one_sided))
        add(a.one_sided ? a.along - b.along : b.along - a.along, a.one_sided || b.one_sided);
    }
    return all;
  }

  /// Whether a point of another branch than `own` was found, beside a guess and across `normal`.
  bool switch_branch(const Node& from, const VectorXd& own, const VectorXd& towards, const VectorXd& normal) {
    std::optional<Node> next;
    for (double step = step_; !next && step > constants.shortest_branch_step * step_; step *= 0.5) {
      Node guess = from;
      guess.x += step * towards;
      next = corrector_.correct(guess, normal);
      if (!next)
        not_found_ = corrector_.why();
      else if (!is_another(from, *next, step, own, normal))
        next.reset();
    }
    if (!next) return false;
    const VectorXd along = (next->x - from.x).normalized();
    const std::size_t origin = found_.bifurcations.size() - 1;
    const bool again = std::ranges::any_of(starts_, [&](const Start& s) {
      return s.origin == origin && s.along.dot(along) > constants.same_branch;
    });
    if (!again && fraction_of(*next) >= 0.0 && fraction_of(*next) <= 1.0)
      starts_.push_back({*next, along, origin});
    return true;
  }
  /// Whether a point is not far, persists, and is not the one of `own` across the same hyperplane.
  bool is_another(const Node& from, const Node& next, double step, const VectorXd& own,
                  const VectorXd& normal) {
    constexpr double farthest = 3.0;
    not_found_ = "those found are of the branch itself, or farther away than a step";
    if ((next.x - from.x).norm() > farthest * step) return false;
    if (!corrector_.lasts(next)) {
      not_found_ = corrector_.why();
      return false;
    }
    const double cosine = normal.dot(own);
    if (std::abs(cosine) * farthest < 1.0) return true;
    Node guess = from;
    guess.x += step / cosine * own;
    const auto here = corrector_.correct(guess, normal);
    return !here || !same_place(here->x, next.x);
  }
  [[nodiscard]] static double fraction_of(const Node& node) { return node.x[node.x.size() - 1]; }

  const Corrector& corrector_;
  double step_;
  SingularPoints points_;
  std::vector<Start> starts_;
  std::vector<VectorXd> located_;
  std::string not_found_;  // why, of a branch that emanates
  double way_ = 0.0;       // of the parameter, by the last step that changed it
  bool folded_ = false;    // since then
  FlatDiagram found_;
};

}  // namespace

namespace detail {

std::shared_ptr<const Layout> read_by(const Layout& handles, const Layout& own) {
  auto layout = std::make_shared<Layout>(own);
  const auto identify = [](auto& to, const auto& from) {
    for (std::size_t k = 0; k < std::min(to.size(), from.size()); ++k) to[k].scene = from[k].scene;
  };
  layout->id = handles.id;
  identify(layout->particles, handles.particles);
  identify(layout->rotors, handles.rotors);
  identify(layout->constraints, handles.constraints);
  identify(layout->forces, handles.forces);
  return layout;
}

}  // namespace detail

FlatDiagram find_branches(const std::function<PosedSystem(double)>& pose, const BranchOptions& options) {
  validate(options);
  return Follower(EquilibriumCorrector(pose, options), options).follow();
}

FlatDiagram find_steady_branches(const std::function<PosedSystem(double)>& pose,
                                 const BranchOptions& options) {
  validate(options);
  return Follower(SteadyCorrector(pose, options), options).follow();
}

}  // namespace dalembert
