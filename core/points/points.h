#pragma once

#include <dalembert/core/autodiff/mistakes.h>
#include <dalembert/core/vec.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

namespace dalembert {

/// N numbers from `first` on.
template <int N>
[[nodiscard]] std::array<int, static_cast<std::size_t>(N)> consecutive(int first) {
  std::array<int, static_cast<std::size_t>(N)> all{};
  for (int& number : all) number = first++;
  return all;
}

/// A point that never moves; it reads no coordinates.
template <int D>
struct Fixed {
  static constexpr int dimension = D;
  static constexpr int inputs = 0;
  static constexpr int coordinates = 0;
  static constexpr bool driven = false;

  Vec<D> position = Vec<D>::Zero();  ///< [length]
};

/// A particle of a scene, as returned by Scene::add_particle: a handle to read results with, and a
/// point to build constraints and forces on. Valid for its own scene (and copies of it) only.
template <int D>
struct Particle {
  static constexpr int dimension = D;
  static constexpr int inputs = D;
  static constexpr int coordinates = D;
  static constexpr bool driven = false;

  int index = -1;           ///< its number in the scene, in the order of adding
  int coordinate = -1;      ///< where its D coordinates begin in q
  std::uint64_t scene = 0;  ///< identity of the scene it belongs to

  /// Its D numbers out of q (its position) or v (its velocity).
  [[nodiscard]] Vec<D> gather(std::span<const double> x) const { return Vec<D>::from(x.data() + coordinate); }
  /// The coordinates that it reads.
  [[nodiscard]] auto reads() const { return consecutive<D>(coordinate); }

  friend bool operator==(const Particle&, const Particle&) = default;
};

/// A scalar angle with its own inertia, as returned by Scene::add_rotor: the spin of a wheel, say. As
/// a point of a constraint it gives that angle, a vector of one number, and its rate as velocity.
struct Rotor {
  static constexpr int dimension = 1;
  static constexpr int inputs = 1;
  static constexpr int coordinates = 1;
  static constexpr bool driven = false;

  int index = -1;           ///< its number among the rotors of the scene
  int coordinate = -1;      ///< its place in q
  std::uint64_t scene = 0;  ///< identity of the scene it belongs to

  /// Its angle, as a vector of one number.
  [[nodiscard]] Vec<1> gather(std::span<const double> x) const {
    return Vec<1>(x[static_cast<std::size_t>(coordinate)]);
  }
  /// The coordinate that it reads.
  [[nodiscard]] auto reads() const { return consecutive<1>(coordinate); }

  friend bool operator==(const Rotor&, const Rotor&) = default;
};

/// A point that follows a prescribed path r(t); made by `driven`. Its path is differentiated with
/// respect to time, so it must be written for any scalar: `[](auto t) { return vec(...); }`.
template <int D, class Path>
struct Driven {
  static constexpr int dimension = D;
  static constexpr int inputs = 0;
  static constexpr int coordinates = 0;
  static constexpr bool driven = true;

  Path path;  ///< a function of time
};

/// A driven point from its path: `driven([](auto t) { return vec(0.1 * sin(10.0 * t), 0.0); })`.
template <class Path>
[[nodiscard]] auto driven(Path path) {
  static_assert(
      !detail::NamesItsArguments<Path>,
      "write `auto` for the time that a path takes: it is called with numbers that carry derivatives");
  using Position = decltype(path(0.0));
  static_assert(detail::Column<Position>,
                "a path returns a plain column of fixed size, vec(x, y); of an Eigen expression its .eval()");
  return Driven<Position::RowsAtCompileTime, Path>{std::move(path)};
}

namespace detail {

template <class P>
concept HasSizes = requires {
  { P::dimension } -> std::convertible_to<int>;
  { P::inputs } -> std::convertible_to<int>;
  { P::coordinates } -> std::convertible_to<int>;
  { P::driven } -> std::convertible_to<bool>;
};

/// What a scene has given out, or what is made of that.
template <class P>
concept OfScene = std::same_as<P, Particle<P::dimension>> || std::same_as<P, Rotor>;
template <class P>
concept OfParticles = requires(const P& point) {
  { point.particles[0] } -> std::convertible_to<Particle<P::dimension>>;
};

template <class P>
concept HasMap = requires(const P& point) {
  point.map();
};

/// Which entries of q a point reads, and its numbers out of these.
template <class P>
concept HasCoordinates = (OfScene<P> || OfParticles<P>)&&P::inputs == P::dimension && !P::driven
                         && HasMap<P> == (P::inputs != P::coordinates) &&
                         requires(const P& point, std::span<const double> q) {
  { point.reads() } -> std::convertible_to<std::array<int, static_cast<std::size_t>(P::coordinates)>>;
  requires ColumnOf<std::remove_cvref_t<decltype(point.gather(q))>, P::inputs>;
};

template <class P>
concept HasPath = P::driven && P::coordinates == 0 && requires(const P& point) {
  requires ColumnOf<std::remove_cvref_t<decltype(point.path(0.0))>, P::dimension>;
};

template <class P>
concept HasPosition = !P::driven && P::coordinates == 0 && requires(const P& point) {
  requires ColumnOf<std::remove_cvref_t<decltype(point.position)>, P::dimension>;
};

}  // namespace detail

/// Anything with a position. `inputs` is how many numbers of that position are unknowns (none or
/// all), so that equations are differentiated with respect to those only; they are a constant linear
/// function of `coordinates` entries of q, given by `map()` unless they are those entries. `driven`
/// says that the position depends on time explicitly, as `path(t)`.
template <class P>
concept Point = detail::HasSizes<P> &&((P::inputs > 0 && detail::HasCoordinates<P>) ||
                                       (P::inputs == 0 && (detail::HasPath<P> || detail::HasPosition<P>)));

/// The points that a constraint or force acts on, in the order of its equation's arguments.
template <Point... P>
[[nodiscard]] std::tuple<P...> points(P... point) {
  return {std::move(point)...};
}

}  // namespace dalembert
