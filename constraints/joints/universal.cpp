#include "dalembert/constraints/joints/universal.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, Universal<Ground<3>, RigidBody<3>>>;
template struct BatchOf<ConstraintBatch, Universal<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
