#pragma once

#include <dalembert/core/handles.h>
#include <dalembert/core/layout.h>
#include <dalembert/core/points.h>

#include <span>

namespace dalembert {

/// The flat numbers of one instant of a run, in the places of a Layout. A view.
struct FlatSample {
  double time = 0.0;
  std::span<const double> q;       ///< n
  std::span<const double> v;       ///< n
  std::span<const double> lambda;  ///< m
  std::span<const double> forces;  ///< the slots of constraint forces
  double energy = 0.0;             ///< kinetic plus all potential energies
};

/// One instant of a run, read by handle. A view: valid while the Trajectory or Simulation it comes
/// from is alive and unchanged, inside an observer until it returns.
///
/// Every function throws InvalidScene for a handle that is not one of this scene's.
template <int D>
class Sample {
 public:
  Sample(const Layout& layout, const FlatSample& flat) : layout_(&layout), flat_(flat) {}

  [[nodiscard]] double time() const { return flat_.time; }
  [[nodiscard]] double energy() const { return flat_.energy; }
  [[nodiscard]] Vec<D> position(Particle<D> particle) const;  ///< [length]
  [[nodiscard]] Vec<D> velocity(Particle<D> particle) const;  ///< [length / time]

  /// lambda, the multiplier: a force where the constraint's gradient has unit length, as in all of
  /// the library's own; see the constraint for its direction.
  template <int Rows>
  [[nodiscard]] Multiplier<Rows> multiplier(Constraint<Rows> constraint) const {
    const double* first = flat_.lambda.data() + info(constraint.index, constraint.scene).first_row;
    if constexpr (Rows == 1) {
      return *first;
    } else {
      return Eigen::Map<const Vec<Rows>>(first);
    }
  }

  /// Z = +W^T lambda: the force that one constraint exerts on one particle [force]; zero if it does
  /// not act on it.
  template <int Rows>
  [[nodiscard]] Vec<D> constraint_force(Constraint<Rows> constraint, Particle<D> particle) const {
    return force_of(info(constraint.index, constraint.scene), particle);
  }
  /// The force of all constraints together on one particle [force].
  [[nodiscard]] Vec<D> constraint_force(Particle<D> particle) const;

  [[nodiscard]] const FlatSample& flat() const { return flat_; }

 private:
  [[nodiscard]] const Layout::Constraint& info(int index, std::uint64_t scene) const;
  [[nodiscard]] Vec<D> force_of(const Layout::Constraint& constraint, Particle<D> particle) const;

  const Layout* layout_;
  FlatSample flat_;
};

extern template class Sample<2>;
extern template class Sample<3>;

}  // namespace dalembert
