#pragma once

#include <dalembert/core/forces/friction.h>

namespace dalembert {

namespace detail {

/// The law of an element and what it is called with behind time: `force` with positions and velocities, or
/// `friction` with multipliers in front of them.
template <class E>
struct LawTraits {
  using Function = ForceOf<E>;
  using Arguments = ProbeMotion<E>;
  static constexpr int rows = 0;
};
template <FrictionForce E>
struct LawTraits<E> {
  using Function = FrictionOf<E>;
  using Arguments = ProbeFriction<E>;
  static constexpr int rows = rows_read<E>;
};

}  // namespace detail

/// Forces of one type given by their law F(t, [lambda,] r, v), lambda the multipliers of a constraint.
template <class E>
  requires LawForce<E> || FrictionForce<E>
class LawBatch final : public ForceBatch {
  using Function = typename detail::LawTraits<E>::Function;
  using Arguments = typename detail::LawTraits<E>::Arguments;
  static constexpr int inputs = PointFacts<E>::inputs;
  static constexpr int width = PointFacts<E>::coordinates;
  static constexpr int rows = detail::LawTraits<E>::rows;
  static constexpr bool takes_time = detail::applicable_with_time<Function, detail::Probe<E>, Arguments>;

 public:
  /// What Scene::add asks for.
  static constexpr bool gives_what_it_should =
      detail::are_forces<detail::ForceResult<Function, takes_time, E, Arguments>, PointTuple<E>>;

  void add(E element) {
    if constexpr (rows > 0) constraints_.push_back(element.constraint().index);
    try {
      elements_.add(std::move(element));
    } catch (...) {
      if constexpr (rows > 0) constraints_.pop_back();
      throw;
    }
  }
  void replace(std::size_t i, const E& element) {
    elements_.replace(i, element);
    if constexpr (rows > 0) constraints_[i] = element.constraint().index;
  }

  [[nodiscard]] std::unique_ptr<ForceBatch> clone() const override {
    return std::make_unique<LawBatch>(*this);
  }
  [[nodiscard]] ForceShape shape() const override {
    return {detail::kind_of<E>(rows > 0 ? "Friction" : "ForceLaw"),
            width,
            rows,
            true,
            false,
            takes_time || PointFacts<E>::driven};
  }
  [[nodiscard]] std::size_t size() const override { return elements_.all().size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return elements_.coordinates(); }
  [[nodiscard]] std::span<const int> constraints() const override { return constraints_; }

  void add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const override {
    const bool by_numbers = !Branches::needed();
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const Vec<inputs> f = by_numbers ? forces<double>(e, at, own(lambda, i), detail::AsNumber{},
                                                        detail::AsNumber{}, detail::AsNumber{})
                                       : heard_forces(e, at, own(lambda, i), i);
      detail::require_finite(detail::all_finite(f), i, "is not a finite number");
      detail::scatter(e, f, elements_.coordinates(i), F);
    });
  }

  void power(const Instant& at, const Multipliers& lambda, std::span<double> out) const override {
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      out[i] =
          forces<double>(e, at, own(lambda, i), detail::AsNumber{}, detail::AsNumber{}, detail::AsNumber{})
              .dot(detail::gather_inputs(e, at.v));
    });
  }

  void force(std::size_t element, const Instant& at, std::span<const double> lambda,
             std::span<double> out) const override {
    detail::for_each_element(elements_.all(), element, element + 1, [&](const E& e, std::size_t) {
      const Vec<inputs> f =
          forces<double>(e, at, lambda, detail::AsNumber{}, detail::AsNumber{}, detail::AsNumber{});
      detail::require_finite(detail::all_finite(f), element, "is not a finite number");
      detail::pull_back(e, f.data(), out.data());
    });
  }

  void slope(const Instant& at, const Multipliers& lambda, std::span<double> out) const override {
    if constexpr (rows > 0) write_slope(at, lambda, out);
  }

  void linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                 std::span<double> damping) const override {
    using S = Dual<2 * inputs, 1>;
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const VecOf<S, inputs> f = forces<S>(e, at, own(lambda, i), detail::AsInput<S>{}, detail::AsInput<S>{},
                                           detail::AsConstant<S>{});
      detail::write_slopes<E, S>(e, i, f, stiffness, damping);
    });
  }

 private:
  void write_slope(const Instant& at, const Multipliers& lambda, std::span<double> out) const {
    using S = Dual<rows, 1>;
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const VecOf<S, inputs> f = forces<S>(e, at, own(lambda, i), detail::AsConstant<S>{},
                                           detail::AsConstant<S>{}, detail::AsInput<S>{});
      for (int r = 0; r < rows; ++r) {
        Vec<inputs> f_lambda;
        for (int k = 0; k < inputs; ++k) f_lambda[k] = f[k].gradient[r];
        detail::require_finite(detail::all_finite(f_lambda), i, "has no finite derivative");
        detail::pull_back(e, f_lambda.data(), out.data() + (i * rows + static_cast<std::size_t>(r)) * width);
      }
    });
  }

  /// With numbers that report their comparisons, of the type that `linearise` takes.
  [[nodiscard]] static Vec<inputs> heard_forces(const E& e, const Instant& at, std::span<const double> lambda,
                                                std::size_t i) {
    using S = Dual<2 * inputs, 1>;
    Vec<inputs> values;
    Branches::or_naturally<ElementFault>([&] {
      const VecOf<S, inputs> f =
          forces<S>(e, at, lambda, detail::AsConstant<S>{}, detail::AsConstant<S>{}, detail::AsConstant<S>{});
      for (int k = 0; k < inputs; ++k) values[k] = f[k].value;
      detail::require_finite(detail::all_finite(values), i, "is not a finite number");
    });
    return values;
  }

  /// The multipliers that element i reads.
  [[nodiscard]] static std::span<const double> own(const Multipliers& lambda, std::size_t i) {
    if constexpr (rows == 0) return {};
    return lambda.all.subspan(lambda.first_row[i], rows);
  }
  /// Those, as arguments of its law.
  template <class S, class Lift>
  [[nodiscard]] static auto multiplier(std::span<const double> lambda, const Lift& lift) {
    if constexpr (rows == 0) {
      return std::tuple();
    } else if constexpr (rows == 1) {
      return std::tuple<S>(lift(lambda[0], 0.0, 0));
    } else {
      VecOf<S, rows> all;
      for (int r = 0; r < rows; ++r) all[r] = lift(lambda[static_cast<std::size_t>(r)], 0.0, r);
      return std::tuple(all);
    }
  }
  /// The force of an element on each of its inputs, by the multipliers that it reads.
  template <class S, class LiftPosition, class LiftVelocity, class LiftMultiplier>
  [[nodiscard]] static VecOf<S, inputs> forces(const E& e, const Instant& at, std::span<const double> lambda,
                                               const LiftPosition& lift_r, const LiftVelocity& lift_v,
                                               const LiftMultiplier& lift) {
    const S t(at.t);
    const auto arguments = std::tuple_cat(multiplier<S>(lambda, lift), detail::positions<S>(e, t, at, lift_r),
                                          detail::velocities<S>(e, t, at, lift_v, inputs));
    return detail::forces_on_inputs<S, E>(detail::call<takes_time>(Function{e}, t, arguments));
  }

  Elements<E> elements_;
  std::vector<int> constraints_;  // whose multipliers they read
};

}  // namespace dalembert
