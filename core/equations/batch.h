#pragma once

#include <dalembert/core/equations/contact.h>
#include <dalembert/core/equations/differentiated.h>
#include <dalembert/core/equations/sketch.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

/// Sizes that all constraints of one type have in common.
struct ConstraintShape {
  std::string_view kind;
  int rows;                   ///< scalar equations per constraint
  int width;                  ///< coordinates that each of them reads
  int inputs;                 ///< numbers of the positions of its points, which these give
  bool internal;              ///< holds a body together
  bool holonomic;             ///< or at velocity level
  bool timed;                 ///< depends on time explicitly (rheonomic)
  std::string_view singular;  ///< what it means if the gradient vanishes or has no value
};

/// The law of a row: g + C lambda = 0, and so psi + C lambda' = 0; of a rigid one C = 0.
struct RowLaw {
  double compliance = 0.0;  ///< C [length / force, at unit gradient], d residual / d lambda

  /// Whether its residuals depend on its own multiplier: an entry in the lower right block.
  [[nodiscard]] bool compliant() const { return compliance > 0.0; }
  /// Of g and lambda, or of psi and lambda'.
  [[nodiscard]] double residual(double g, double lambda) const { return g + compliance * lambda; }
  /// The lambda of a g, or the lambda' of a psi, if it is compliant.
  [[nodiscard]] double multiplier(double g) const { return -g / compliance; }
  /// What its spring stores [energy].
  [[nodiscard]] double energy(double lambda) const { return 0.5 * compliance * lambda * lambda; }
};

/// A type of constraints.
struct ConstraintType {
  detail::EquationType equation;
  std::string_view kind;
  bool internal;                                 ///< see ConstraintShape
  bool timed;                                    ///< see ConstraintShape
  bool conditional;                              ///< one-sided, or of Coulomb's law
  double (*compliance)(const void* constraint);  ///< null if rigid
};

/// All constraints of one type, evaluated together.
class ConstraintBatch {
 public:
  explicit ConstraintBatch(const ConstraintType& type) : type_(&type), equations_(type.equation) {}
  [[nodiscard]] std::unique_ptr<ConstraintBatch> clone() const;
  [[nodiscard]] ConstraintShape shape() const;
  [[nodiscard]] std::size_t size() const { return equations_.elements().size(); }
  /// The coordinates of each constraint in turn, `width` numbers each.
  [[nodiscard]] std::span<const int> coordinates() const { return equations_.elements().coordinates(); }

  /// Whether it holds constraints of this C++ type, which `add` and `replace` take.
  [[nodiscard]] bool holds(const std::type_info& type) const {
    return *equations_.elements().type().type == type;
  }
  void add(const void* constraint) { equations_.elements().add(constraint); }
  void replace(std::size_t i, const void* constraint) { equations_.elements().replace(i, constraint); }

  /// Residuals, W, and gamma if it is asked for. `out_of_force`, here and below, has a flag per row, or is
  /// empty: such constraints write nothing, and their equations are not evaluated.
  void evaluate(const Instant& at, const ConstraintValues& out,
                std::span<const char> out_of_force = {}) const {
    if (out_of_force.empty()) return equations_.evaluate(at, 0, size(), out);
    evaluate_those_in_force(at, out, out_of_force);
  }
  /// Per constraint `rows x inputs` numbers U, one row after the other, out of its part of w: lambda has
  /// the size |U^T lambda|, that of the force at one of its points. See detail::forces_at_points.
  void forces_at_points(std::span<const double> w, std::span<const double> lengths,
                        std::span<double> out) const;
  /// The law of each row, as `out` comes if it is rigid.
  void laws(std::span<RowLaw> out) const;
  /// gamma = psi_q v + psi_t, so that W v' + gamma = 0 at acceleration level.
  void bias(const Instant& at, std::span<double> gamma, std::span<const char> out_of_force = {}) const;
  /// psi_q, and for each constraint the dense `width x width` block (rows first) of
  /// d(W^T lambda)/dq.
  void linearise(const Instant& at, std::span<const double> lambda, std::span<double> psi_q,
                 std::span<double> stiffness, std::span<const char> out_of_force = {}) const;
  /// g and dg/dt of one-sided constraints, the slip velocities of Coulomb's, in force or not.
  void gaps(const Instant& at, std::span<double> g, std::span<double> rate) const;

 private:
  void evaluate_those_in_force(const Instant& at, const ConstraintValues& out,
                               std::span<const char> out_of_force) const;

  const ConstraintType* type_;
  detail::DifferentiatedEquations equations_;
};

/// What all forces of one type have in common.
struct ForceShape {
  std::string_view kind;
  int width;          ///< coordinates that each of them reads and acts on
  int rows;           ///< multipliers that each of them reads, those of one constraint; most read none
  bool dissipative;   ///< depends on velocities
  bool conservative;  ///< has an energy
  bool timed;         ///< depends on time explicitly, or by a driven point
};

/// The multipliers of a scene, and at which row those that each element of a batch reads begin.
struct Multipliers {
  std::span<const double> all;
  std::span<const std::size_t> first_row;
};

/// All force elements of one type: F(t, q, v, lambda).
class ForceBatch {
 public:
  virtual ~ForceBatch() = default;
  [[nodiscard]] virtual std::unique_ptr<ForceBatch> clone() const = 0;
  [[nodiscard]] virtual ForceShape shape() const = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual std::span<const int> coordinates() const = 0;
  /// The scene's number of the constraint that each of them reads; of batches that read none nothing.
  [[nodiscard]] virtual std::span<const int> constraints() const { return {}; }

  /// Adds the forces to F.
  virtual void add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const = 0;
  /// For each force the dense `width x width` blocks (rows first) of dF/dq and, if it is
  /// dissipative, dF/dv, at fixed multipliers.
  virtual void linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                         std::span<double> damping) const = 0;
  /// dF/dlambda: for each force and each multiplier it reads, `width` numbers.
  virtual void slope(const Instant& /*at*/, const Multipliers& /*lambda*/, std::span<double> /*out*/) const {}
  /// F . v of each force.
  virtual void power(const Instant& at, const Multipliers& lambda, std::span<double> out) const = 0;
  /// The force of one element on each of the `width` coordinates that it acts on; `lambda` are the `rows`
  /// multipliers that it reads.
  virtual void force(std::size_t element, const Instant& at, std::span<const double> lambda,
                     std::span<double> out) const = 0;
  /// Sum of the energies; 0 for forces that have none.
  [[nodiscard]] virtual double energy(const Instant& /*at*/) const { return 0.0; }
};

namespace detail {

/// Is told of an element that a scene is to take what could be wrong with it, in this order, and throws what
/// is.
class Admission {
 public:
  virtual void fault(const std::string& of_parameters) = 0;  ///< empty if there is none
  virtual void compliance(double value) = 0;
  virtual void reads(int constraint, std::uint64_t scene, int rows) = 0;  ///< its multipliers
  virtual void moves(const Particle<2>& point) = 0;
  virtual void moves(const Particle<3>& point) = 0;
  virtual void moves(const Rotor& point) = 0;
  virtual void stands(const Vec<2>& point) = 0;
  virtual void stands(const Vec<3>& point) = 0;
  virtual void follows(std::function<Vec<2>(double)> path) = 0;
  virtual void follows(std::function<Vec<3>(double)> path) = 0;

 protected:
  ~Admission() = default;
};

/// What a scene calls of one type of constraints or forces. It knows elements by their address alone, so that
/// what it does with one is compiled once.
template <class Batch>
struct ElementTable {
  std::string_view kind;
  std::string_view meaning;  ///< of the multipliers of a constraint
  void (*tell)(const void* element, Admission& to);
  Condition (*condition)(const void* constraint);  ///< null of a force
  std::shared_ptr<const Drawing> (*drawing)(const void* element);
  std::unique_ptr<Batch> (*empty)();
  /// Adds the element if the batch is of its type, else returns false.
  bool (*add)(Batch& batch, const void* element);
  /// Puts the element in the place of number `i` if the batch is of its type, else returns false.
  bool (*replace)(Batch& batch, std::size_t i, const void* element);
};

}  // namespace detail

/// All that a scene calls of one type of element, made in the one place that instantiates its code
/// (batch_of.h). Declared `extern template` where an element's code is compiled once, in the library: naming
/// such an element costs its user nothing, as neither a derivative of it nor how a scene takes it is compiled
/// again.
template <class Batch, class Element>
struct BatchOf {
  [[nodiscard]] static const detail::ElementTable<Batch>& table();
};

}  // namespace dalembert
