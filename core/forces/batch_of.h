#pragma once

#include <dalembert/core/equations/constraint_type.h>
#include <dalembert/core/forces/law_batch.h>
#include <dalembert/core/forces/potential_type.h>

namespace dalembert {

namespace detail {

/// A force whose equations need a batch of their own kind.
template <class E>
concept HasOwnBatch = requires {
  typename E::Batch;
};

/// The batch of a type of element, which takes the address of one.
template <class Element>
struct BatchFor;
template <HasOwnBatch E>
struct BatchFor<E> {
  using type = typename E::Batch;
  [[nodiscard]] static std::unique_ptr<type> empty() { return std::make_unique<type>(); }
};
template <AnyConstraint C>
struct BatchFor<C> {
  using type = ConstraintBatch;
  [[nodiscard]] static std::unique_ptr<type> empty() { return std::make_unique<type>(constraint_type<C>); }
};
template <PotentialForce E>
struct BatchFor<E> {
  using type = PotentialBatch;
  [[nodiscard]] static std::unique_ptr<type> empty() { return std::make_unique<type>(potential_type<E>); }
};
template <class E>
  requires LawForce<E> || FrictionForce<E>
struct BatchFor<E> {
  using type = LawBatch;
  [[nodiscard]] static std::unique_ptr<type> empty() { return std::make_unique<type>(law_type<E>); }
};

/// The batch as one of that kind, if it is one and holds elements of that type.
template <class Element, class Batch>
[[nodiscard]] auto* batch_for(Batch& batch) {
  using Own = typename BatchFor<Element>::type;
  Own* own;
  if constexpr (std::is_same_v<Own, Batch>) {
    own = &batch;
  } else {
    own = dynamic_cast<Own*>(&batch);
  }
  return own != nullptr && own->holds(typeid(Element)) ? own : nullptr;
}

template <class E>
concept AnyForce = PotentialForce<E> || LawForce<E> || FrictionForce<E> || HasOwnBatch<E>;

/// What Scene asks of the equation of a force.
template <AnyForce E>
constexpr void require_forces() {
  static_assert(HasOwnBatch<E> || PotentialForce<E> + LawForce<E> + FrictionForce<E> == 1,
                "a force states one of energy(r), force(r, v) and friction(lambda, r, v)");
  if constexpr (PotentialForce<E>) {
    static_assert(Number<EnergyResult<E>>,
                  "a potential returns its energy, one number; of an Eigen expression its .value()");
  } else if constexpr (LawForce<E>) {
    static_assert(are_forces<LawResult<E>, PointTuple<E>>,
                  "a force law returns one column of its point's dimension, or one for each point, "
                  "std::tuple{f_a, f_b}; of an Eigen expression its .eval()");
  } else if constexpr (FrictionForce<E>) {
    static_assert(are_forces<LawResult<E>, PointTuple<E>>,
                  "a friction law returns one column of its point's dimension, or one for each point, "
                  "std::tuple{f_a, f_b}; of an Eigen expression its .eval()");
  }
}

template <Point P>
void tell_point(const P& point, Admission& to) {
  using Place = Vec<P::dimension>;
  if constexpr (OfParticles<P>) {
    for (const auto& particle : point.particles) to.moves(particle);
  } else if constexpr (P::coordinates > 0) {
    to.moves(point);
  } else if constexpr (P::driven) {
    to.follows(std::function<Place(double)>(
        [path = point.path](double t) { return Place(path(t).template cast<double>()); }));
  } else {
    to.stands(Place(point.position));
  }
}

template <class Element>
void tell(const void* element, Admission& to) {
  const auto& its = *static_cast<const Element*>(element);
  if constexpr (requires { its.fault(); }) to.fault(its.fault());
  if constexpr (HasCompliance<Element>) to.compliance(its.compliance);
  if constexpr (ReadsMultiplier<Element>) {
    const auto read = its.constraint();
    to.reads(read.index, read.scene, rows_read<Element>);
  }
  std::apply([&to](const auto&... point) { (tell_point(point, to), ...); }, its.points());
}

template <class Batch, class Element>
[[nodiscard]] constexpr ElementTable<Batch> make_element_table() {
  ElementTable<Batch> its{
      .kind = {},
      .meaning = {},
      .tell = &tell<Element>,
      .condition = nullptr,
      .drawing = [](const void* element) { return drawing_of(*static_cast<const Element*>(element)); },
      .empty = []() -> std::unique_ptr<Batch> { return BatchFor<Element>::empty(); },
      .add =
          [](Batch& batch, const void* element) {
            auto* const same = batch_for<Element>(batch);
            if (same != nullptr) same->add(element);
            return same != nullptr;
          },
      .replace =
          [](Batch& batch, std::size_t i, const void* element) {
            auto* const same = batch_for<Element>(batch);
            if (same != nullptr) same->replace(i, element);
            return same != nullptr;
          }};
  if constexpr (AnyConstraint<Element>) {
    its.kind = constraint_type<Element>.kind;
    its.meaning = meaning_of<Element>();
    its.condition = [](const void* element) { return condition_of(*static_cast<const Element*>(element)); };
  } else {
    its.kind = kind_of<Element>(PotentialForce<Element> ? "Potential"
                                : LawForce<Element>     ? "ForceLaw"
                                                        : "Friction");
  }
  return its;
}

}  // namespace detail

template <class Batch, class Element>
const detail::ElementTable<Batch>& BatchOf<Batch, Element>::table() {
  static constexpr auto its = detail::make_element_table<Batch, Element>();
  return its;
}

}  // namespace dalembert
