#pragma once

#include <dalembert/core/points/handles.h>
#include <dalembert/core/points/points.h>
#include <dalembert/core/results/layout.h>

#include <span>

namespace dalembert {

/// The flat numbers of one instant of a run, in the places of a Layout. A view.
struct FlatSample {
  double time = 0.0;
  std::span<const double> q;       ///< n
  std::span<const double> v;       ///< n
  std::span<const double> lambda;  ///< m; NaN where the state does not determine it
  std::span<const double> forces;  ///< the slots of constraint forces; likewise
  double energy = 0.0;             ///< kinetic plus all potential energies
  std::span<const char> unique{};  ///< m: is this multiplier determined? empty if all are
};

/// One instant of a run, read by handle. A view: valid while the Trajectory or Simulation it comes
/// from is alive and unchanged, inside an observer until it returns.
///
/// Every function throws InvalidScene for a handle that is not one of this scene's, and those that give a
/// force UndeterminedForce where `is_determined` says no.
template <int D>
class Sample {
 public:
  Sample(const Layout& layout, const FlatSample& flat) : layout_(&layout), flat_(flat) {}

  [[nodiscard]] double time() const { return flat_.time; }
  [[nodiscard]] double energy() const { return flat_.energy; }

  /// Of a particle or a point of a body [length], [length / time].
  template <Point P>
  [[nodiscard]] Vec<D> position(const P& point) const {
    require_known(point);
    return point.gather(flat_.q);
  }
  template <Point P>
  [[nodiscard]] Vec<D> velocity(const P& point) const {
    require_known(point);
    return point.gather(flat_.v);
  }
  [[nodiscard]] double angle(Rotor rotor) const;             ///< [rad]
  [[nodiscard]] double angular_velocity(Rotor rotor) const;  ///< [rad / time]

  /// lambda, the multiplier: a force where the constraint's gradient has unit length, as in all of
  /// the library's own; see the constraint for its direction.
  template <int Rows>
  [[nodiscard]] Multiplier<Rows> multiplier(Constraint<Rows> constraint) const {
    const Layout::Constraint& its = info(constraint.index, constraint.scene);
    if (!determined(its)) refuse(its);
    const double* first = flat_.lambda.data() + its.first_row;
    if constexpr (Rows == 1) {
      return *first;
    } else {
      return Eigen::Map<const Vec<Rows>>(first);
    }
  }

  /// Whether the state determines this constraint's force. Close to an isolated singular position, where the
  /// constraints are dependent for an instant, round-off or the tolerance may leave nothing of it.
  template <int Rows>
  [[nodiscard]] bool is_determined(Constraint<Rows> constraint) const {
    return determined(info(constraint.index, constraint.scene));
  }

  /// Whether the motion determines this constraint's multipliers. Where constraints repeat each
  /// other it may not: then the forces of those that were stated are the least squares of all that
  /// give the motion, and only their sum has a physical meaning.
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint) const {
    for (int component = 0; component < Rows; ++component) {
      if (!is_unique(constraint, component)) return false;
    }
    return true;
  }
  /// Whether it determines one of them, counted from 0: a door on two hinges has determined horizontal
  /// forces, while only the sum of the vertical ones is.
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint, int component) const {
    return unique(info(constraint.index, constraint.scene), component);
  }

  /// Z = +W^T lambda: the force that one constraint exerts on one particle [force]; zero if it does
  /// not act on it.
  template <int Rows>
  [[nodiscard]] Vec<D> constraint_force(Constraint<Rows> constraint, Particle<D> particle) const {
    return force_of(info(constraint.index, constraint.scene), particle);
  }
  /// The torque that one constraint exerts on one rotor [force length].
  template <int Rows>
  [[nodiscard]] double constraint_torque(Constraint<Rows> constraint, Rotor rotor) const {
    require_known(rotor);
    return force_at(info(constraint.index, constraint.scene), rotor.coordinate);
  }
  /// The force of all constraints together on one particle [force].
  [[nodiscard]] Vec<D> constraint_force(Particle<D> particle) const;

  [[nodiscard]] const FlatSample& flat() const { return flat_; }

 private:
  [[nodiscard]] const Layout::Constraint& info(int index, std::uint64_t scene) const;
  template <Point P>
  void require_known(const P& point) const {
    if constexpr (requires { point.particles; }) {
      for (const auto& particle : point.particles) require_known(particle);
    } else {
      require_coordinate(point.scene, point.coordinate);
    }
  }
  void require_coordinate(std::uint64_t scene, int coordinate) const;
  [[nodiscard]] Vec<D> force_of(const Layout::Constraint& constraint, Particle<D> particle) const;
  [[nodiscard]] bool unique(const Layout::Constraint& constraint, int component) const;
  [[nodiscard]] bool determined(const Layout::Constraint& constraint) const;
  [[noreturn]] void refuse(const Layout::Constraint& constraint) const;
  [[nodiscard]] double force_at(const Layout::Constraint& constraint, int coordinate) const;

  const Layout* layout_;
  FlatSample flat_;
};

extern template class Sample<2>;
extern template class Sample<3>;

}  // namespace dalembert
