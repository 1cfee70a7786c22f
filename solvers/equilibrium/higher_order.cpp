#include "dalembert/solvers/equilibrium/higher_order.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/nearby_states.h>
#include <dalembert/solvers/equilibrium/quadratic_modes.h>
#include <dalembert/solvers/equilibrium/tangent.h>
#include <dalembert/solvers/equilibrium/undecayed_motions.h>
#include <dalembert/solvers/equilibrium/work_of_laws.h>
#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;

Vector vector_of(std::span<const double> x) {
  return Eigen::Map<const Vector>(x.data(), static_cast<Index>(x.size()));
}

/// Displacements, as parts of the largest, which is as far as other equilibria are sought.
constexpr std::array<double, 3> ways{0.01, 0.1, 1.0};

/// What is asked of a part of the scene.
struct Part {
  bool acted_on = false;   ///< by a force without a potential
  int freedoms = 0;        ///< coordinates less independent holonomic constraints
  int velocities = 0;      ///< these less nonholonomic ones
  int at_rest = 0;         ///< modes of eigenvalue 0
  int moving = 0;          ///< other eigenvalues
  bool conserves = false;  ///< (2) must be 0
  std::string violation{};

  /// (2) is asked only of what is odd in u.
  [[nodiscard]] bool only_odd() const { return freedoms == 1 && at_rest == 0; }
  /// No motion goes along the modes of eigenvalue 0 for ever: what is near rests there, as far as the others
  /// decay.
  [[nodiscard]] bool rests() const { return freedoms + velocities == at_rest + moving; }
};

bool has_laws(const System& system) {
  return std::ranges::any_of(system.forces().plain(), [](const auto& b) { return !b->shape().conservative; });
}

class Search {
 public:
  Search(const NearEquilibrium& near, std::span<const Mode> modes)
      : near_(&near),
        system_(&near.problem.system()),
        islands_(&near.problem.islands()),
        parts_(islands_->count),
        motions_(*system_, *islands_, near.balance.scales()),
        generic_(generic_vector(motions_.units().size(), 1).cwiseProduct(motions_.units())),
        manifold_(near.problem, rows(), near.balance.scales().lengths()),
        laws_(*system_, *islands_, near.balance.frame(), motions_.units()) {
    const std::vector<char> acted_on = laws_.parts();
    for (std::size_t k = 0; k < parts_.size(); ++k) parts_[k].acted_on = acted_on[k] != 0;
    count_freedoms();
    for (const Mode& mode : modes) count(mode);
    for (const Mode& mode : modes) sort(mode);
    for (const Part& part : parts_) only_odd_.push_back(part.only_odd());
  }

  /// The modes that do not decay: one of each part at a time, and all.
  void along_modes() {
    constexpr double quarter = 0.5 * std::numbers::pi;
    for (std::size_t k = 0; k < motions_.most(); ++k)
      for (const double phase : {quarter, -quarter, 0.7, 0.7 + 2.0 * quarter, 2.2, 2.2 + 2.0 * quarter})
        look(motions_.alone(k, phase));
    for (int number = 1; number <= 6 && motions_.most() > 1; ++number) look(motions_.together(number));
  }

  /// Shapes of no special kind that nothing damps, in some of which each coordinate is among the largest.
  void along_undamped() {
    for (unsigned number = 1; number <= 16; ++number) {
      Disturbance d = motions_.undamped(near_->terms, rows(), number);
      look(d);
      d.shift.setZero();
      look(d);
    }
  }

  [[nodiscard]] std::vector<std::string> violations() const {
    std::vector<std::string> all;
    for (const Part& part : parts_) all.push_back(part.violation);
    return all;
  }

 private:
  [[nodiscard]] const Scales& scales() const { return near_->balance.scales(); }
  [[nodiscard]] double known() const { return round_off_of_a_sum * near_->terms.roundings; }
  [[nodiscard]] ActiveRows rows() const { return independent_rows(*system_, near_->terms.w); }

  void count_freedoms() {
    for (const std::size_t k : islands_->of_coordinate) {
      ++parts_[k].freedoms;
      ++parts_[k].velocities;
    }
    const ActiveRows active = rows();
    for (std::size_t a = 0; a < active.size(); ++a) {
      if (system_->law(active.rows[a]).compliant()) continue;
      Part& part = parts_[islands_->of_row(*system_, active.rows[a])];
      --part.velocities;
      if (a < active.holonomic) --part.freedoms;
    }
  }

  [[nodiscard]] std::size_t part_of(const Mode& mode) const {
    const auto size = [](const std::complex<double>& x) { return std::abs(x); };
    const auto most = std::ranges::max_element(mode.shape, {}, size);
    return islands_->of_coordinate[static_cast<std::size_t>(most - mode.shape.begin())];
  }

  void count(const Mode& mode) {
    Part& part = parts_[part_of(mode)];
    if (mode.eigenvalue == 0.0) {
      ++part.at_rest;
    } else {
      part.moving += mode.eigenvalue.imag() != 0.0 ? 2 : 1;
    }
  }

  void sort(const Mode& mode) {
    const std::size_t k = part_of(mode);
    Part& part = parts_[k];
    if (mode.decays || !part.acted_on || (mode.eigenvalue == 0.0 && part.rests())) return;
    motions_.add(k, mode);
    if (mode.eigenvalue != 0.0 && !has_energy(mode)) part.conserves = true;
  }

  /// u.K u, with compliant rows.
  [[nodiscard]] double stiffness_along(std::span<const double> u) const {
    double sum = 0.0;
    for (const auto& k : near_->terms.stiffness) sum += k.value() * u[k.row()] * u[k.col()];
    for (std::size_t r = 0; r < system_->rows(); ++r) {
      const double C = system_->law(r).compliance;
      if (C > 0.0) sum += std::pow(row_times(*system_, near_->terms.w, r, u), 2) / C;
    }
    return sum;
  }

  /// Whether H > 0 in a vibration, as `solutions` says it, and no momentum has to be added.
  [[nodiscard]] bool has_energy(const Mode& mode) const {
    std::vector<double> re, im;
    double kinetic = 0.0;
    for (std::size_t i = 0; i < mode.shape.size(); ++i) {
      re.push_back(mode.shape[i].real());
      im.push_back(mode.shape[i].imag());
      kinetic += std::norm(mode.eigenvalue) * system_->masses()[i] * std::norm(mode.shape[i]);
    }
    return kinetic + stiffness_along(re) + stiffness_along(im) > rank_threshold * kinetic;
  }

  /// u on the constraints at q, where X obeys them.
  [[nodiscard]] bool allow(const Vector& q, const Vector& carried, Vector& u) {
    Vector v = carried + u;
    std::vector<double> impulses(system_->rows());
    if (!manifold_.project_impulsively(near_->at.time, flat(q), flat(v), impulses)) return false;
    u = v - carried;
    return true;
  }

  /// A disturbance of some size brought onto the constraints, with a little of all else: a thousandth of its
  /// square, of the velocity.
  [[nodiscard]] std::optional<RelativeState> disturbed(const Disturbance& d, double way) {
    const double little = 1e-3 * way * way, length = scales().length, t = near_->at.time;
    const auto rates = motions_.sizes(d.rate);
    Vector all_else = generic_;
    for (Index i = 0; i < all_else.size(); ++i)
      all_else[i] *= rates[islands_->of_coordinate[static_cast<std::size_t>(i)]];
    RelativeState s{vector_of(near_->at.q) + way * d.shift, Vector(all_else.size()),
                    way * (d.rate + little * all_else), way * all_else};
    near_->balance.frame().velocity(flat(s.q), flat(s.frame));
    const double close = 1e-13 * length + scales().rounding(flat(s.q));
    if (manifold_.project_positions(t, flat(s.q), flat(s.frame), close).size > off_constraints * length)
      return std::nullopt;
    near_->balance.frame().velocity(flat(s.q), flat(s.frame));
    return allow(s.q, s.frame, s.u) && allow(s.q, s.frame, s.other) ? std::optional(std::move(s))
                                                                    : std::nullopt;
  }

  void look(const Disturbance& d) {
    std::vector<char> settled;
    for (const Part& part : parts_) settled.push_back(!part.acted_on);
    for (const double way : ways) {
      if (way < ways.back() && std::ranges::count(settled, 0) == 0) continue;
      try {
        const auto state = disturbed(d, way * constants.free_displacement);
        if (!state) continue;
        const auto work = laws_.at(near_->at.time, *state, only_odd_);
        for (std::size_t k = 0; k < parts_.size(); ++k) judge_power(work[k], parts_[k], settled[k]);
        for (std::size_t k = 0; way == ways.back() && k < parts_.size(); ++k)
          judge_circulation(work[k], parts_[k]);
      } catch (const EquationFault&) {
        continue;  // there is no such state
      }
    }
  }

  void judge_power(const WorkOfLaws::OnPart& work, Part& part, char& settled) const {
    if (settled || !(std::abs(work.sum.power) > known() * work.sum.power_terms)) return;
    settled = 1;
    if (work.sum.power > 0.0) violates(part, work.drives);
    if (work.sum.power < 0.0 && part.conserves) violates(part, work.brakes);
  }

  void judge_circulation(const WorkOfLaws::OnPart& work, Part& part) const {
    if (part.freedoms > 1 && std::abs(work.sum.circulation) > known() * work.sum.circulation_terms)
      violates(part, work.circulates);
  }

  void violates(Part& part, const WorkOfLaws::Force& force) const {
    if (part.violation.empty()) part.violation = system_->forces().label(force.first, force.second);
  }

  const NearEquilibrium* near_;
  const System* system_;
  const Islands* islands_;
  std::vector<Part> parts_;
  UndecayedMotions motions_;
  Vector generic_;  // of size 1
  Manifold manifold_;
  WorkOfLaws laws_;
  std::vector<char> only_odd_{};
};

}  // namespace

std::vector<std::string> NearEquilibrium::violations(std::span<const Mode> modes) const {
  if (!has_laws(problem.system())) return {};
  Search search(*this, modes);
  search.along_modes();
  return search.violations();
}

std::vector<std::string> NearEquilibrium::violations_of_many(std::span<const Mode> modes) const {
  if (!has_laws(problem.system())) return {};
  Search search(*this, modes);
  search.along_modes();
  search.along_undamped();
  return search.violations();
}

}  // namespace dalembert
