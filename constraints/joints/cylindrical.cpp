#include "dalembert/constraints/joints/cylindrical.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, Cylindrical<Ground<3>, RigidBody<3>>>;
template struct BatchOf<ConstraintBatch, Cylindrical<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
