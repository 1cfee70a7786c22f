#include "dalembert/constraints/joints/weld.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, Weld<Ground<3>, RigidBody<3>>>;
template struct BatchOf<ConstraintBatch, Weld<RigidBody<3>, RigidBody<3>>>;

}  // namespace dalembert
