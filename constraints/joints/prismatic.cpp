#include "dalembert/constraints/joints/prismatic.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, Prismatic<Ground<2>, RigidBody<2>>>;
template struct BatchOf<ConstraintBatch, Prismatic<RigidBody<2>, RigidBody<2>>>;
template struct BatchOf<ConstraintBatch, Prismatic<Ground<3>, RigidBody<3>>>;
template struct BatchOf<ConstraintBatch, Prismatic<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
