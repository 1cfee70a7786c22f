#pragma once

#include <dalembert/core/equations/owned.h>
#include <dalembert/core/errors.h>
#include <dalembert/core/forces/batch_of.h>
#include <dalembert/core/forces/forces.h>
#include <dalembert/core/points/handles.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/core/scene/value.h>

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dalembert {

/// A particle as its user states it. Units are the user's own, consistent ones.
template <int D>
struct ParticleState {
  double mass = 0.0;                 ///< finite and > 0, no denormal number; there is no default
  Vec<D> position = Vec<D>::Zero();  ///< at the start [length]
  Vec<D> velocity = Vec<D>::Zero();  ///< at the start; must satisfy the constraints
};

/// A rotor as its user states it.
struct RotorState {
  double inertia = 0.0;           ///< about its axis, finite and > 0; there is no default
  double angle = 0.0;             ///< [rad]
  double angular_velocity = 0.0;  ///< [rad / time]
};

/// What the user states: particles, forces, and constraints, each as its equation. D is 2 or 3.
///
/// Everything is checked as it is added; the initial state against the constraints when a run
/// starts. Names are optional, must differ, and appear in errors and output.
///
/// A scene is a value: a copy shares nothing with its original, and the handles that the original gave out
/// before address the same things in the copy. What either adds later is its own.
///
///   Scene<2> softer = scene;
///   softer.replace(spring, Spring{a, b, 0.5 * stiffness, length});
template <int D>
class Scene {
 public:
  static_assert(D == 2 || D == 3);

  /// The name appears in errors and output.
  explicit Scene(std::string name = "scene");
  // These are compiled once, in the library.
  ~Scene();
  Scene(const Scene& other);                 ///< shares nothing with it
  Scene(Scene&& other) noexcept;             ///< leaves the other empty
  Scene& operator=(const Scene& other);      ///< shares nothing with it
  Scene& operator=(Scene&& other) noexcept;  ///< leaves the other empty

  /// Throws InvalidScene unless mass, position and velocity are finite and the mass is positive.
  Particle<D> add_particle(const ParticleState<D>& state, const std::string& name = {});

  /// Throws InvalidScene unless all is finite and the inertia positive.
  Rotor add_rotor(const RotorState& state, const std::string& name = {});

  /// Gravity for every particle, added before or after it.
  Force add(const UniformGravity<D>& gravity, const std::string& name = {});

  /// Adds a constraint. Throws InvalidScene if its parameters make no sense (it says which), and
  /// InvalidArgument if a particle of it does not belong to this scene.
  template <detail::AnyConstraint C>
  Constraint<rows_of_constraint<C>> add(C constraint, const std::string& name = {}) {
    detail::require_equations<C>();
    require_points<C>();
    return {add_any(BatchOf<ConstraintBatch, C>::table(), &constraint, name), identity_.number()};
  }

  /// Adds a force; throws like a constraint. One that reads a multiplier throws InvalidArgument also if the
  /// constraint of that is not one of this scene.
  template <detail::AnyForce E>
  Force add(E force, const std::string& name = {}) {
    detail::require_forces<E>();
    require_points<E>();
    return add_any(BatchOf<ForceBatch, E>::table(), &force, name);
  }

  /// Replaces a constraint or force by one of the same type with other parameters, or points. Every lambda
  /// expression has a type of its own: make both by one function. Name and handle stay. Throws as when it was
  /// added, and InvalidArgument for one of another type or a handle of another scene; then nothing has
  /// changed.
  template <detail::AnyConstraint C>
  void replace(Constraint<rows_of_constraint<C>> handle, C constraint) {
    detail::require_equations<C>();
    require_points<C>();
    layout_.require(handle);
    replace_any(handle.index, BatchOf<ConstraintBatch, C>::table(), &constraint);
  }
  /// The same for a force.
  template <detail::AnyForce E>
  void replace(Force handle, E force) {
    detail::require_forces<E>();
    require_points<E>();
    layout_.require(handle);
    replace_any(handle.index, BatchOf<ForceBatch, E>::table(), &force);
  }
  /// The same for gravity.
  void replace(Force handle, const UniformGravity<D>& gravity);
  /// Another mass and another initial state.
  void replace(Particle<D> particle, const ParticleState<D>& state);
  /// Another inertia and another initial state.
  void replace(Rotor rotor, const RotorState& state);

  /// `release` switches a constraint off until `impose` puts it back: it exerts no force meanwhile, and its
  /// equation need not be satisfied. Throws InvalidArgument for a handle of another scene, and for those that
  /// do not always hold (`unilateral`, `coulomb`).
  template <int Rows>
  void release(Constraint<Rows> constraint) {
    layout_.require(constraint);
    set_released(constraint.index, true);
  }
  /// Puts a released constraint back into force.
  template <int Rows>
  void impose(Constraint<Rows> constraint) {
    layout_.require(constraint);
    set_released(constraint.index, false);
  }

  /// Takes the state of a sample as the initial one. Throws as `require_state`.
  void start_from(const Sample<D>& sample);

  /// The handle of the particle of this name. Throws InvalidArgument if none has it; so do the next three.
  [[nodiscard]] Particle<D> particle(std::string_view name) const;
  /// Of a rotor.
  [[nodiscard]] Rotor rotor(std::string_view name) const;
  /// Of a force.
  [[nodiscard]] Force force(std::string_view name) const;
  /// `constraint<2>("hinge")` for one of two equations.
  template <int Rows = 1>
  [[nodiscard]] Constraint<Rows> constraint(std::string_view name) const {
    const int index = find_constraint(name, Rows);
    return {index, layout_.constraints[static_cast<std::size_t>(index)].scene};
  }

  /// Everything else is a mistake, which the compiler reports.
  template <class E>
  void add(E /*element*/, const std::string& /*name*/ = {}) {
    static_assert(HasPoints<E>, "a scene adds constraints, forces and its own UniformGravity<D>");
    if constexpr (HasPoints<E>) require_points<E>();
    static_assert(!HasPoints<E> || !ActsOnPoints<E>,
                  "a constraint is called with the positions of its points, one that is velocity_level and a "
                  "force law also with their velocities, and for any scalar type");
  }

  /// Throws InvalidScene if something has this name. A function that adds several elements calls this for
  /// every name before it adds the first. `kind` is what the error calls it, "particle".
  void require_free(std::string_view kind, const std::string& name) const;

  /// The name of the scene.
  [[nodiscard]] const std::string& name() const { return layout_.scene; }
  /// Initial coordinates and velocities, of particles and rotors in the order of adding.
  [[nodiscard]] std::span<const double> initial_positions() const { return q_; }
  /// Likewise, their rates.
  [[nodiscard]] std::span<const double> initial_velocities() const { return v_; }

  /// What the scene consists of, at its initial positions; see System::describe.
  [[nodiscard]] std::string describe(double t = 0.0) const { return system().describe(t, q_); }

  /// The equations of the scene as it is now. Throws InvalidScene if it has no particles.
  [[nodiscard]] System system() const;

  /// Throws InvalidArgument unless a sample is one of this scene or of a copy, with the same particles and
  /// rotors: its state can be a start.
  void require_state(const Sample<D>& sample) const;

 private:
  using Path = std::function<Vec<D>(double)>;

  /// The elements of one type, and the scene's number of each.
  template <class Batch>
  struct Group {
    detail::Owned<Batch> batch;
    std::vector<int> numbers;
  };
  /// The points of an element that the scene does not move: those that stand still, and the paths of the
  /// driven ones.
  struct Surroundings {
    std::vector<Vec<D>> fixed;
    std::vector<Path> paths;
  };
  /// Where an element stands among those of its type.
  struct Place {
    std::size_t group = 0, element = 0;
    Surroundings around{};
  };
  enum class Kind { particle, rotor, constraint, force };
  struct Named {
    Kind kind;
    int index;
  };
  static constexpr std::size_t no_group = static_cast<std::size_t>(-1);  // of gravity

  /// What an error calls an element; composed only there.
  struct Label {
    std::string_view kind, name;
    [[nodiscard]] std::string text() const;
  };

  void set_released(int constraint, bool released);
  /// `name`, or if it is empty `kind` and the next free number; throws InvalidScene if it is taken.
  [[nodiscard]] std::string unique_name(std::string_view kind, const std::string& name,
                                        std::size_t number) const;
  /// The number of what has this name.
  [[nodiscard]] int find(std::string_view name, Kind kind) const;
  [[nodiscard]] int find_constraint(std::string_view name, int rows) const;

  template <class E>
  static constexpr void require_points() {
    static_assert(PointFacts<E>::template in_space<D>,
                  "all points of a constraint or force must have the dimension of the scene");
    static_assert(PointFacts<E>::inputs > 0,
                  "at least one point of a constraint or force must be able to move");
  }

  // Of elements whose type is known to their table alone.
  int add_any(const detail::ElementTable<ConstraintBatch>& type, const void* constraint,
              const std::string& name);
  Force add_any(const detail::ElementTable<ForceBatch>& type, const void* force, const std::string& name);
  void replace_any(int handle, const detail::ElementTable<ConstraintBatch>& type, const void* constraint);
  void replace_any(int handle, const detail::ElementTable<ForceBatch>& type, const void* force);

  /// Checks an element's parameters and points. What is refused leaves no trace.
  class Admitting;
  [[noreturn]] void refuse_point(std::uint64_t scene, const Label& label) const;
  [[noreturn]] void refuse_constraint(std::uint64_t scene, const Label& label) const;
  [[noreturn]] static void refuse_type(const std::string& label);
  static void admit_fixed(const Vec<D>& fixed, const Label& label);
  static void require_compliance(double compliance, const Label& label);
  static void check(const ParticleState<D>& state, const Label& label);
  static void check(const RotorState& state, const Label& label);
  static void check(const UniformGravity<D>& gravity);

  /// Puts an element with those of its type.
  template <class Batch>
  static Place put(std::vector<Group<Batch>>& groups, const detail::ElementTable<Batch>& type,
                   const void* element, std::size_t number);
  /// Puts another element in the place of number `number`, if it is of the same type.
  template <class Batch>
  static void exchange(std::vector<Group<Batch>>& groups, const detail::ElementTable<Batch>& type,
                       const void* element, Place& place, std::size_t number, const std::string& label,
                       Surroundings around);
  /// Takes the element last put into the layout.
  int enter(Place place, const std::string& name, Surroundings around, const Condition& holds,
            std::string_view meaning, std::shared_ptr<const Drawing> drawing);
  Force enter_force(Place place, std::string_view kind, const std::string& name, Surroundings around,
                    std::shared_ptr<const Drawing> drawing);

  detail::Identity identity_;
  Layout layout_;
  Conditions conditions_;
  std::vector<double> q_, v_, masses_;
  std::vector<std::pair<int, UniformGravity<D>>> gravities_;  // and their numbers among the forces
  std::vector<Group<ConstraintBatch>> constraints_;
  std::vector<Group<ForceBatch>> forces_;
  std::vector<Place> constraint_places_, force_places_;
  std::unordered_map<std::string, Named> names_;  // asked for one name at a time, never iterated
};

extern template class Scene<2>;
extern template class Scene<3>;

}  // namespace dalembert
