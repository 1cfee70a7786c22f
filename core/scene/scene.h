#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/core/forces/batch_of.h>
#include <dalembert/core/forces/forces.h>
#include <dalembert/core/points/handles.h>
#include <dalembert/core/scene/system.h>

#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

namespace dalembert {

/// A particle as its user states it. Units are the user's own, consistent ones.
template <int D>
struct ParticleState {
  double mass = 0.0;  ///< finite and > 0; there is no default
  Vec<D> position = Vec<D>::Zero();
  Vec<D> velocity = Vec<D>::Zero();
};

/// A rotor as its user states it.
struct RotorState {
  double inertia = 0.0;           ///< about its axis, finite and > 0; there is no default
  double angle = 0.0;             ///< [rad]
  double angular_velocity = 0.0;  ///< [rad / time]
};

/// What the user says: particles, forces, and constraints, each as its equation. D is 2 or 3.
///
/// Everything is checked as it is added; the initial state against the constraints when a run
/// starts. Names are optional, must differ, and appear in errors and output. Scenes can be moved,
/// not copied, so that a handle belongs to one scene.
template <int D>
class Scene {
 public:
  static_assert(D == 2 || D == 3);

  explicit Scene(std::string name = "scene");
  Scene(const Scene&) = delete;
  Scene(Scene&&) noexcept = default;
  Scene& operator=(const Scene&) = delete;
  Scene& operator=(Scene&&) noexcept = default;
  ~Scene() = default;

  /// Throws InvalidScene unless mass, position and velocity are finite and the mass is positive.
  Particle<D> add_particle(const ParticleState<D>& state, const std::string& name = {});

  /// Throws InvalidScene unless all is finite and the inertia positive.
  Rotor add_rotor(const RotorState& state, const std::string& name = {});

  /// Gravity for every particle, added before or after it.
  void add(const UniformGravity<D>& gravity);

  /// Adds a constraint. Throws InvalidScene if its parameters make no sense (it says which) or a
  /// particle of it does not belong to this scene.
  template <HolonomicConstraint C>
  Constraint<rows_of_constraint<C>> add(C constraint, const std::string& name = {}) {
    static_assert(
        detail::Equations<detail::Residual<C>>,
        "a constraint's equation returns a number or a plain column of fixed size, vec(g_1, g_2): no "
        "row, matrix or vector of dynamic size, and of an Eigen expression its .eval()");
    const std::string own =
        admit(constraint, detail::kind_of<C>("Holonomic"), name, layout_.constraints.size());
    return place<rows_of_constraint<C>>(constraint, own);
  }
  template <NonholonomicConstraint C>
  Constraint<rows_of_constraint<C>> add(C constraint, const std::string& name = {}) {
    static_assert(
        detail::Equations<detail::Residual<C>>,
        "a constraint's equation returns a number or a plain column of fixed size, vec(g_1, g_2): no "
        "row, matrix or vector of dynamic size, and of an Eigen expression its .eval()");
    const std::string own =
        admit(constraint, detail::kind_of<C>("Nonholonomic"), name, layout_.constraints.size());
    return place<rows_of_constraint<C>>(constraint, own);
  }

  /// Adds a force; throws like a constraint.
  template <PotentialForce E>
  void add(E force, const std::string& name = {}) {
    static_assert(PotentialBatch<E>::gives_what_it_should,
                  "a potential returns its energy, one number; of an Eigen expression its .value()");
    const std::string own = admit(force, detail::kind_of<E>("Potential"), name, force_count_);
    place_force(forces_, force, own);
  }
  template <LawForce E>
  void add(E force, const std::string& name = {}) {
    static_assert(LawBatch<E>::gives_what_it_should,
                  "a force law returns one column of its point's dimension, or one for each point, "
                  "std::tuple{f_a, f_b}; "
                  "of an Eigen expression its .eval()");
    const std::string own = admit(force, detail::kind_of<E>("ForceLaw"), name, force_count_);
    place_force(forces_, force, own);
  }
  /// Adds a force that reads a multiplier; throws also if its constraint is not one of this scene.
  template <FrictionForce E>
  void add(E force, const std::string& name = {}) {
    static_assert(
        FrictionBatch<E>::gives_what_it_should,
        "a friction law returns one column of its point's dimension, or one for each point, std::tuple{f_a, "
        "f_b}; "
        "of an Eigen expression its .eval()");
    const std::string own = admit(force, detail::kind_of<E>("Friction"), name, force_count_);
    place_force(frictions_, force, own);
  }

  /// Everything else is a mistake, which the compiler tells.
  template <class E>
  void add(E /*element*/, const std::string& /*name*/ = {}) {
    static_assert(HasPoints<E>, "a scene adds constraints, forces and its own UniformGravity<D>");
    if constexpr (HasPoints<E>) require_points<E>();
    static_assert(!HasPoints<E> || !ActsOnPoints<E>,
                  "a constraint is called with the positions of its points, one that is velocity_level and a "
                  "force law also with their velocities, and for any scalar type");
  }

  [[nodiscard]] const std::string& name() const { return layout_.scene; }
  /// Initial coordinates and velocities, of particles and rotors in the order of adding.
  [[nodiscard]] std::span<const double> initial_positions() const { return q_; }
  [[nodiscard]] std::span<const double> initial_velocities() const { return v_; }

  /// What the scene consists of, at its initial positions; see System::describe.
  [[nodiscard]] std::string describe(double t = 0.0) const { return system().describe(t, q_); }

  /// The equations of the scene as it is now. Throws InvalidScene if it has no particles.
  [[nodiscard]] System system() const;

 private:
  struct ConstraintGroup {
    std::unique_ptr<ConstraintBatch> batch;
    std::vector<int> numbers;
  };
  template <class Batch>
  struct ForceGroup {
    std::unique_ptr<Batch> batch;
    std::vector<std::string> names;
  };

  /// `name`, or if it is empty `kind` and the next free number; throws InvalidScene if it is taken.
  [[nodiscard]] std::string unique_name(std::string_view kind, const std::string& name,
                                        std::size_t number) const;

  template <class E>
  static constexpr void require_points() {
    static_assert(PointFacts<E>::template in_space<D>,
                  "all points of a constraint or force must have the dimension of the scene");
    static_assert(PointFacts<E>::inputs > 0,
                  "at least one point of a constraint or force must be able to move");
  }

  /// Checks an element's parameters and points and returns its name. What is refused leaves no trace.
  template <class Element>
  std::string admit(const Element& element, std::string_view kind, const std::string& name,
                    std::size_t number) {
    require_points<Element>();
    const std::string own = unique_name(kind, name, number);
    const std::string label = std::string(kind) + " \"" + own + '"';
    if constexpr (requires { element.fault(); }) {
      const std::string fault = element.fault();
      if (!fault.empty()) throw InvalidScene(label + ": " + fault);
    }
    if constexpr (HasCompliance<Element>) require_compliance(element.compliance, label);
    if constexpr (ReadsMultiplier<Element>) {
      const auto& read = element.constraint();
      require_constraint(read.scene, read.index, rows_read<Element>, label);
    }
    Eigen::AlignedBox<double, D> extent = extent_;
    std::apply([&](const auto&... point) { (admit_point(point, label, extent), ...); }, element.points());
    std::apply([this](const auto&... point) { (this->remember_path(point), ...); }, element.points());
    take(own, extent);
    return own;
  }
  template <Point P>
  void admit_point(const P& point, const std::string& label, Eigen::AlignedBox<double, D>& extent) const {
    if constexpr (requires { point.particles; }) {
      for (const auto& particle : point.particles) admit_point(particle, label, extent);
    } else if constexpr (P::coordinates > 0) {
      require_own(point.scene, point.coordinate, label);
    } else if constexpr (!P::driven) {
      admit_fixed(point.position, label, extent);
    }
  }
  template <Point P>
  void remember_path(const P& point) {
    if constexpr (P::driven)
      paths_.push_back([path = point.path](double t) { return Vec<D>(path(t).template cast<double>()); });
  }
  void require_own(std::uint64_t scene, int coordinate, const std::string& label) const;
  void require_constraint(std::uint64_t scene, int index, int rows, const std::string& label) const;
  static void admit_fixed(const Vec<D>& fixed, const std::string& label,
                          Eigen::AlignedBox<double, D>& extent);
  static void require_compliance(double compliance, const std::string& label);
  void take(const std::string& name, const Eigen::AlignedBox<double, D>& extent);

  template <int rows, class C>
  Constraint<rows> place(const C& constraint, const std::string& name) {
    using Own = BatchOf<ConstraintBatch, C>;
    std::size_t g = 0;
    while (g < constraints_.size() && !Own::add(*constraints_[g].batch, constraint)) ++g;
    if (g == constraints_.size()) Own::add(begin_group(Own::empty()), constraint);
    return {enter(g, name), layout_.id};
  }
  ConstraintBatch& begin_group(std::unique_ptr<ConstraintBatch> batch);
  /// Takes the constraint last added to a group into the layout, and returns its number.
  int enter(std::size_t group, const std::string& name);

  template <class Batch, class E>
  void place_force(std::vector<ForceGroup<Batch>>& groups, const E& force, const std::string& name) {
    using Own = BatchOf<Batch, E>;
    ++force_count_;
    for (auto& group : groups) {
      if (Own::add(*group.batch, force)) return group.names.push_back(name);
    }
    groups.push_back({Own::empty(), {name}});
    Own::add(*groups.back().batch, force);
  }

  Layout layout_;
  std::vector<double> q_, v_, masses_;
  Vec<D> gravity_ = Vec<D>::Zero();
  std::vector<ConstraintGroup> constraints_;
  std::vector<ForceGroup<ForceBatch>> forces_;
  std::vector<ForceGroup<MultiplierForceBatch>> frictions_;
  std::size_t force_count_ = 0;
  std::unordered_set<std::string> names_;  // asked for membership only, never iterated
  Eigen::AlignedBox<double, D> extent_;    // of the points that stand still and of the initial positions
  std::vector<std::function<Vec<D>(double)>> paths_;  // of the driven points
};

extern template class Scene<2>;
extern template class Scene<3>;

}  // namespace dalembert
