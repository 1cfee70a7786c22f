#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

/// Holonomic constraints of one type, with every derivative taken from the equation g itself.
///
/// With z = (inputs, t) and dots along the motion (r' = v, t' = 1):
///   psi   = g_r v + g_t                      W = g_r
///   gamma = psi_r v + psi_t = d^2 g / ds^2   along r + v s, t + s
///   psi_q = (g_zz (v, 1))_r                  d(W^T lambda)/dq = lambda g_rr
template <HolonomicConstraint C>
class HolonomicBatch final : public ConstraintBatch {
  static constexpr int inputs = PointFacts<C>::inputs;
  static constexpr int width = PointFacts<C>::coordinates;
  static constexpr int rows = rows_of_constraint<C>;
  static constexpr bool timed = is_timed<C>;

 public:
  void add(C constraint) { elements_.add(std::move(constraint)); }
  void replace(std::size_t i, const C& constraint) { elements_.replace(i, constraint); }

  [[nodiscard]] std::unique_ptr<ConstraintBatch> clone() const override {
    return std::make_unique<HolonomicBatch>(*this);
  }
  [[nodiscard]] ConstraintShape shape() const override {
    return {detail::kind_of<C>("Holonomic"), rows, width, inputs, is_internal<C>, true, timed,
            detail::singular_hint_of<C>()};
  }
  [[nodiscard]] std::size_t size() const override { return elements_.all().size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return elements_.coordinates(); }

  void evaluate(const Instant& at, const ConstraintValues& out) const override {
    using S = Dual<inputs + timed, 1>;
    detail::for_each_element(elements_.all(), left_out(), [&](const C& c, std::size_t i) {
      const auto g = residual<S>(c, time<S>(at.t), at, detail::AsInput<S>{});
      const auto coordinate = elements_.coordinates(i);
      for (int k = 0; k < rows; ++k) {
        const S g_k = detail::row_of<S>(g, k);
        detail::require_finite(std::isfinite(g_k.value), i, "is not a finite number");
        if (!detail::all_finite(g_k.gradient)) {
          throw ElementFault{i, "has no gradient: " + std::string(detail::singular_hint_of<C>())};
        }
        const std::size_t row = i * rows + static_cast<std::size_t>(k);
        double psi = 0.0;
        if constexpr (timed) psi = g_k.gradient[inputs];
        std::array<double, width> w;
        detail::pull_back(c, g_k.gradient.data(), w.data());
        for (std::size_t j = 0; j < width; ++j) {
          out.w[row * width + j] = w[j];
          psi += w[j] * at.v[static_cast<std::size_t>(coordinate[j])];
        }
        out.g[row] = g_k.value;
        out.psi[row] = psi;
      }
    });
  }

  void forces_at_points(std::span<const double> w, std::span<const double> lengths,
                        std::span<double> out) const override {
    elements_.forces_at_points(rows, w, lengths, out);
  }

  void laws([[maybe_unused]] std::span<RowLaw> out) const override {
    if constexpr (HasCompliance<C>) {
      for (std::size_t row = 0; row < out.size(); ++row) out[row] = {elements_.all()[row / rows].compliance};
    }
  }

  void bias(const Instant& at, std::span<double> gamma) const override {
    using S = Dual<1, 2>;
    detail::for_each_element(elements_.all(), left_out(), [&](const C& c, std::size_t i) {
      const auto g = residual<S>(c, S::input(at.t, 0), at, detail::AlongMotion<S>{});
      for (int k = 0; k < rows; ++k) {
        const double second = detail::row_of<S>(g, k).hessian(0, 0);
        detail::require_finite(std::isfinite(second), i, "has no finite second derivative");
        gamma[i * rows + static_cast<std::size_t>(k)] = second;
      }
    });
  }

  void gaps(const Instant& at, std::span<double> g, std::span<double> rate) const override {
    if constexpr (OneSided<C>) {
      using S = Dual<1, 2>;
      detail::for_each_element(elements_.all(), [&](const C& c, std::size_t i) {
        const S along = detail::row_of<S>(residual<S>(c, S::input(at.t, 0), at, detail::AlongMotion<S>{}), 0);
        detail::require_finite(std::isfinite(along.value), i, "is not a finite number");
        g[i] = along.value;
        rate[i] = along.gradient[0];
      });
    }
  }

  void linearise(const Instant& at, std::span<const double> lambda, std::span<double> psi_q,
                 std::span<double> stiffness) const override {
    using S = Dual<inputs + timed, 2>;
    detail::for_each_element(elements_.all(), left_out(), [&](const C& c, std::size_t i) {
      const auto g = residual<S>(c, time<S>(at.t), at, detail::AsInput<S>{});
      const auto v = detail::gather_inputs(c, at.v);
      std::array<double, inputs * inputs> curvature{};
      for (int k = 0; k < rows; ++k) {
        const std::size_t row = i * rows + static_cast<std::size_t>(k);
        const S g_k = detail::row_of<S>(g, k);
        detail::require_finite(detail::all_finite(g_k.hessian), i, "has no finite second derivative");
        std::array<double, inputs> psi_r;
        for (int a = 0; a < inputs; ++a) {
          double sum = 0.0;
          for (int b = 0; b < inputs; ++b) sum += g_k.hessian(b, a) * v[b];
          if constexpr (timed) sum += g_k.hessian(inputs, a);
          psi_r[static_cast<std::size_t>(a)] = sum;
        }
        detail::pull_back(c, psi_r.data(), psi_q.data() + row * width);
        detail::add_block<inputs>(lambda[row], g_k.hessian, 0, curvature.data());
      }
      detail::pull_back_block(c, curvature.data(), stiffness.data() + i * width * width);
    });
  }

 private:
  template <class S>
  [[nodiscard]] static S time(double t) {
    if constexpr (timed) {
      return S::input(t, inputs);
    } else {
      return S(t);
    }
  }
  template <class S, class Lift>
  [[nodiscard]] static auto residual(const C& c, const S& t, const Instant& at, const Lift& lift) {
    return detail::call<detail::takes_time<C>>(c, t, detail::positions<S>(c, t, at, lift));
  }

  Elements<C> elements_;
};

}  // namespace dalembert
