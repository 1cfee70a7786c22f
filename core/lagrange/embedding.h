#pragma once

#include <dalembert/core/lagrange/lagrangian_motion.h>
#include <dalembert/core/scene/scene.h>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace dalembert {

namespace detail {
/// Throws InvalidArgument, naming it, if the place of a particle or rotor is not a number.
void require_all_placed(const Layout& layout, std::span<const double> q);
/// Throws EquationFault, naming what was to be placed, for what the function that places it has thrown.
[[noreturn]] void rethrow_placing(const Layout& layout, int coordinate, double t);
/// Throws InvalidArgument if a force of the system reads multipliers.
void require_frictionless(const System& system);
/// Z = M a - F.
void constraint_forces(const System& system, const Instant& at, std::span<const double> a,
                       std::span<double> Z);
}  // namespace detail

/// Where the particles and rotors of a scene are for the coordinates of a Lagrangian: r([t,] q) for each.
///
///   Embedding<2, 1> embedding;
///   embedding.add(bob, [](const auto& phi) { return vec(sin(phi[0]), -cos(phi[0])); });
///
/// Written for any scalar: velocities and accelerations follow by differentiation along the motion.
template <int D, int N>
class Embedding {
  using Time = Jet<1>;  // a quantity along the motion: its value, rate and acceleration
  template <class F>
  static constexpr bool Places = detail::ColumnOf<
      std::remove_cvref_t<decltype(detail::call_in_time(std::declval<const F&>(), std::declval<const Time&>(),
                                                        std::declval<const VecOf<Time, N>&>()))>,
      D>;

 public:
  /// Where a particle is, a column of the scene's dimension.
  template <class Position>
  void add(Particle<D> particle, Position position) {
    static_assert(Places<Position>,
                  "the place of a particle is a plain column of the scene's dimension, vec(x, y); "
                  "of an Eigen expression its .eval()");
    put<D>(particle, std::move(position), [](const auto& r, int k) { return r[k]; });
  }
  /// An angle, a number.
  template <class Angle>
  void add(Rotor rotor, Angle angle) {
    put<1>(rotor, std::move(angle), [](const auto& a, int) { return a; });
  }

  /// q, v and a of the scene's coordinates for those of the Lagrangian. Throws InvalidArgument if a particle
  /// or rotor of the scene is missing, or one of another scene is not.
  void write(const Layout& layout, double t, const Vec<N>& q, const Vec<N>& v, const Vec<N>& a,
             std::span<double> out_q, std::span<double> out_v, std::span<double> out_a) const;

 private:
  struct Part {
    std::function<void(const Layout&)> require;
    int first, count;
    std::function<void(const Time& t, const VecOf<Time, N>& q, std::span<Time> out)> place;
  };

  template <int Count, class Handle, class F, class Component>
  void put(const Handle& handle, F function, Component component) {
    parts_.push_back({[handle](const Layout& layout) { layout.require(handle); }, handle.coordinate, Count,
                      [function = std::move(function), component](const Time& t, const VecOf<Time, N>& q,
                                                                  std::span<Time> out) {
                        const auto placed = detail::call_in_time(function, t, q);
                        for (int k = 0; k < Count; ++k)
                          out[static_cast<std::size_t>(k)] = Time(component(placed, k));
                      }});
  }

  std::vector<Part> parts_;
};

template <int D, int N>
void Embedding<D, N>::write(const Layout& layout, double t, const Vec<N>& q, const Vec<N>& v, const Vec<N>& a,
                            std::span<double> out_q, std::span<double> out_v, std::span<double> out_a) const {
  VecOf<Time, N> along;
  for (int k = 0; k < N; ++k) {
    along[k] = Time::input(q[k], 0, v[k]);
    along[k].ss = a[k];
  }
  for (double& r : out_q) r = std::numeric_limits<double>::quiet_NaN();
  for (const Part& part : parts_) {
    part.require(layout);
    std::array<Time, static_cast<std::size_t>(D)> r;
    try {
      part.place(Time::input(t, 0, 1.0), along, r);
    } catch (...) {
      detail::rethrow_placing(layout, part.first, t);
    }
    for (int k = 0; k < part.count; ++k) {
      const auto i = static_cast<std::size_t>(part.first + k);
      const Time& x = r[static_cast<std::size_t>(k)];
      if (!std::isfinite(x.ss) || !std::isfinite(x.s) || !std::isfinite(x.value))
        throw EquationFault("The embedding has no finite value or derivatives of " +
                            layout.label_of_coordinate(part.first + k) + " at t = " + detail::text(t));
      out_q[i] = x.value;
      out_v[i] = x.s;
      out_a[i] = x.ss;
    }
  }
  detail::require_all_placed(layout, out_q);
}

/// A Lagrangian motion brought back to the particles of a scene, with the forces of constraint there,
///
///   Z = m a - F,                                                                                         (1)
///
/// F the applied forces of the scene: what all its constraints exert on each particle together (notes, mln8).
template <int D>
class EmbeddedMotion {
 public:
  /// Of samples.
  [[nodiscard]] std::size_t size() const { return times_.size(); }
  /// Of the samples [time].
  [[nodiscard]] std::span<const double> times() const& { return times_; }
  void times() const&& = delete;
  /// Of a particle at sample i.
  [[nodiscard]] Vec<D> position(Particle<D> p, std::size_t i) const { return read(0, p, i); }
  /// Of a particle at sample i.
  [[nodiscard]] Vec<D> velocity(Particle<D> p, std::size_t i) const { return read(1, p, i); }
  /// Of a particle at sample i.
  [[nodiscard]] Vec<D> acceleration(Particle<D> p, std::size_t i) const { return read(2, p, i); }
  /// Of all constraints on a particle at sample i [force].
  [[nodiscard]] Vec<D> constraint_force(Particle<D> p, std::size_t i) const { return read(3, p, i); }
  /// Of all constraints on a rotor at sample i [force length].
  [[nodiscard]] double constraint_torque(Rotor rotor, std::size_t i) const {
    layout_->require(rotor);
    return number(3, i)[static_cast<std::size_t>(rotor.coordinate)];
  }
  /// Of all coordinates of the scene at sample i.
  [[nodiscard]] std::span<const double> positions(std::size_t i) const& { return number(0, i); }
  /// Likewise.
  [[nodiscard]] std::span<const double> velocities(std::size_t i) const& { return number(1, i); }
  /// Likewise.
  [[nodiscard]] std::span<const double> constraint_forces(std::size_t i) const& { return number(3, i); }

  /// Throws InvalidArgument if the scene has forces that read multipliers: (1) does not determine them.
  template <int N>
  EmbeddedMotion(const Scene<D>& scene, const Embedding<D, N>& embedding, const LagrangianMotion<N>& motion);
  EmbeddedMotion(const EmbeddedMotion&) = default;             ///< also of one that is moved
  EmbeddedMotion& operator=(const EmbeddedMotion&) = default;  ///< likewise

 private:
  [[nodiscard]] std::span<const double> number(std::size_t which, std::size_t i) const;
  [[nodiscard]] Vec<D> read(std::size_t which, Particle<D> p, std::size_t i) const {
    layout_->require(p);
    return p.gather(number(which, i));
  }

  std::shared_ptr<const Layout> layout_;
  std::size_t coordinates_;
  std::vector<double> times_, values_;  ///< per sample: q, v, a, Z
};

template <int D>
template <int N>
EmbeddedMotion<D>::EmbeddedMotion(const Scene<D>& scene, const Embedding<D, N>& embedding,
                                  const LagrangianMotion<N>& motion) {
  const System system = scene.system();
  detail::require_frictionless(system);
  layout_ = system.layout();
  coordinates_ = system.coordinates();
  values_.resize(4 * coordinates_ * motion.size());
  const std::span all(values_);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double t = motion.times()[i];
    const auto part = [&](std::size_t which) {
      return all.subspan((4 * i + which) * coordinates_, coordinates_);
    };
    embedding.write(*layout_, t, motion.position(i), motion.velocity(i), motion.acceleration(i), part(0),
                    part(1), part(2));
    detail::constraint_forces(system, {t, part(0), part(1)}, part(2), part(3));
    times_.push_back(t);
  }
}

template <int D>
std::span<const double> EmbeddedMotion<D>::number(std::size_t which, std::size_t i) const {
  if (i >= size())
    throw InvalidArgument("sample " + std::to_string(i) + " was asked for, of " + std::to_string(size()));
  return std::span(values_).subspan((4 * i + which) * coordinates_, coordinates_);
}

}  // namespace dalembert
