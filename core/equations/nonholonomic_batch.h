#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// Nonholonomic constraints of one type: psi = a(t, r, v), linear in v.
///
///   W = a_v,   gamma = a_r v + a_t  (along r + v s, t + s with v held),   psi_q = a_r,
///   d(W^T lambda)/dq = lambda a_vr
template <NonholonomicConstraint C>
class NonholonomicBatch final : public ConstraintBatch {
  static constexpr int inputs = PointFacts<C>::inputs;
  static constexpr int width = PointFacts<C>::coordinates;
  static constexpr int rows = rows_of_constraint<C>;

 public:
  void add(C constraint) { elements_.add(std::move(constraint)); }
  void replace(std::size_t i, const C& constraint) { elements_.replace(i, constraint); }

  [[nodiscard]] std::unique_ptr<ConstraintBatch> clone() const override {
    return std::make_unique<NonholonomicBatch>(*this);
  }
  [[nodiscard]] ConstraintShape shape() const override {
    return {detail::kind_of<C>("Nonholonomic"), rows, width, inputs, is_internal<C>, false, is_timed<C>,
            detail::singular_hint_of<C>()};
  }
  [[nodiscard]] std::size_t size() const override { return elements_.all().size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return elements_.coordinates(); }

  void evaluate(const Instant& at, const ConstraintValues& out) const override {
    using S = Dual<inputs, 1>;
    detail::for_each_element(elements_.all(), left_out(), [&](const C& c, std::size_t i) {
      const auto a = residual<S>(c, S(at.t), at, detail::AsConstant<S>{}, detail::AsInput<S>{}, 0);
      for (int k = 0; k < rows; ++k) {
        const S a_k = detail::row_of<S>(a, k);
        detail::require_finite(std::isfinite(a_k.value), i, "is not a finite number");
        detail::require_finite(detail::all_finite(a_k.gradient), i, "has no finite gradient");
        const std::size_t row = i * rows + static_cast<std::size_t>(k);
        out.psi[row] = a_k.value;
        detail::pull_back(c, a_k.gradient.data(), out.w.data() + row * width);
      }
    });
  }

  void forces_at_points(std::span<const double> w, std::span<const double> lengths,
                        std::span<double> out) const override {
    elements_.forces_at_points(rows, w, lengths, out);
  }

  void bias(const Instant& at, std::span<double> gamma) const override {
    using S = Dual<1, 1>;
    detail::for_each_element(elements_.all(), left_out(), [&](const C& c, std::size_t i) {
      const auto a =
          residual<S>(c, S::input(at.t, 0), at, detail::AlongMotion<S>{}, detail::AsConstant<S>{}, 0);
      for (int k = 0; k < rows; ++k) {
        const double rate = detail::row_of<S>(a, k).gradient[0];
        detail::require_finite(std::isfinite(rate), i, "has no finite derivative");
        gamma[i * rows + static_cast<std::size_t>(k)] = rate;
      }
    });
  }

  void gaps(const Instant& at, std::span<double> /*g*/, std::span<double> u) const override {
    if constexpr (Rough<C>) {
      using S = Dual<1, 1>;  // as in `bias`
      detail::for_each_element(elements_.all(), [&](const C& c, std::size_t i) {
        const auto a = residual<S>(c, S(at.t), at, detail::AsConstant<S>{}, detail::AsConstant<S>{}, 0);
        for (int k = 0; k < rows; ++k) {
          const double slip = detail::row_of<S>(a, k).value;
          detail::require_finite(std::isfinite(slip), i, "is not a finite number");
          u[i * rows + static_cast<std::size_t>(k)] = slip;
        }
      });
    }
  }

  void linearise(const Instant& at, std::span<const double> lambda, std::span<double> psi_q,
                 std::span<double> stiffness) const override {
    using S = Dual<2 * inputs, 2>;
    detail::for_each_element(elements_.all(), left_out(), [&](const C& c, std::size_t i) {
      const auto a = residual<S>(c, S(at.t), at, detail::AsInput<S>{}, detail::AsInput<S>{}, inputs);
      std::array<double, inputs * inputs> turning{};
      for (int k = 0; k < rows; ++k) {
        const std::size_t row = i * rows + static_cast<std::size_t>(k);
        const S a_k = detail::row_of<S>(a, k);
        detail::require_finite(detail::all_finite(a_k.gradient) && detail::all_finite(a_k.hessian), i,
                               "has no finite second derivative");
        require_linear(a_k, detail::gather_inputs(c, at.v), i);
        detail::pull_back(c, a_k.gradient.data(), psi_q.data() + row * width);
        detail::add_block<inputs>(lambda[row], a_k.hessian, inputs, turning.data());
      }
      detail::pull_back_block(c, turning.data(), stiffness.data() + i * width * width);
    });
  }

 private:
  template <class S, class LiftPosition, class LiftVelocity>
  [[nodiscard]] static auto residual(const C& c, const S& t, const Instant& at, const LiftPosition& lift_r,
                                     const LiftVelocity& lift_v, int first_velocity) {
    return detail::call<detail::takes_time<C>>(
        c, t,
        std::tuple_cat(detail::positions<S>(c, t, at, lift_r),
                       detail::velocities<S>(c, t, at, lift_v, first_velocity)));
  }

  /// d^2 a/dv^2 vanishes for an equation linear in v; 1e-9 of the first derivative is far above the
  /// round-off of any formula that is linear after cancellation.
  static void require_linear(const Dual<2 * inputs, 2>& a, const Vec<inputs>& v, std::size_t i) {
    const double speed = v.cwiseAbs().maxCoeff();
    const double curvature = a.hessian.template bottomRightCorner<inputs, inputs>().cwiseAbs().maxCoeff();
    const double slope = a.gradient.template tail<inputs>().cwiseAbs().maxCoeff();
    detail::require_finite(curvature * speed <= 1e-9 * slope, i,
                           "is not linear in the velocities, as d'Alembert's principle requires");
  }

  Elements<C> elements_;
};

}  // namespace dalembert
