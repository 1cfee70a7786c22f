#pragma once

#include <dalembert/core/equations/contact.h>
#include <dalembert/core/equations/sketch.h>
#include <dalembert/core/places.h>
#include <dalembert/core/points/handles.h>
#include <dalembert/core/points/points.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

class AppliedForces;

/// Names and places: where each particle and constraint of a scene stands in the flat arrays.
///
/// Everything knows which scene added it, itself or one that it was copied from. So a handle addresses what
/// it was given for, in copies as well, and nothing else that happens to have the same number.
struct Layout {
  struct Particle {
    std::string name;
    int coordinate;  ///< first of its `dimension` entries in q and v
    double mass;
    std::uint64_t scene;  ///< identity of the one that added it
  };
  struct Rotor {
    std::string name;
    int coordinate;
    double inertia;
    std::uint64_t scene;
  };
  struct Constraint {
    std::string kind;
    std::string name;
    int rows;
    int width;       ///< coordinates it acts on
    int inputs;      ///< numbers of the positions of its points
    bool internal;   ///< holds a body together; its user did not state it
    int first_row;   ///< in lambda
    int first_slot;  ///< in the slots of constraint forces, `width` of them
    std::uint64_t scene;
    std::string meaning{};  ///< what its multiplier is, with its direction and sign, in words
    std::shared_ptr<const Drawing> drawing{};

    /// Those of its multipliers, in lambda.
    [[nodiscard]] Places own_rows() const {
      return Places::from(static_cast<std::size_t>(first_row), static_cast<std::size_t>(rows));
    }
    [[nodiscard]] Places slots() const {
      return Places::from(static_cast<std::size_t>(first_slot), static_cast<std::size_t>(width));
    }
    [[nodiscard]] std::string label() const { return kind + " \"" + name + '"'; }
  };
  struct Force {
    std::string kind;
    std::string name;
    std::uint64_t scene;
    std::shared_ptr<const Drawing> drawing{};  ///< null of gravity

    [[nodiscard]] std::string label() const { return kind + " \"" + name + '"'; }
  };

  std::string scene;
  std::uint64_t id = 0;  ///< identity of the scene that the layout was made of
  int dimension = 0;
  std::vector<Particle> particles;
  std::vector<Rotor> rotors;
  std::vector<Constraint> constraints;
  std::vector<Force> forces;
  std::vector<int> slot_coordinate;  ///< the coordinate that each slot's force acts on
  /// The slots that act on coordinate i, constraint after constraint: those from touching_start[i] to before
  /// touching_start[i + 1].
  std::vector<int> touching, touching_start;
  std::shared_ptr<const AppliedForces> applied;  ///< what the forces are at any instant
  std::shared_ptr<const Conditions> conditions;  ///< when the constraints hold

  /// Whether the handle of something is one of this scene's.
  template <int D>
  [[nodiscard]] bool has(const dalembert::Particle<D>& p) const {
    return D == dimension && has_entry(particles, p) &&
           particles[static_cast<std::size_t>(p.index)].coordinate == p.coordinate;
  }
  [[nodiscard]] bool has(const dalembert::Rotor& r) const {
    return has_entry(rotors, r) && rotors[static_cast<std::size_t>(r.index)].coordinate == r.coordinate;
  }
  template <int Rows>
  [[nodiscard]] bool has(const dalembert::Constraint<Rows>& c) const {
    return has_constraint(c.index, c.scene, Rows);
  }
  [[nodiscard]] bool has_constraint(int index, std::uint64_t id_of_scene, int rows) const {
    return has_entry(constraints, dalembert::Constraint<1>{index, id_of_scene}) &&
           constraints[static_cast<std::size_t>(index)].rows == rows;
  }
  [[nodiscard]] bool has(const dalembert::Force& f) const { return has_entry(forces, f); }

  /// Throws InvalidArgument, which says what is wrong, unless it is.
  template <class Handle>
  void require(const Handle& handle) const {
    if (!has(handle)) refuse(handle.scene);
  }

  /// n, once the slots have been indexed.
  [[nodiscard]] std::size_t coordinates() const { return touching_start.size() - 1; }
  [[nodiscard]] std::span<const int> touching_slots(int coordinate) const {
    const auto i = static_cast<std::size_t>(coordinate);
    const auto first = static_cast<std::size_t>(touching_start[i]);
    return std::span(touching).subspan(first, static_cast<std::size_t>(touching_start[i + 1]) - first);
  }
  /// Sets which slots act on each coordinate, once all have their places.
  void index_slots(std::size_t coordinates);

  /// The particle that a coordinate belongs to, or none: it is a rotor's.
  [[nodiscard]] const Particle* particle_at(int coordinate) const;
  /// particle "bob" along x, or the rotor.
  [[nodiscard]] std::string label_of_coordinate(int coordinate) const;

 private:
  [[noreturn]] void refuse(std::uint64_t scene) const;
  template <class Entry, class Handle>
  [[nodiscard]] static bool has_entry(const std::vector<Entry>& all, const Handle& handle) {
    return handle.index >= 0 && static_cast<std::size_t>(handle.index) < all.size() &&
           all[static_cast<std::size_t>(handle.index)].scene == handle.scene;
  }
};

}  // namespace dalembert
