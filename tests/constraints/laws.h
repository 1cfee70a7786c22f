#pragma once

#include <dalembert/core/scene/scene.h>

#include <Eigen/Geometry>

#include <functional>
#include <string>

/// The laws that every constraint type must satisfy, whatever its equation. A type is put under them by one
/// line in one of the laws_*.cpp.
namespace dalembert::laws {

/// A rotation and a translation. A constraint that is built through one of these is the same
/// constraint in another place.
template <int D>
struct Placement {
  Eigen::Matrix<double, D, D> turn = Eigen::Matrix<double, D, D>::Identity();
  Vec<D> shift = Vec<D>::Zero();

  /// A point given by its coordinates, numbers or functions of time.
  template <class... S>
  auto point(const S&... x) const {
    const auto r = vec(x...);
    using T = typename decltype(r)::Scalar;
    return VecOf<T, D>(turn.template cast<T>() * r + shift.template cast<T>());
  }
  [[nodiscard]] Fixed<D> fixed(auto... x) const { return {point(x...)}; }
  [[nodiscard]] Vec<D> direction(auto... x) const { return turn * vec(x...); }
};

template <int D>
Placement<D> elsewhere();
/// Adds one constraint to a scene, built through a placement on two particles.
template <int D>
using Add = std::function<void(Scene<D>&, const Placement<D>&, Particle<D>, Particle<D>)>;

void register_test(const char* suite, const std::string& name, const std::function<void()>& body);

/// The laws for all constraints.
template <int D>
void any(const std::string& type, const Add<D>& add);

/// And for those whose equation knows no preferred place or direction.
template <int D>
void invariant(const std::string& type, const Add<D>& add);

/// And for those whose multiplier is a force.
template <int D>
void geometric(const std::string& type, const Add<D>& add);

}  // namespace dalembert::laws
