#pragma once

#include <dalembert/core/equations/holonomic_batch.h>
#include <dalembert/core/equations/nonholonomic_batch.h>
#include <dalembert/core/forces/friction_batch.h>

namespace dalembert {

namespace detail {

template <class Element>
struct BatchFor;
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
template <LawForce E>
struct BatchFor<E> {
  using type = LawBatch<E>;
};
template <FrictionForce E>
struct BatchFor<E> {
  using type = FrictionBatch<E>;
};

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

}  // namespace dalembert
