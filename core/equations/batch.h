#pragma once

#include <dalembert/core/equations/pull_back.h>

#include <cstddef>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

/// Thrown by a batch when one of its elements threw or gave a number that is not finite; System
/// turns the element's index into its name.
struct ElementFault {
  std::size_t element;
  std::string what;
};

namespace detail {

/// Calls `f(element, index)` for every element from `i` to before `end`; a failure reports the index.
template <class Element, class F>
void for_each_element(const std::vector<Element>& elements, std::size_t i, std::size_t end, const F& f) {
  try {
    for (; i < end; ++i) f(elements[i], i);
  } catch (const ElementFault&) {
    throw;
  } catch (const std::exception& e) {
    throw ElementFault{i, std::string("threw \"") + e.what() + '"'};
  } catch (...) {
    throw ElementFault{i, "threw something that is no std::exception"};
  }
}

template <class Element, class F>
void for_each_element(const std::vector<Element>& elements, const F& f) {
  for_each_element(elements, 0, elements.size(), f);
}

/// The same without those that are left out; none is if `left_out` is empty.
template <class Element, class F>
void for_each_element(const std::vector<Element>& elements, std::span<const char> left_out, const F& f) {
  if (left_out.empty()) return for_each_element(elements, f);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!left_out[i]) for_each_element(elements, i, i + 1, f);
  }
}

}  // namespace detail

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

/// Where a constraint batch writes its part of the equations. Row r of constraint c is number
/// `c * rows + r` and owns `width` consecutive entries of w and psi_q.
struct ConstraintValues {
  std::span<double> g;    ///< position residual (holonomic batches only)
  std::span<double> psi;  ///< velocity residual
  std::span<double> w;    ///< d psi / dv
};

/// All constraints of one type, evaluated together: one virtual call per type.
class ConstraintBatch {
 public:
  virtual ~ConstraintBatch() = default;
  [[nodiscard]] virtual std::unique_ptr<ConstraintBatch> clone() const = 0;
  [[nodiscard]] virtual ConstraintShape shape() const = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// The coordinates of each constraint in turn, `width` numbers each.
  [[nodiscard]] virtual std::span<const int> coordinates() const = 0;

  /// What is left out writes nothing, here and below, and its equation is not evaluated.
  virtual void evaluate(const Instant& at, const ConstraintValues& out) const = 0;
  /// Per constraint `rows x inputs` numbers U, one row after the other, out of its part of w: lambda has
  /// the size |U^T lambda|, that of the force at one of its points. See detail::forces_at_points.
  virtual void forces_at_points(std::span<const double> w, std::span<const double> lengths,
                                std::span<double> out) const = 0;
  /// The law of each row, as `out` comes if it is rigid.
  virtual void laws(std::span<RowLaw> /*out*/) const {}
  /// gamma = psi_q v + psi_t, so that W v' + gamma = 0 at acceleration level.
  virtual void bias(const Instant& at, std::span<double> gamma) const = 0;
  /// psi_q, and for each constraint the dense `width x width` block (rows first) of
  /// d(W^T lambda)/dq.
  virtual void linearise(const Instant& at, std::span<const double> lambda, std::span<double> psi_q,
                         std::span<double> stiffness) const = 0;
  /// g and dg/dt of one-sided constraints, the slip velocities of Coulomb's, left out or not: no gradient is
  /// evaluated.
  virtual void gaps(const Instant& /*at*/, std::span<double> /*g*/, std::span<double> /*rate*/) const {}

  /// Whether an element takes part.
  void leave_out(std::size_t element, bool out = true) {
    left_out_.resize(size());
    left_out_[element] = out;
  }

 protected:
  [[nodiscard]] std::span<const char> left_out() const { return left_out_; }

 private:
  std::vector<char> left_out_;  // empty if none is
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

/// The batch for one type of element, as a scene makes and fills it, in the one place that instantiates
/// its code (batch_of.h). Declared `extern template` where an element's code is compiled once, in the
/// library: naming such an element costs its user nothing, as no derivative of it is compiled again.
template <class Batch, class Element>
struct BatchOf {
  [[nodiscard]] static std::unique_ptr<Batch> empty();
  /// Adds the element if the batch is of its type, else returns false.
  static bool add(Batch& batch, const Element& element);
  /// Puts the element in the place of number `i` if the batch is of its type, else returns false.
  static bool replace(Batch& batch, std::size_t i, const Element& element);
};

/// The elements of a batch and the coordinates they read. Whatever throws as an element is copied, nothing
/// has changed.
template <class Element>
class Elements {
 public:
  static constexpr int width = PointFacts<Element>::coordinates;

  void add(Element element) {
    std::array<int, width> read{};
    detail::read_coordinates(element, read);
    coordinates_.insert(coordinates_.end(), read.begin(), read.end());
    try {
      all_.push_back(std::move(element));
    } catch (...) {
      coordinates_.resize(coordinates_.size() - width);
      throw;
    }
  }
  void replace(std::size_t i, const Element& element) {
    if constexpr (std::is_nothrow_move_constructible_v<Element>) {
      Element copy(element);  // a lambda that captures cannot be assigned
      std::destroy_at(&all_[i]);
      std::construct_at(&all_[i], std::move(copy));
    } else {
      std::vector<Element> all;
      all.reserve(all_.size());
      for (std::size_t k = 0; k < all_.size(); ++k) all.push_back(k == i ? element : all_[k]);
      all_.swap(all);
    }
    detail::read_coordinates(element, std::span(coordinates_).subspan(i * width, width));
  }
  /// See detail::forces_at_points; `rows` rows of w and of `out` per element.
  void forces_at_points(int rows, std::span<const double> w, std::span<const double> lengths,
                        std::span<double> out) const {
    const auto n = static_cast<std::size_t>(rows);
    for (std::size_t i = 0; i < all_.size(); ++i) {
      detail::forces_at_points(detail::point_maps(all_[i]), rows, w.data() + i * n * width, coordinates(i),
                               lengths, out.data() + i * n * PointFacts<Element>::inputs);
    }
  }
  [[nodiscard]] const std::vector<Element>& all() const { return all_; }
  [[nodiscard]] std::span<const int> coordinates() const { return coordinates_; }
  [[nodiscard]] std::span<const int> coordinates(std::size_t i) const {
    return coordinates().subspan(i * width, width);
  }

 private:
  std::vector<Element> all_;
  std::vector<int> coordinates_;
};

}  // namespace dalembert
