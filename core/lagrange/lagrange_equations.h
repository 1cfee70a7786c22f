#pragma once

#include <dalembert/core/forces/force.h>
#include <dalembert/core/lagrange/accelerations.h>
#include <dalembert/core/lagrange/lagrange_terms.h>
#include <dalembert/core/lagrange/stated_by_lagrangians.h>
#include <dalembert/core/scene/system.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace dalembert {

template <int N>
class LagrangeBatch;

/// Generalized forces Q(t, q, v), one per coordinate.
template <int N>
using GeneralizedForce = std::function<Vec<N>(double t, const Vec<N>& q, const Vec<N>& v)>;

/// Lagrange's equations of N coordinates q = scale u, as the force on N rotors of unit inertia, their angles
/// u, that gives them the same accelerations. With v = u' and L as a function of u and v,
///
///   L_vv u'' = f + A^T lambda,   A u'' + gamma = 0,    f = L_u - L_vu v - L_vt + Q                       (1)
///      1 u'' = F,                F = u'' out of (1)                                                      (2)
///
/// (2) satisfies the constraints by itself: they are among those of the scene so that the motion stays on
/// them, and exert no force there. So both steppers, projection and dense output serve a Lagrangian as they
/// serve a scene, whatever the size of L_vv, and the multipliers are solved for where they are read.
template <int N>
struct LagrangeEquations {
  static constexpr std::string_view kind = "Lagrangian";
  using Batch = LagrangeBatch<N>;

  std::array<Rotor, static_cast<std::size_t>(N)> coordinates;
  Vec<N> scale;
  std::shared_ptr<const Lagrangian<N>> lagrangian;
  std::vector<GeneralizedForce<N>> forces;
  std::shared_ptr<const System> constraints;  ///< of the same rotors, or null if there are none
  int sign = 0;  ///< of the inertia's determinant at the start of a run, see Accelerations; 0 if not known

  auto points() const { return std::tuple_cat(coordinates); }

  /// (1) at one instant.
  struct Solved {
    Vec<N> a;         ///< u''
    Vec<N> reaction;  ///< A^T lambda
    detail::ConstraintRows rows;
    int sign;
  };
  /// Throws std::domain_error where no acceleration follows.
  [[nodiscard]] Solved solved(const Instant& at) const;
  /// The energy function less the kinetic energy of the rotors: so that both together are the former.
  [[nodiscard]] double energy(const Instant& at) const;
  /// Adds L and its momenta.
  void add_values(const Instant& at, const Instant& errors, StatedByLagrangians::Values& out) const;
};

template <int N>
typename LagrangeEquations<N>::Solved LagrangeEquations<N>::solved(const Instant& at) const {
  const Vec<N> q = scale.cwiseProduct(detail::gather_inputs(*this, at.q)),
               v = scale.cwiseProduct(detail::gather_inputs(*this, at.v));
  const LagrangeTerms<N> terms = lagrangian->terms(at.t, q, v);
  Vec<N> f = terms.force(v);
  for (const auto& Q : forces) f += Q(at.t, q, v);
  f = scale.cwiseProduct(f);
  typename LagrangeTerms<N>::Matrix inertia = terms.L_vv;
  for (int k = 0; k < N; ++k) {
    for (int row = 0; row < N; ++row) inertia(row, k) *= scale[row] * scale[k];
  }
  if (!std::isfinite(terms.L) || !inertia.allFinite() || !terms.force(v).allFinite())
    throw std::domain_error("has no finite value or derivatives");
  if (!f.allFinite()) throw std::domain_error("has a generalized force that is not finite");
  detail::ConstraintRows rows;
  if (constraints) rows = detail::rows_of(*constraints, at);
  const auto found = detail::accelerations({inertia.data(), N * N}, {f.data(), N}, rows);
  const Vec<N> a = Vec<N>::from(found.a.data());
  if (!found.determined) {
    const Vec<N> along = scale.cwiseProduct(a);
    throw std::domain_error(detail::no_inertia({q.data(), N}, {along.data(), N}));
  }
  if (sign != 0 && found.sign != sign) throw std::domain_error(detail::inertia_lost({q.data(), N}));
  return {a, inertia * a - f, std::move(rows), found.sign};
}

template <int N>
double LagrangeEquations<N>::energy(const Instant& at) const {
  const Vec<N> v = detail::gather_inputs(*this, at.v), q_rate = scale.cwiseProduct(v);
  return lagrangian->terms(at.t, scale.cwiseProduct(detail::gather_inputs(*this, at.q)), q_rate)
             .energy(q_rate) -
         0.5 * v.squaredNorm();
}

template <int N>
void LagrangeEquations<N>::add_values(const Instant& at, const Instant& errors,
                                      StatedByLagrangians::Values& out) const {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  const auto scaled = [&](std::span<const double> of) -> Vec<N> {
    return scale.cwiseProduct(detail::gather_inputs(*this, of));
  };
  const Vec<N> dq = scaled(errors.q), dv = scaled(errors.v);
  const LagrangeTerms<N> terms = lagrangian->terms(at.t, scaled(at.q), scaled(at.v));
  double error = rounding * std::abs(terms.L);
  for (int k = 0; k < N; ++k) {
    const double p = std::abs(terms.L_v[k]);
    double of_p = rounding * p + std::abs(terms.L_vt[k]) * errors.t;
    for (int j = 0; j < N; ++j)
      of_p += std::abs(terms.L_vv(k, j)) * dv[j] + std::abs(terms.L_vq(k, j)) * dq[j];
    out.momenta.push_back({terms.L_v[k], of_p});
    error += (p + of_p) * dv[k] + std::abs(terms.L_q[k]) * dq[k];
  }
  out.L.push_back({terms.L, error});
}

/// Lagrange's equations among the forces of a scene.
template <int N>
class LagrangeBatch final : public ForceBatch, public StatedByLagrangians {
  using Element = LagrangeEquations<N>;

 public:
  [[nodiscard]] bool holds(const std::type_info& type) const { return *elements_.type().type == type; }
  void add(const void* element) { elements_.add(element); }
  void replace(std::size_t i, const void* element) { elements_.replace(i, element); }

  [[nodiscard]] std::unique_ptr<ForceBatch> clone() const override {
    return std::make_unique<LagrangeBatch>(*this);
  }
  [[nodiscard]] ForceShape shape() const override { return {Element::kind, N, 0, true, true, true}; }
  [[nodiscard]] std::size_t size() const override { return elements_.size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return elements_.coordinates(); }

  void add_force(const Instant& at, const Multipliers& /*lambda*/, std::span<double> F) const override {
    for_each([&](const Element& e, std::size_t i) {
      const Vec<N> f = force_of(e, i, at);
      for (int k = 0; k < N; ++k) F[place(i, k)] += f[k];
    });
  }
  void power(const Instant& at, const Multipliers& /*lambda*/, std::span<double> out) const override {
    for_each([&](const Element& e, std::size_t i) {
      out[i] = force_of(e, i, at).dot(detail::gather_inputs(e, at.v));
    });
  }
  void force(std::size_t element, const Instant& at, std::span<const double> /*lambda*/,
             std::span<double> out) const override {
    at_element(element, [&](const Element& e, std::size_t i) {
      const Vec<N> f = force_of(e, i, at);
      for (int k = 0; k < N; ++k) out[static_cast<std::size_t>(k)] = f[k];
    });
  }
  [[nodiscard]] double energy(const Instant& at) const override {
    double sum = 0.0;
    for_each([&](const Element& e, std::size_t) { sum += e.energy(at); });
    return sum;
  }
  [[nodiscard]] Values lagrangians(const Instant& at, const Instant& errors) const override {
    Values all;
    for_each([&](const Element& e, std::size_t) { e.add_values(at, errors, all); });
    return all;
  }

  /// By central differences: only Newton's matrix reads them, whose iteration corrects what they err, and
  /// third derivatives of L would cost N times its second ones. The step is the cube root of round-off, of a
  /// coordinate's unit and of the largest velocity.
  void linearise(const Instant& at, const Multipliers& /*lambda*/, std::span<double> stiffness,
                 std::span<double> damping) const override {
    for_each([&](const Element& e, std::size_t i) {
      const double speed = typical_speed(e, i, at);
      std::vector<double> q(at.q.begin(), at.q.end()), v(at.v.begin(), at.v.end());
      for (int k = 0; k < N; ++k) {
        const std::size_t number = place(i, k);
        const auto write = [&](double& x, double unit, std::span<double> out) {
          const double middle = x, h = std::cbrt(std::numeric_limits<double>::epsilon()) * unit;
          x = middle + h;
          const Vec<N> after = force_of(e, i, {at.t, q, v});
          x = middle - h;
          const Vec<N> slope = (after - force_of(e, i, {at.t, q, v})) / (2.0 * h);
          x = middle;
          for (int row = 0; row < N; ++row)
            out[(i * N + static_cast<std::size_t>(row)) * N + static_cast<std::size_t>(k)] = slope[row];
        };
        write(q[number], 1.0, stiffness);
        write(v[number], speed, damping);
      }
    });
  }

 private:
  static constexpr ElementType type_ = element_type_of<Element>();

  template <class F>
  void at_element(std::size_t i, const F& f) const {
    try {
      f(*static_cast<const Element*>(elements_[i]), i);
    } catch (const EquationFault&) {
      throw;  // of a constraint, whose name it has
    } catch (...) {
      detail::rethrow_as_fault(i);
    }
  }
  template <class F>
  void for_each(const F& f) const {
    for (std::size_t i = 0; i < size(); ++i) at_element(i, f);
  }
  /// In q, of coordinate k.
  [[nodiscard]] std::size_t place(std::size_t i, int k) const {
    return static_cast<std::size_t>(elements_.coordinates(i)[static_cast<std::size_t>(k)]);
  }
  [[nodiscard]] static Vec<N> force_of(const Element& e, std::size_t i, const Instant& at) {
    try {
      return e.solved(at).a;
    } catch (const std::domain_error& none) {
      throw ElementFault{i, none.what()};
    }
  }
  /// A velocity of the size of those there are, or that the force gives over a unit.
  [[nodiscard]] static double typical_speed(const Element& e, std::size_t i, const Instant& at) {
    const double own = detail::gather_inputs(e, at.v).cwiseAbs().maxCoeff(),
                 given = std::sqrt(force_of(e, i, at).cwiseAbs().maxCoeff());
    return own > given ? own : given > 0.0 ? given : 1.0;
  }

  Elements elements_{type_};
};

}  // namespace dalembert
