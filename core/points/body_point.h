#pragma once

#include <dalembert/core/points/points.h>

#include <array>
#include <span>

namespace dalembert {

/// A point fixed in a rigid body, as made by RigidBody::point: a constant linear map of the body's
/// particles, r = L (p_1, ..., p_k), two particles in the plane and four in space. On a ThinRod it is
/// a map of two particles in space too, on a Lamina of three.
///
/// Equations are differentiated with respect to the D numbers of r; L carries gradients and second
/// derivatives on to the particles.
template <int D, int Particles = (D == 2 ? 2 : 4)>
struct BodyPoint {
  static constexpr int dimension = D;
  static constexpr int inputs = D;
  static constexpr int count = Particles;  ///< of particles
  static constexpr int coordinates = count * D;
  static constexpr bool driven = false;
  using Map = Mat<D, coordinates>;  ///< from the particles' coordinates to the point's

  std::array<Particle<D>, static_cast<std::size_t>(count)> particles;  ///< of its body
  Map L;                                                               ///< constant

  /// Constant.
  [[nodiscard]] const Map& map() const { return L; }
  /// Its value from all coordinates, or from their rates.
  [[nodiscard]] Vec<D> gather(std::span<const double> x) const {
    Vec<D> r = Vec<D>::Zero();
    int column = 0;
    for (const auto& particle : particles) {
      const Vec<D> p = particle.gather(x);
      for (int k = 0; k < D; ++k, ++column) {
        for (int i = 0; i < D; ++i) r[i] += L(i, column) * p[k];
      }
    }
    return r;
  }
  /// The coordinates that it reads.
  [[nodiscard]] std::array<int, static_cast<std::size_t>(coordinates)> reads() const {
    std::array<int, static_cast<std::size_t>(coordinates)> all{};
    auto next = all.begin();
    for (const auto& particle : particles) {
      for (const int number : particle.reads()) *next++ = number;
    }
    return all;
  }
};

}  // namespace dalembert
