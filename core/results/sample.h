#pragma once

#include <dalembert/core/equations/arguments.h>
#include <dalembert/core/results/layout.h>

#include <array>
#include <span>
#include <type_traits>

namespace dalembert {

/// The flat numbers of one instant of a run, in the places of a Layout. A view.
struct FlatSample {
  double time = 0.0;               ///< [time]
  std::span<const double> q;       ///< n
  std::span<const double> v;       ///< n
  std::span<const double> a;       ///< n; NaN where the state does not determine it
  std::span<const double> lambda;  ///< m; NaN where the state does not determine it
  std::span<const double> forces;  ///< the slots of constraint forces; likewise
  double energy = 0.0;             ///< kinetic plus all potential energies
  std::span<const char> unique{};  ///< m: is this multiplier unique? See Sample::is_unique; empty if all are
};

/// What is made of particles: a RigidBody, Lamina, ThinRod, and a BodyPoint, which stands for its body.
template <class B, int D>
concept MadeOfParticles = requires(const B& body) {
  { body.particles[0] } -> std::convertible_to<Particle<D>>;
  requires std::tuple_size_v<std::remove_cvref_t<decltype(body.particles)>> >
  0;
};

/// One instant of a run, read by handle. A view: valid while the Trajectory or Simulation it comes
/// from is alive and unchanged, inside an observer until it returns.
///
/// Every function throws InvalidArgument for a handle that is not one of this scene's. Where the state does
/// not determine them forces of constraint throw UndeterminedForce, see `is_determined`, and so do
/// accelerations; it may determine these though not the forces that act there.
///
/// What is added here is passed on in Readings.
template <int D>
class Sample {
 public:
  /// Made by Trajectory and Simulation.
  Sample(const Layout& layout, const FlatSample& flat) : layout_(&layout), flat_(flat) {}

  /// [time].
  [[nodiscard]] double time() const { return flat_.time; }
  /// Kinetic plus all potential energies.
  [[nodiscard]] double energy() const { return flat_.energy; }

  /// Of any point: a particle, a point of a body, a fixed or a driven one [length], and its derivatives with
  /// respect to time. Throws EquationFault where the path of a driven point gives a number that is not
  /// finite.
  template <Point P>
  [[nodiscard]] Vec<D> position(const P& point) const {
    require_known(point);
    if constexpr (P::inputs > 0) {
      return finite<P>(point.gather(flat_.q));
    } else {
      return finite<P>(detail::position<double>(point, flat_.time, nullptr));
    }
  }
  /// Likewise, its rate.
  template <Point P>
  [[nodiscard]] Vec<D> velocity(const P& point) const {
    require_known(point);
    if constexpr (P::inputs > 0) {
      return finite<P>(point.gather(flat_.v));
    } else {
      return finite<P>(detail::velocity<double>(point, flat_.time, nullptr));
    }
  }
  /// Likewise, the second derivative.
  template <Point P>
  [[nodiscard]] Vec<D> acceleration(const P& point) const {
    require_known(point);
    if constexpr (P::inputs > 0) {
      const Vec<D> a = point.gather(flat_.a);
      if (!a.allFinite()) refuse_acceleration();
      return a;
    } else if constexpr (P::driven) {
      using Time = Jet<1>;
      const VecOf<Time, D> path = point.path(Time::input(flat_.time, 0, 1.0)).template cast<Time>();
      Vec<D> a;
      for (int k = 0; k < D; ++k) a[k] = path[k].ss;
      return finite<P>(a);
    } else {
      return Vec<D>::Zero();
    }
  }
  [[nodiscard]] double angle(Rotor rotor) const;                 ///< [rad]
  [[nodiscard]] double angular_velocity(Rotor rotor) const;      ///< [rad / time]
  [[nodiscard]] double angular_acceleration(Rotor rotor) const;  ///< [rad / time^2]

  /// lambda, the multiplier: of the library's own constraints a force or a torque, of an equation of yours a
  /// force where its gradient has unit length; see the constraint for its direction.
  template <int Rows>
  [[nodiscard]] Multiplier<Rows> multiplier(Constraint<Rows> constraint) const {
    const Layout::Constraint& its = info(constraint);
    if (!determined(its)) refuse(its);
    const double* first = flat_.lambda.data() + its.first_row;
    if constexpr (Rows == 1) {
      return *first;
    } else {
      return Vec<Rows>::from(first);
    }
  }

  /// Whether the state determines this constraint's force. Close to an isolated singular position, where the
  /// constraints are dependent for an instant, round-off or the tolerance may leave nothing of it.
  template <int Rows>
  [[nodiscard]] bool is_determined(Constraint<Rows> constraint) const {
    return determined(info(constraint));
  }

  /// Whether the motion determines this constraint's multipliers. Where constraints are redundant it may not:
  /// then the forces of those that were stated are the least-squares ones of all that give the motion, and
  /// only their sum has a physical meaning.
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint) const {
    for (int component = 0; component < Rows; ++component) {
      if (!is_unique(constraint, component)) return false;
    }
    return true;
  }
  /// Whether it determines one of them, counted from 0: a door on two hinges has unique horizontal
  /// forces, while only the sum of the vertical ones is.
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint, int component) const {
    return unique(info(constraint), component);
  }

  /// Z = +W^T lambda: the force that one constraint exerts on one particle [force]; zero if it does
  /// not act on it.
  template <int Rows>
  [[nodiscard]] Vec<D> constraint_force(Constraint<Rows> constraint, Particle<D> particle) const {
    const Layout::Constraint& its = info(constraint);
    require_known(particle);
    return force_of(its, particle);
  }
  /// The force of all constraints together on one particle [force]. Looks at those that act on it only.
  [[nodiscard]] Vec<D> constraint_force(Particle<D> particle) const;
  /// The same on a body, at whatever points of it they act: the resultant. Of all constraints together, those
  /// inside the body cancel.
  template <int Rows, MadeOfParticles<D> Body>
  [[nodiscard]] Vec<D> constraint_force(Constraint<Rows> constraint, const Body& body) const {
    const Layout::Constraint& its = info(constraint);
    return sum_over(body, [&](Particle<D> p) { return force_of(its, p); });
  }
  /// Of all constraints on a body, the resultant.
  template <MadeOfParticles<D> Body>
  [[nodiscard]] Vec<D> constraint_force(const Body& body) const {
    return sum_over(body, [this](Particle<D> p) { return constraint_force(p); });
  }
  /// The moment about a point of space of what one constraint, or all of them, exert on a body
  /// [force length].
  template <int Rows, MadeOfParticles<D> Body>
  [[nodiscard]] MomentOf<D> constraint_moment(Constraint<Rows> constraint, const Body& body,
                                              const Vec<D>& about) const {
    const Layout::Constraint& its = info(constraint);
    return sum_over(body, [&](Particle<D> p) { return moment(p, force_of(its, p), about); });
  }
  /// Of all constraints on a body.
  template <MadeOfParticles<D> Body>
  [[nodiscard]] MomentOf<D> constraint_moment(const Body& body, const Vec<D>& about) const {
    return sum_over(body, [&](Particle<D> p) { return moment(p, constraint_force(p), about); });
  }
  /// The torque that one constraint exerts on one rotor [force length].
  template <int Rows>
  [[nodiscard]] double constraint_torque(Constraint<Rows> constraint, Rotor rotor) const {
    const Layout::Constraint& its = info(constraint);
    require_known(rotor);
    return force_at(its, rotor.coordinate);
  }

  /// What one constraint exerts on the ground, which is whatever holds the fixed and driven points and the
  /// curves and surfaces of its equation: a constraint has no mass, so this balances what it exerts on
  /// particles. Zero if it acts between particles only.
  template <int Rows>
  [[nodiscard]] Vec<D> ground_force(Constraint<Rows> constraint) const {
    return force_on_ground(info(constraint));
  }
  /// Its moment about a point of space [force length]. Throws InvalidArgument if the constraint turns a
  /// rotor: a scene does not know where the axis of a rotor is in space.
  template <int Rows>
  [[nodiscard]] MomentOf<D> ground_moment(Constraint<Rows> constraint, const Vec<D>& about) const {
    return moment_on_ground(info(constraint), about);
  }

  /// What an applied force (gravity, a spring, a drag, friction) exerts on a particle, or on a body: the
  /// resultant; zero if it does not act on it [force]. Its equation is evaluated here, not in the run: a law
  /// must capture by value what it needs. Throws EquationFault if that fails.
  [[nodiscard]] Vec<D> force(Force force, Particle<D> particle) const;
  /// The resultant on a body.
  template <MadeOfParticles<D> Body>
  [[nodiscard]] Vec<D> force(Force applied, const Body& body) const {
    return sum_over(body, [&](Particle<D> p) { return force(applied, p); });
  }
  /// What it exerts on a rotor [force length].
  [[nodiscard]] double torque(Force force, Rotor rotor) const;

  /// Names and places of its numbers.
  [[nodiscard]] const Layout& layout() const { return *layout_; }
  /// Its numbers.
  [[nodiscard]] const FlatSample& flat() const { return flat_; }

 private:
  [[nodiscard]] Instant instant() const { return {flat_.time, flat_.q, flat_.v}; }
  template <int Rows>
  [[nodiscard]] const Layout::Constraint& info(const Constraint<Rows>& constraint) const {
    layout_->require(constraint);
    return layout_->constraints[static_cast<std::size_t>(constraint.index)];
  }
  template <Point P>
  void require_known(const P& point) const {
    if constexpr (detail::OfParticles<P>) {
      for (const auto& particle : point.particles) require_known(particle);
    } else if constexpr (P::coordinates > 0) {
      layout_->require(point);
    }
  }
  template <class Body, class F>
  [[nodiscard]] auto sum_over(const Body& body, const F& f) const {
    auto sum = f(Particle<D>(body.particles[0]));
    for (std::size_t i = 1; i < std::size(body.particles); ++i) sum += f(Particle<D>(body.particles[i]));
    return sum;
  }
  template <Point P>
  [[nodiscard]] Vec<D> finite(const Vec<D>& r) const {
    if (P::driven && !r.allFinite()) refuse_path();
    return r;
  }
  [[noreturn]] void refuse_path() const;
  [[noreturn]] void refuse_acceleration() const;
  [[noreturn]] void refuse(const Layout::Constraint& constraint) const;
  [[nodiscard]] Vec<D> force_of(const Layout::Constraint& constraint, Particle<D> particle) const;
  [[nodiscard]] double force_on(int coordinate) const;
  [[nodiscard]] MomentOf<D> moment(Particle<D> particle, const Vec<D>& force, const Vec<D>& about) const;
  [[nodiscard]] Vec<D> force_on_ground(const Layout::Constraint& constraint) const;
  [[nodiscard]] MomentOf<D> moment_on_ground(const Layout::Constraint& constraint, const Vec<D>& about) const;
  void evaluate(Force force, int first, double mass, std::span<double> out) const;
  [[nodiscard]] bool unique(const Layout::Constraint& constraint, int component) const;
  [[nodiscard]] bool determined(const Layout::Constraint& constraint) const;
  [[nodiscard]] double force_at(const Layout::Constraint& constraint, int coordinate) const;

  const Layout* layout_;
  FlatSample flat_;
};

extern template class Sample<2>;
extern template class Sample<3>;

}  // namespace dalembert
