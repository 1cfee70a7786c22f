#pragma once

#include <dalembert/core/results/sample.h>

#include <cstddef>

namespace dalembert {

/// The functions of Sample, for what has samples: a Trajectory many, read with the number of one behind the
/// other arguments (At is std::size_t), a Simulation its current one (At is empty).
///
/// `Source` has `sample(At...)`. See Sample for what each function means and throws.
template <int D, class Source, class... At>
class Readings {
 public:
  [[nodiscard]] double energy(At... at) const { return now(at...).energy(); }

  template <Point P>
  [[nodiscard]] auto position(const P& point, At... at) const {
    return now(at...).position(point);
  }
  template <Point P>
  [[nodiscard]] auto velocity(const P& point, At... at) const {
    return now(at...).velocity(point);
  }
  template <Point P>
  [[nodiscard]] auto acceleration(const P& point, At... at) const {
    return now(at...).acceleration(point);
  }
  [[nodiscard]] double angle(Rotor rotor, At... at) const { return now(at...).angle(rotor); }
  [[nodiscard]] double angular_velocity(Rotor rotor, At... at) const {
    return now(at...).angular_velocity(rotor);
  }
  [[nodiscard]] double angular_acceleration(Rotor rotor, At... at) const {
    return now(at...).angular_acceleration(rotor);
  }

  template <int Rows>
  [[nodiscard]] Multiplier<Rows> multiplier(Constraint<Rows> constraint, At... at) const {
    return now(at...).multiplier(constraint);
  }
  template <int Rows>
  [[nodiscard]] bool is_determined(Constraint<Rows> constraint, At... at) const {
    return now(at...).is_determined(constraint);
  }
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint, At... at) const {
    return now(at...).is_unique(constraint);
  }
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint, int component, At... at) const {
    return now(at...).is_unique(constraint, component);
  }

  /// On a particle or a body.
  template <int Rows, class Body>
  [[nodiscard]] auto constraint_force(Constraint<Rows> constraint, const Body& body, At... at) const {
    return now(at...).constraint_force(constraint, body);
  }
  template <class Body>
  [[nodiscard]] auto constraint_force(const Body& body, At... at) const {
    return now(at...).constraint_force(body);
  }
  template <int Rows, class Body>
  [[nodiscard]] auto constraint_moment(Constraint<Rows> constraint, const Body& body, const Vec<D>& about,
                                       At... at) const {
    return now(at...).constraint_moment(constraint, body, about);
  }
  template <class Body>
  [[nodiscard]] auto constraint_moment(const Body& body, const Vec<D>& about, At... at) const {
    return now(at...).constraint_moment(body, about);
  }
  template <int Rows>
  [[nodiscard]] double constraint_torque(Constraint<Rows> constraint, Rotor rotor, At... at) const {
    return now(at...).constraint_torque(constraint, rotor);
  }
  template <int Rows>
  [[nodiscard]] auto ground_force(Constraint<Rows> constraint, At... at) const {
    return now(at...).ground_force(constraint);
  }
  template <int Rows>
  [[nodiscard]] auto ground_moment(Constraint<Rows> constraint, const Vec<D>& about, At... at) const {
    return now(at...).ground_moment(constraint, about);
  }

  /// On a particle or a body.
  template <class Body>
  [[nodiscard]] auto force(Force force, const Body& body, At... at) const {
    return now(at...).force(force, body);
  }
  [[nodiscard]] double torque(Force force, Rotor rotor, At... at) const {
    return now(at...).torque(force, rotor);
  }

 private:
  [[nodiscard]] auto now(At... at) const { return static_cast<const Source&>(*this).sample(at...); }
};

}  // namespace dalembert
