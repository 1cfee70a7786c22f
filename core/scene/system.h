#pragma once

#include <dalembert/core/equations/batch.h>
#include <dalembert/core/results/layout.h>
#include <dalembert/core/scene/force_batches.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

/// The parts a System is made of; Scene::system() fills them in.
struct SystemParts {
  Layout layout{};               ///< rows, slots, conditions and applied forces are filled in by System
  Conditions conditions{};       ///< one per constraint
  std::vector<double> masses{};  ///< one per coordinate; a rotor's inertia
  std::vector<std::shared_ptr<const ConstraintBatch>> constraints{};
  std::vector<std::vector<int>> constraint_numbers{};  ///< per batch: the scene's number of each element
  ForceParts forces{};
  std::function<double(double t)> extent{};  ///< diagonal of the box around all points at the start [length]
};

/// The equations of motion of a scene as flat arrays: no dimension, no particles, no types.
///
///   M q'' = F(t,q,v) + W^T lambda,   g(t,q) = 0,   psi(t,q,v) = 0,   W = psi_v          (1)
///
/// Rows of holonomic constraints come first, with psi = dg/dt; rows of nonholonomic ones follow,
/// with psi = a(t,q,v). At acceleration level W v' + gamma = 0 with gamma = psi_q v + psi_t.
/// The force of constraint on coordinate i is Z_i = (W^T lambda)_i. A compliant holonomic constraint
/// satisfies g + C lambda = 0 in place of g = 0: a spring whose force is its multiplier. Forces that read
/// multipliers, F_f(t,q,v,lambda), join F in (1); what is called friction here is any of them.
///
/// A System is its equations, which copies share, and which of their rows are in force.
class System {
 public:
  /// Everything a residual needs at one instant.
  struct Evaluation {
    std::vector<double> force;  ///< F without friction, n
    std::vector<double> g;      ///< position residual, m_holonomic
    std::vector<double> psi;    ///< velocity residual, m
    std::vector<double> w;      ///< W, in the order of its pattern
  };
  /// Everything the Newton matrix needs besides W.
  struct Linearisation {
    std::vector<double> psi_q;      ///< d psi/dq, in W's pattern
    std::vector<double> stiffness;  ///< d(F + F_f + W^T lambda)/dq, in the order of its pattern
    std::vector<double> damping;    ///< d(F + F_f)/dv, in the order of its pattern
    std::vector<double> friction;   ///< dF_f/dlambda, in the order of its pattern
  };

  explicit System(SystemParts parts);

  [[nodiscard]] std::size_t coordinates() const { return shared_->parts.masses.size(); }
  [[nodiscard]] std::size_t rows() const { return shared_->row_start.size() - 1; }
  [[nodiscard]] std::size_t holonomic_rows() const { return shared_->holonomic_rows; }
  /// Whether any constraint depends on time explicitly.
  [[nodiscard]] bool rheonomic() const;
  [[nodiscard]] const RowLaw& law(std::size_t row) const { return shared_->laws[row]; }
  /// When each constraint holds, by its number in the layout.
  [[nodiscard]] const Conditions& conditions() const { return *layout()->conditions; }
  /// The label of a constraint that does not always hold; empty if all do.
  [[nodiscard]] std::string conditional_label() const;
  /// Whether any row is not rigid.
  [[nodiscard]] bool compliant() const { return compliant_rows() > 0; }
  [[nodiscard]] std::size_t compliant_rows() const { return shared_->compliant_rows; }
  [[nodiscard]] std::span<const double> masses() const { return shared_->parts.masses; }
  /// Whether each coordinate is an angle, and not a length.
  [[nodiscard]] std::vector<char> angles() const;
  /// Diagonal of the box around all points, the driven ones where they are at the start of the run [length].
  [[nodiscard]] double extent(double t_start) const { return shared_->parts.extent(t_start); }
  [[nodiscard]] const std::shared_ptr<const Layout>& layout() const { return shared_->layout; }
  /// The applied forces: F, F_f, their derivatives and energies.
  [[nodiscard]] const ForceBatches& forces() const { return forces_->batches; }

  /// Pattern of W: its entries by rows, `for (const std::size_t k : row(r))`, and the column of each, the
  /// coordinate w_columns()[k]. A column may occur twice in a row; its entries add.
  [[nodiscard]] Places row(std::size_t r) const { return {shared_->row_start[r], shared_->row_start[r + 1]}; }
  [[nodiscard]] std::span<const std::size_t> w_columns() const { return shared_->w_columns; }
  /// Places of the entries of the stiffness; places may repeat, their entries add.
  [[nodiscard]] std::span<const MatrixEntry> stiffness_pattern() const { return forces_->stiffness_pattern; }
  /// The number of entries of the stiffness that are those of constraints; they come first.
  [[nodiscard]] std::size_t stiffness_of_constraints() const { return shared_->stiffness_of_constraints; }
  /// The rows in force of constraints that hold only at times.
  [[nodiscard]] std::vector<std::size_t> conditional_rows() const;
  /// g and psi of the rows of these at an instant, also of those that are not in force; 0 in
  /// other rows. Throws like `evaluate`.
  void gaps(const Instant& at, std::span<double> g, std::span<double> psi) const;
  /// The same system without some constraints, by their numbers in the layout: they exert no force, and their
  /// rows read 0 = 0.
  [[nodiscard]] System without(std::span<const std::size_t> constraints) const;
  /// The same system with constraints of Coulomb's law, by their numbers in the layout, that slide: their
  /// rows read 0 = 0, and they exert the force of SlidingFriction, by its `Sliding` of the same names.
  struct Slide {
    std::size_t constraint;
    double strength;
    std::vector<double> direction;
    double slow;
  };
  [[nodiscard]] System sliding(std::span<const Slide> slides) const;
  /// Whether a row is in force, and how many are.
  [[nodiscard]] bool in_force(std::size_t row) const { return out_of_force_.empty() || !out_of_force_[row]; }
  [[nodiscard]] std::size_t rows_in_force() const { return rows_in_force_; }

  /// Work space of the right sizes; the functions below allocate nothing.
  [[nodiscard]] Evaluation evaluation() const;
  [[nodiscard]] Linearisation linearisation() const;

  /// F without friction, g, psi and W. Throws EquationFault if a constraint or force throws or is not
  /// finite.
  void evaluate(const Instant& at, Evaluation& out) const;
  /// The same and gamma, for hardly more: every equation is evaluated once.
  void evaluate_with_bias(const Instant& at, Evaluation& out, std::span<double> gamma) const;
  /// gamma, m numbers. Throws like `evaluate`.
  void bias(const Instant& at, std::span<double> gamma) const;
  /// Derivatives for the multipliers lambda (m numbers). Throws like `evaluate`.
  void linearise(const Instant& at, std::span<const double> lambda, Linearisation& out) const;
  /// The part of it from the constraints: the first `stiffness_of_constraints` entries, and psi_q.
  void linearise_constraints(const Instant& at, std::span<const double> lambda, Linearisation& out) const;
  /// And the part from the forces: all the rest.
  void linearise_forces(const Instant& at, std::span<const double> lambda, Linearisation& out) const {
    forces().friction_slope(at, lambda, out.friction);
    forces().linearise(at, lambda, out.stiffness, out.damping);
  }

  /// What multipliers exert at the points the constraints were stated for, out of W: for every row as many
  /// numbers as its constraint has inputs, in the order of rows; see detail::forces_at_points. `lengths` has
  /// one number per coordinate.
  void forces_at_points(std::span<const double> w, std::span<const double> lengths,
                        std::span<double> out) const;
  [[nodiscard]] std::size_t size_of_forces_at_points() const;

  /// The force W^T lambda of every constraint on every coordinate it acts on, by Layout's slots.
  void constraint_forces(std::span<const double> w, std::span<const double> lambda,
                         std::span<double> slots) const;
  [[nodiscard]] double kinetic_energy(std::span<const double> v) const;
  /// Energy of the compliant constraints, the sum of C lambda^2 / 2.
  [[nodiscard]] double elastic_energy(std::span<const double> lambda) const;

  /// The number of batches in Branches that the scene states; those of what slides come behind.
  [[nodiscard]] std::size_t stated_batches() const { return batches().size() + forces().stated(); }
  /// The label of what a batch holds, by its number in Branches.
  [[nodiscard]] std::string label_of_batch(std::size_t batch) const;
  /// Whether its equations depend on time explicitly.
  [[nodiscard]] bool timed_batch(std::size_t batch) const;
  /// The label of the constraint that row r belongs to.
  [[nodiscard]] std::string row_label(std::size_t row) const;
  /// The hint of the constraint of this row when it is singular; may be empty.
  [[nodiscard]] std::string_view singular_hint(std::size_t row) const;

  /// What the scene consists of, its degrees of freedom, and what was left out because nothing in
  /// it needs it.
  [[nodiscard]] std::string describe() const;
  /// The same with what only a state determines: how many constraint equations are independent there, and
  /// which velocity constraints are integrable.
  [[nodiscard]] std::string describe(double t, std::span<const double> q) const;

 private:
  /// Where a batch's part of each array is.
  struct ConstraintPlaces {
    Places rows, w, stiffness;
    bool holonomic;
  };
  /// What is the same whatever is in force.
  struct Shared {
    SystemParts parts;
    std::shared_ptr<const Layout> layout{};
    std::vector<ConstraintPlaces> constraint_places{};
    std::size_t holonomic_rows = 0;
    std::vector<std::size_t> row_start{0}, w_columns{};
    std::vector<RowLaw> laws{};
    std::size_t compliant_rows = 0, stiffness_of_constraints = 0;

    /// Returns the pattern of their stiffness.
    std::vector<MatrixEntry> place_constraints(Layout& layout);
  };
  /// With those of what slides.
  struct Forces {
    ForceBatches batches;
    std::vector<MatrixEntry> stiffness_pattern;  // with that of the constraints
  };

  /// Unless gamma is empty, with the bias.
  void evaluate_all(const Instant& at, Evaluation& out, std::span<double> gamma) const;
  [[nodiscard]] const Layout::Constraint& constraint_of_row(std::size_t row, std::size_t& batch) const;
  [[nodiscard]] const std::vector<std::shared_ptr<const ConstraintBatch>>& batches() const {
    return shared_->parts.constraints;
  }
  /// The scene's numbers of the elements of a batch.
  [[nodiscard]] const std::vector<int>& numbers(std::size_t batch) const {
    return shared_->parts.constraint_numbers[batch];
  }

  template <class F>
  void on_constraints(double t, const F& f) const;

  /// Of these rows; empty if all rows are in force.
  [[nodiscard]] std::span<const char> out_of_force(const Places& own) const {
    return out_of_force_.empty() ? std::span<const char>() : own.in(std::span(out_of_force_));
  }

  std::shared_ptr<const Shared> shared_;
  std::shared_ptr<const Forces> forces_;
  std::vector<char> out_of_force_;  // per row; empty if all are in force
  std::size_t rows_in_force_ = 0;
};

}  // namespace dalembert
