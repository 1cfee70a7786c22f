#pragma once

#include <dalembert/core/forces/friction.h>

namespace dalembert {

/// Forces of one type given by their law F(t, lambda, r, v), lambda the multipliers of a constraint.
template <FrictionForce E>
class FrictionBatch final : public MultiplierForceBatch {
  static constexpr int inputs = PointFacts<E>::inputs;
  static constexpr int width = PointFacts<E>::coordinates;
  static constexpr int rows = rows_read<E>;
  static constexpr bool takes_time =
      applicable_with_time<detail::FrictionOf<E>, detail::Probe<E>, detail::ProbeFriction<E>>;

 public:
  /// What Scene::add asks for.
  static constexpr bool gives_what_it_should =
      detail::are_forces<detail::ForceResult<detail::FrictionOf<E>, takes_time, E, detail::ProbeFriction<E>>,
                         PointTuple<E>>;

  void add(E element) {
    constraints_.push_back(element.constraint().index);
    try {
      elements_.add(std::move(element));
    } catch (...) {
      constraints_.pop_back();
      throw;
    }
  }
  void replace(std::size_t i, const E& element) {
    elements_.replace(i, element);
    constraints_[i] = element.constraint().index;
  }

  [[nodiscard]] std::unique_ptr<MultiplierForceBatch> clone() const override {
    return std::make_unique<FrictionBatch>(*this);
  }
  [[nodiscard]] MultiplierForceShape shape() const override {
    return {detail::kind_of<E>("Friction"), width, rows};
  }
  [[nodiscard]] std::size_t size() const override { return elements_.all().size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return elements_.coordinates(); }
  [[nodiscard]] std::span<const int> constraints() const override { return constraints_; }

  void add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const override {
    for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const Vec<inputs> f = forces<double>(e, at, own(lambda, i), AsNumber{}, AsNumber{}, AsNumber{});
      detail::require_finite(detail::all_finite(f), i, "is not a finite number");
      detail::scatter(e, f, elements_.coordinates(i), F);
    });
  }

  void power(const Instant& at, const Multipliers& lambda, std::span<double> out) const override {
    for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      out[i] = forces<double>(e, at, own(lambda, i), AsNumber{}, AsNumber{}, AsNumber{})
                   .dot(gather_inputs(e, at.v));
    });
  }

  void force(std::size_t element, const Instant& at, std::span<const double> lambda,
             std::span<double> out) const override {
    for_each_element(elements_.all(), element, element + 1, [&](const E& e, std::size_t) {
      const Vec<inputs> f = forces<double>(e, at, lambda, AsNumber{}, AsNumber{}, AsNumber{});
      detail::require_finite(detail::all_finite(f), element, "is not a finite number");
      pull_back(e, f.data(), out.data());
    });
  }

  void slope(const Instant& at, const Multipliers& lambda, std::span<double> out) const override {
    using S = Dual<rows, 1>;
    for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const VecOf<S, inputs> f = forces<S>(e, at, own(lambda, i), Held<S>{}, Held<S>{}, AsInput<S>{});
      for (int r = 0; r < rows; ++r) {
        Vec<inputs> f_lambda;
        for (int k = 0; k < inputs; ++k) f_lambda[k] = f[k].gradient[r];
        detail::require_finite(detail::all_finite(f_lambda), i, "has no finite derivative");
        pull_back(e, f_lambda.data(), out.data() + (i * rows + static_cast<std::size_t>(r)) * width);
      }
    });
  }

  void linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                 std::span<double> damping) const override {
    using S = Dual<2 * inputs, 1>;
    for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const VecOf<S, inputs> f = forces<S>(e, at, own(lambda, i), AsInput<S>{}, AsInput<S>{}, Held<S>{});
      detail::write_slopes<E, S>(e, i, f, stiffness, damping);
    });
  }

 private:
  /// A quantity that is held while others vary.
  template <class S>
  struct Held {
    S operator()(double x, double /*rate*/, int /*k*/) const { return S(x); }
  };

  /// The multipliers that element i reads.
  [[nodiscard]] static std::span<const double> own(const Multipliers& lambda, std::size_t i) {
    return lambda.all.subspan(lambda.first_row[i], rows);
  }
  /// The force of an element on each of its inputs, by the multipliers that it reads.
  template <class S, class LiftPosition, class LiftVelocity, class LiftMultiplier>
  [[nodiscard]] static VecOf<S, inputs> forces(const E& e, const Instant& at, std::span<const double> lambda,
                                               const LiftPosition& lift_r, const LiftVelocity& lift_v,
                                               const LiftMultiplier& lift) {
    detail::MultiplierOf<S, rows> multiplier;
    if constexpr (rows == 1) {
      multiplier = lift(lambda[0], 0.0, 0);
    } else {
      for (int r = 0; r < rows; ++r) multiplier[r] = lift(lambda[static_cast<std::size_t>(r)], 0.0, r);
    }
    const S t(at.t);
    const auto arguments = std::tuple_cat(std::make_tuple(multiplier), positions<S>(e, t, at, lift_r),
                                          velocities<S>(e, t, at, lift_v, inputs));
    return detail::forces_on_inputs<S, E>(call<takes_time>(detail::FrictionOf<E>{e}, t, arguments));
  }

  Elements<E> elements_;
  std::vector<int> constraints_;
};

}  // namespace dalembert
