#pragma once

#include <dalembert/core/lagrange/coordinate_constraint.h>
#include <dalembert/core/lagrange/lagrange_equations.h>
#include <dalembert/core/scene/scene.h>

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace dalembert {

/// The N coordinates of a Lagrangian as its user states them: angles, lengths, anything.
template <int N>
struct CoordinateState {
  Vec<N> position = Vec<N>::Zero();  ///< at the start
  Vec<N> velocity = Vec<N>::Zero();  ///< at the start
  /// What counts as one unit of each, > 0: errors are relative to it. 1 for an angle; for a length the size
  /// of the system.
  Vec<N> scale = Vec<N>::Ones();
  std::array<std::string, static_cast<std::size_t>(N)> names{};  ///< for errors; q1, q2, ... if left out
};

/// A system given by its Lagrangian L([t,] q, v), one function of any N coordinates and their rates and of
/// any form, not only T - V (notes, mln5, mln8):
///
///   L_vv q'' = L_q - L_vq q' - L_vt + Q + A^T lambda,    g(t, q) = 0,   a(t, q, q') = 0.                (1)
///
///   LagrangianSystem<1> pendulum({.position = Vec<1>(1.0)}, [](const auto& phi, const auto& rate) {
///     return 0.5 * rate[0] * rate[0] + 9.81 * cos(phi[0]);
///   });
///   const auto motion = simulate(pendulum, {.t_end = 10.0, .tolerance = 1e-10});
///
/// The function is written for any scalar (`auto`) and called with numbers that carry derivatives: call cos,
/// not std::cos. Constraints, if there are any, have multipliers lambda; their generalized force is A^T
/// lambda.
///
/// Where L_vv is singular along what the constraints leave free, (1) gives no acceleration. A start there is
/// rejected with that direction (InconsistentStart); a Lagrangian without velocities is one such. A run ends
/// (IntegrationFailure) on the way to such a place, if accelerations grow without bound there, or where the
/// determinant of the inertia has changed its sign. A motion that passes such a place with finite
/// accelerations, as that of v^4/4 passes v = 0, may go on: `ida` as a rule passes it, `erk` stops where a
/// stage of it comes too close to have an acceleration.
///
/// Where a comparison in L switches a run goes on with the same velocities. So it stops (IntegrationFailure)
/// where a momentum L_v jumps, or L itself unless time alone decides: that is an impulse.
template <int N>
class LagrangianSystem {
  static_assert(N > 0 && N <= detail::most_coordinates, "a Lagrangian has 1 to 32 coordinates");

 public:
  /// Throws InvalidScene unless the state is finite and scales are positive.
  explicit LagrangianSystem(const CoordinateState<N>& state, std::shared_ptr<const Lagrangian<N>> lagrangian,
                            const std::string& name = "lagrangian");
  /// From a function of positions and rates, written for any scalar.
  template <class F>
    requires(!std::is_convertible_v<F, std::shared_ptr<const Lagrangian<N>>>)
  explicit LagrangianSystem(const CoordinateState<N>& state, F function,
                            const std::string& name = "lagrangian")
      : LagrangianSystem(state, differentiated(std::move(function)), name) {}
  LagrangianSystem(const LagrangianSystem&) = default;             ///< also of one that is moved
  LagrangianSystem& operator=(const LagrangianSystem&) = default;  ///< likewise

  /// Generalized forces Q(t, q, v), a Vec<N>, which are not in L: drag, drives, friction. Their comparisons
  /// are not seen: smooth dry friction where it reverses, as by tanh(v/v_0); a run that is held at rest by
  /// a jump stops, if its steps would not reach the end. Throws InvalidArgument for an empty one.
  void apply(GeneralizedForce<N> force) {
    if (!force) throw InvalidArgument("Lagrangian \"" + name() + "\": a generalized force is empty");
    forces_.push_back(std::move(force));
  }

  /// A holonomic constraint g(q) = 0 or g(t, q) = 0, one equation or a fixed-size column of several; and a
  /// nonholonomic one, a(q, v) = 0 or a(t, q, v) = 0, linear in v. Written for any scalar.
  template <class G>
  auto constrain(G equation, const std::string& name = {}) {
    static_assert(!OneSided<G>, "the constraints of a Lagrangian hold both ways");
    return enter(kinematics_.add(detail::OnPositions<N, G>{coordinates_, scale_, std::move(equation)}, name));
  }
  /// See `constrain`.
  template <class A>
  auto constrain_velocities(A equation, const std::string& name = {}) {
    return enter(
        kinematics_.add(detail::OnVelocities<N, A>{coordinates_, scale_, std::move(equation)}, name));
  }

  /// At the start.
  [[nodiscard]] Vec<N> position() const { return unscaled(kinematics_.initial_positions()); }
  /// At the start.
  [[nodiscard]] Vec<N> velocity() const { return unscaled(kinematics_.initial_velocities()); }
  /// The unit of each coordinate.
  [[nodiscard]] const Vec<N>& scale() const { return scale_; }
  /// Of the system.
  [[nodiscard]] const std::string& name() const { return kinematics_.name(); }
  /// Of a coordinate, counted from 0. Throws InvalidArgument if there is none.
  [[nodiscard]] const std::string& name(int coordinate) const {
    if (coordinate >= 0 && coordinate < N) return names_[static_cast<std::size_t>(coordinate)];
    throw InvalidArgument("Lagrangian \"" + name() + "\" has no coordinate " + std::to_string(coordinate) +
                          ": it has " + std::to_string(N) + ", counted from 0");
  }
  /// Its Lagrangian with derivatives.
  [[nodiscard]] const std::shared_ptr<const Lagrangian<N>>& lagrangian() const { return lagrangian_; }
  /// Whether it has constraints.
  [[nodiscard]] bool constrained() const { return rows_ > 0; }
  /// Whether it has forces besides the Lagrangian.
  [[nodiscard]] bool forced() const { return !forces_.empty(); }

  /// The coordinates that L does not depend on (ignorable ones): their momenta change only by forces Q and
  /// constraints. L is evaluated with such a coordinate NaN, and no comparison may depend on it, here and
  /// now and at t = 0 and 1. Whether it is so elsewhere, a reduced system asks wherever it comes.
  [[nodiscard]] std::vector<int> cyclic() const;
  /// Whether a coordinate is one of them.
  [[nodiscard]] bool is_cyclic(int k) const;

  /// Its equations, and the scene of rotors that moves by them from a time on, angles q/scale. For
  /// `simulate`: its constraints exert nothing (see LagrangeEquations), and anything else added to it acts on
  /// rotors of unit inertia.
  [[nodiscard]] LagrangeEquations<N> equations() const;
  /// The system as a scene of rotors, one for each coordinate over its scale.
  [[nodiscard]] Scene<2> rotor_scene(double t_start) const;
  /// Those rotors.
  [[nodiscard]] const std::array<Rotor, static_cast<std::size_t>(N)>& rotors() const { return coordinates_; }

 private:
  template <class F>
  [[nodiscard]] static std::shared_ptr<const Lagrangian<N>> differentiated(F function) {
    static_assert(
        !detail::NamesItsArguments<F>,
        "write `auto` for the lambda's arguments, not double or Vec: it is called with numbers that "
        "carry derivatives");
    if constexpr (!detail::NamesItsArguments<F>) {
      static_assert(
          LagrangianFunction<F, N>,
          "a Lagrangian takes the coordinates, a vector of N, and their rates, and time in front of "
          "them if it depends on time, and returns a number");
      if constexpr (LagrangianFunction<F, N>)
        return std::make_shared<LagrangianOf<N, F>>(std::move(function));
    }
    return nullptr;
  }
  template <int Rows>
  Constraint<Rows> enter(Constraint<Rows> constraint) {
    rows_ += Rows;
    if (rows_ > detail::most_coordinates)
      throw InvalidScene("Lagrangian \"" + name() + "\" has more than " +
                         std::to_string(detail::most_coordinates) + " equations of constraint");
    return constraint;
  }
  [[nodiscard]] Vec<N> unscaled(std::span<const double> u) const {
    return scale_.cwiseProduct(Vec<N>::from(u.data()));
  }

  Scene<2> kinematics_;  ///< rotors and constraints
  std::array<Rotor, static_cast<std::size_t>(N)> coordinates_{};
  std::array<std::string, static_cast<std::size_t>(N)> names_{};
  Vec<N> scale_;
  std::shared_ptr<const Lagrangian<N>> lagrangian_;
  std::vector<GeneralizedForce<N>> forces_;
  int rows_ = 0;
};

template <int N>
LagrangianSystem<N>::LagrangianSystem(const CoordinateState<N>& state,
                                      std::shared_ptr<const Lagrangian<N>> lagrangian,
                                      const std::string& name)
    : kinematics_(name), names_(state.names), scale_(state.scale), lagrangian_(std::move(lagrangian)) {
  if (!lagrangian_) throw InvalidScene("System \"" + name + "\" has no Lagrangian: the pointer is null");
  for (int k = 0; k < N; ++k) {
    auto& own = names_[static_cast<std::size_t>(k)];
    if (own.empty()) own = 'q' + std::to_string(k + 1);
    if (!(std::isfinite(scale_[k]) && scale_[k] > 0.0))
      throw InvalidScene("Coordinate \"" + own + "\": scale = " + detail::text(scale_[k]) +
                         ", must be finite and > 0");
    coordinates_[static_cast<std::size_t>(k)] =
        kinematics_.add_rotor({.inertia = 1.0,
                               .angle = state.position[k] / scale_[k],
                               .angular_velocity = state.velocity[k] / scale_[k]},
                              own);
  }
}

template <int N>
LagrangeEquations<N> LagrangianSystem<N>::equations() const {
  std::shared_ptr<const System> constraints;
  if (constrained()) constraints = std::make_shared<const System>(kinematics_.system());
  return {coordinates_, scale_, lagrangian_, forces_, std::move(constraints)};
}

template <int N>
Scene<2> LagrangianSystem<N>::rotor_scene(double t_start) const {
  LagrangeEquations<N> own = equations();
  try {
    own.sign = own.solved({t_start, kinematics_.initial_positions(), kinematics_.initial_velocities()}).sign;
  } catch (const std::exception&) {  // the run will say so, at its own start
  }
  Scene<2> scene = kinematics_;
  scene.add(own, name());
  return scene;
}

template <int N>
std::vector<int> LagrangianSystem<N>::cyclic() const {
  std::vector<int> found;
  for (int k = 0; k < N; ++k)
    if (is_cyclic(k)) found.push_back(k);
  return found;
}

template <int N>
bool LagrangianSystem<N>::is_cyclic(int k) const {
  const auto independent_at = [&](double t) {
    return detail::independent_of(*lagrangian_, k, t, position(), velocity());
  };
  return independent_at(0.0) && independent_at(1.0);
}

}  // namespace dalembert
