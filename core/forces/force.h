#pragma once

#include <dalembert/core/equations/constraint.h>

namespace dalembert {

namespace detail {

/// Makes `energy` or `force` of an element callable like a function, without hiding its arity.
template <class E>
struct EnergyOf {
  const E& element;
  auto operator()(const auto&... a) const requires requires { element.energy(a...); }
  { return element.energy(a...); }
};
template <class E>
struct ForceOf {
  const E& element;
  auto operator()(const auto&... a) const requires requires { element.force(a...); }
  { return element.force(a...); }
};

/// The force on point I out of what a force law returned: a vector for one point, a tuple or array
/// of vectors for several.
template <std::size_t I, class T>
[[nodiscard]] const auto& force_on(const T& forces) {
  if constexpr (is_vector<T>) {
    return forces;
  } else {
    return std::get<I>(forces);
  }
}

template <std::size_t I, class S, class E, class Law>
void collect_force_on(const Law& law, VecOf<S, PointFacts<E>::inputs>& all) {
  using P = std::tuple_element_t<I, PointTuple<E>>;
  if constexpr (P::inputs > 0) {
    const auto own = force_on<I>(law).template cast<S>();
    for (int k = 0; k < P::inputs; ++k) all[PointFacts<E>::first_input[I] + k] = own[k];
  }
}

/// What a force law returned, as the force on each input of the element.
template <class S, class E, class Law>
[[nodiscard]] VecOf<S, PointFacts<E>::inputs> forces_on_inputs(const Law& law) {
  VecOf<S, PointFacts<E>::inputs> all;
  const auto collect = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (collect_force_on<I, S, E>(law, all), ...);
  };
  collect(std::make_index_sequence<PointFacts<E>::count>{});
  return all;
}

/// What the equation of a force returns.
template <class Function, bool takes_time, class E, class Arguments>
using ForceResult = std::remove_cvref_t<decltype(call<takes_time>(
    std::declval<const Function&>(), std::declval<const Probe<E>&>(), std::declval<const Arguments&>()))>;

/// Adds the force of an element, given on its inputs, to F at its coordinates.
template <class E>
void scatter(const E& element, const Vec<PointFacts<E>::inputs>& f, std::span<const int> places,
             std::span<double> F) {
  std::array<double, static_cast<std::size_t>(PointFacts<E>::coordinates)> own;
  detail::pull_back(element, f.data(), own.data());
  for (std::size_t k = 0; k < own.size(); ++k) F[static_cast<std::size_t>(places[k])] += own[k];
}

/// Writes dF/dq and dF/dv of one element, given its forces as functions of r and v.
template <class E, class S>
void write_slopes(const E& element, std::size_t i, const VecOf<S, PointFacts<E>::inputs>& f,
                  std::span<double> stiffness, std::span<double> damping) {
  constexpr int n = PointFacts<E>::inputs, width = PointFacts<E>::coordinates;
  std::array<double, n * n> F_r, F_v;
  for (int row = 0; row < n; ++row) {
    detail::require_finite(isfinite(f[row]), i, "has no finite derivative");
    for (int column = 0; column < n; ++column) {
      const auto at = static_cast<std::size_t>(column * n + row);
      F_r[at] = f[row].gradient[column];
      F_v[at] = f[row].gradient[n + column];
    }
  }
  detail::pull_back_block(element, F_r.data(), stiffness.data() + i * width * width);
  detail::pull_back_block(element, F_v.data(), damping.data() + i * width * width);
}

}  // namespace detail

/// A force with a potential: `points()` and `energy([t,] r_1, ..., r_k)`, for any scalar type.
/// Force and stiffness follow: F_i = -dV/dr_i.
template <class E>
concept PotentialForce = ActsOnPoints<E> &&
    (detail::applicable<detail::EnergyOf<E>, detail::ProbePositions<E>> ||
     detail::applicable_with_time<detail::EnergyOf<E>, detail::Probe<E>, detail::ProbePositions<E>>);

/// A force given by its law: `points()` and `force([t,] r_1, ..., r_k, v_1, ..., v_k)`, which
/// returns the force on each point: a vector for a single point, else a std::tuple of vectors.
template <class E>
concept LawForce = ActsOnPoints<E> &&
    (detail::applicable<detail::ForceOf<E>, detail::ProbeMotion<E>> ||
     detail::applicable_with_time<detail::ForceOf<E>, detail::Probe<E>, detail::ProbeMotion<E>>);

/// Forces of one type that have a potential: F = -V_r, dF/dq = -V_rr.
template <PotentialForce E>
class PotentialBatch final : public ForceBatch {
  static constexpr int inputs = PointFacts<E>::inputs;
  static constexpr int width = PointFacts<E>::coordinates;
  static constexpr bool takes_time =
      detail::applicable_with_time<detail::EnergyOf<E>, detail::Probe<E>, detail::ProbePositions<E>>;

 public:
  /// What Scene::add asks for.
  static constexpr bool gives_what_it_should =
      detail::Number<detail::ForceResult<detail::EnergyOf<E>, takes_time, E, detail::ProbePositions<E>>>;

  void add(E element) { elements_.add(std::move(element)); }
  void replace(std::size_t i, const E& element) { elements_.replace(i, element); }

  [[nodiscard]] std::unique_ptr<ForceBatch> clone() const override {
    return std::make_unique<PotentialBatch>(*this);
  }
  [[nodiscard]] ForceShape shape() const override {
    return {detail::kind_of<E>("Potential"), width, 0, false, true, takes_time || PointFacts<E>::driven};
  }
  [[nodiscard]] std::size_t size() const override { return elements_.all().size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return elements_.coordinates(); }

  void add_force(const Instant& at, const Multipliers& /*lambda*/, std::span<double> F) const override {
    using S = Dual<inputs, 1>;
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const S V = potential<S>(e, at, detail::AsInput<S>{});
      detail::require_finite(isfinite(V), i, "is not a finite number or has no finite gradient");
      detail::scatter(e, Vec<inputs>(-V.gradient), elements_.coordinates(i), F);
    });
  }

  void power(const Instant& at, const Multipliers& /*lambda*/, std::span<double> out) const override {
    using S = Dual<inputs, 1>;
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      out[i] = -Vec<inputs>(potential<S>(e, at, detail::AsInput<S>{}).gradient)
                    .dot(detail::gather_inputs(e, at.v));
    });
  }

  void linearise(const Instant& at, const Multipliers& /*lambda*/, std::span<double> stiffness,
                 std::span<double> /*damping*/) const override {
    using S = Dual<inputs, 2>;
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t i) {
      const S V = potential<S>(e, at, detail::AsInput<S>{});
      detail::require_finite(detail::all_finite(V.hessian), i, "has no finite second derivative");
      const decltype(V.hessian) F_r = -V.hessian;
      detail::pull_back_block(e, F_r.data(), stiffness.data() + i * width * width);
    });
  }

  void force(std::size_t element, const Instant& at, std::span<const double> /*lambda*/,
             std::span<double> out) const override {
    using S = Dual<inputs, 1>;
    detail::for_each_element(elements_.all(), element, element + 1, [&](const E& e, std::size_t) {
      const S V = potential<S>(e, at, detail::AsInput<S>{});
      detail::require_finite(isfinite(V), element, "is not a finite number or has no finite gradient");
      const Vec<inputs> f = -V.gradient;
      detail::pull_back(e, f.data(), out.data());
    });
  }

  [[nodiscard]] double energy(const Instant& at) const override {
    double sum = 0.0;
    detail::for_each_element(elements_.all(), [&](const E& e, std::size_t) {
      sum += potential<double>(e, at, detail::AsNumber{});
    });
    return sum;
  }

 private:
  template <class S, class Lift>
  [[nodiscard]] static S potential(const E& e, const Instant& at, const Lift& lift) {
    const S t(at.t);
    return S(detail::call<takes_time>(detail::EnergyOf<E>{e}, t, detail::positions<S>(e, t, at, lift)));
  }

  Elements<E> elements_;
};

}  // namespace dalembert
