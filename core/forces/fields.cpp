#include "dalembert/core/forces/fields.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ForceBatch, LinearDrag<Particle<2>>>;
template struct BatchOf<ForceBatch, LinearDrag<Particle<3>>>;
template struct BatchOf<ForceBatch, QuadraticDrag<Particle<2>>>;
template struct BatchOf<ForceBatch, QuadraticDrag<Particle<3>>>;
template struct BatchOf<ForceBatch, Torque>;

}  // namespace dalembert
