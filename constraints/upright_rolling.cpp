#include "dalembert/constraints/upright_rolling.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, UprightRolling<Particle<2>>>;

}  // namespace dalembert
