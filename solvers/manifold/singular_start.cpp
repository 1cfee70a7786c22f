#include "dalembert/solvers/manifold/singular_start.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/first_scales.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dalembert {

namespace {

/// In the metric of the masses, of a force.
double norm(const System& system, std::span<const double> force) {
  double square = 0.0;
  for (std::size_t i = 0; i < system.coordinates(); ++i) square += force[i] * force[i] / system.masses()[i];
  return std::sqrt(square);
}

/// The dependences of rows on the active ones along a motion.
class Dependences {
 public:
  Dependences(const Problem& problem, const Start& start, std::span<const double> along, double t)
      : system_(problem.system()),
        active_(start.rows.rows.begin(),
                start.rows.rows.begin() + static_cast<std::ptrdiff_t>(start.rows.holonomic)),
        e_(system_.evaluation()),
        change_(system_.linearisation()),
        rate_(start.scales.largest(along)),
        matrix_(problem.pattern(active_)),
        others_(system_.coordinates()) {
    const Instant at{t, start.q, along};
    system_.evaluate(at, e_);
    system_.linearise_constraints(at, std::vector<double>(system_.rows()), change_);
    regular_ = matrix_.factorise({.w = e_.w});
  }

  /// Whether a row depends on them here, but not where the motion leads.
  [[nodiscard]] bool ends(std::size_t r) {
    if (!regular_ || std::ranges::find(active_, r) != active_.end()) return false;
    std::vector<double> x(matrix_.size());
    add_row(system_, e_.w, r, 1.0, x);
    const double turning = rate_ * norm(system_, x);
    matrix_.solve(x);  // u: 1 for the row, and the multipliers found for the others
    std::ranges::fill(others_, 0.0);
    for (std::size_t j = 0; j < active_.size(); ++j)
      add_row(system_, change_.psi_q, active_[j], x[others_.size() + j], others_);
    std::ranges::fill(x, 0.0);
    add_row(system_, change_.psi_q, r, 1.0, x);
    const double scale = std::max({turning, norm(system_, x), norm(system_, others_)});
    for (std::size_t i = 0; i < others_.size(); ++i) x[i] += others_[i];
    matrix_.solve(x);
    double left = 0.0;
    for (std::size_t i = 0; i < others_.size(); ++i) left += system_.masses()[i] * x[i] * x[i];
    // Positions are known to rank_threshold at best, and so is the residue of a sum that is 0.
    return std::sqrt(left) > std::sqrt(rank_threshold) * scale;
  }

 private:
  const System& system_;
  std::vector<std::size_t> active_;
  System::Evaluation e_;
  System::Linearisation change_;  // psi_q: dW/dt
  double rate_;
  SaddleMatrix matrix_;
  std::vector<double> others_;
  bool regular_ = false;
};

bool begins_to_move(const System& system, const Start& start, double t) {
  auto e = system.evaluation();
  system.evaluate({t, start.q, start.v}, e);
  const double forced = start.scales.largest(forced_acceleration(system, e));
  return start.scales.largest(start.a) > rank_threshold * forced;
}

}  // namespace

std::optional<std::size_t> singular_row(const Problem& problem, const Start& start, double t) {
  const System& system = problem.system();
  if (start.rows.size() == system.rows_in_force()) return std::nullopt;
  const bool at_rest = largest(start.v) == 0.0;
  if (at_rest && !begins_to_move(system, start, t)) return std::nullopt;
  Dependences dependences(problem, start, at_rest ? start.a : start.v, t);
  for (std::size_t r = 0; r < system.holonomic_rows(); ++r)
    if (system.in_force(r) && !system.law(r).compliant() && dependences.ends(r)) return r;
  return std::nullopt;
}

}  // namespace dalembert
