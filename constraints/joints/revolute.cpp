#include "dalembert/constraints/joints/revolute.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, Revolute<Ground<2>, RigidBody<2>>>;
template struct BatchOf<ConstraintBatch, Revolute<RigidBody<2>, RigidBody<2>>>;
template struct BatchOf<ConstraintBatch, Revolute<Ground<3>, RigidBody<3>>>;
template struct BatchOf<ConstraintBatch, Revolute<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
