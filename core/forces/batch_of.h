#pragma once

#include <dalembert/core/equations/holonomic_batch.h>
#include <dalembert/core/equations/nonholonomic_batch.h>
#include <dalembert/core/forces/law_batch.h>

namespace dalembert {

namespace detail {

/// A force whose equations need a batch of their own kind.
template <class E>
concept HasOwnBatch = requires {
  typename E::Batch;
};

template <class Element>
struct BatchFor;
template <HasOwnBatch E>
struct BatchFor<E> {
  using type = typename E::Batch;
};
template <HolonomicConstraint C>
struct BatchFor<C> {
  using type = HolonomicBatch<C>;
};
template <NonholonomicConstraint C>
struct BatchFor<C> {
  using type = NonholonomicBatch<C>;
};
template <PotentialForce E>
struct BatchFor<E> {
  using type = PotentialBatch<E>;
};
template <class E>
  requires LawForce<E> || FrictionForce<E>
struct BatchFor<E> {
  using type = LawBatch<E>;
};

template <class E>
concept AnyForce = PotentialForce<E> || LawForce<E> || FrictionForce<E> || HasOwnBatch<E>;

template <AnyForce E>
[[nodiscard]] constexpr std::string_view kind_of_force() {
  return kind_of<E>(PotentialForce<E> ? "Potential" : LawForce<E> ? "ForceLaw" : "Friction");
}

/// What Scene asks of the equation of a force.
template <AnyForce E>
constexpr void require_forces() {
  static_assert(HasOwnBatch<E> || PotentialForce<E> + LawForce<E> + FrictionForce<E> == 1,
                "a force states one of energy(r), force(r, v) and friction(lambda, r, v)");
  using Batch = typename BatchFor<E>::type;
  static_assert(!PotentialForce<E> || Batch::gives_what_it_should,
                "a potential returns its energy, one number");
  static_assert(!LawForce<E> || Batch::gives_what_it_should,
                "a force law returns one column of its point's dimension, or one for each point, "
                "std::tuple{f_a, f_b}");
  static_assert(!FrictionForce<E> || Batch::gives_what_it_should,
                "a friction law returns one column of its point's dimension, or one for each point, "
                "std::tuple{f_a, f_b}");
}

}  // namespace detail

template <class Batch, class Element>
std::unique_ptr<Batch> BatchOf<Batch, Element>::empty() {
  return std::make_unique<typename detail::BatchFor<Element>::type>();
}

template <class Batch, class Element>
bool BatchOf<Batch, Element>::add(Batch& batch, const Element& element) {
  auto* const same = dynamic_cast<typename detail::BatchFor<Element>::type*>(&batch);
  if (same == nullptr) return false;
  same->add(element);
  return true;
}

template <class Batch, class Element>
bool BatchOf<Batch, Element>::replace(Batch& batch, std::size_t i, const Element& element) {
  auto* const same = dynamic_cast<typename detail::BatchFor<Element>::type*>(&batch);
  if (same == nullptr) return false;
  same->replace(i, element);
  return true;
}

}  // namespace dalembert
