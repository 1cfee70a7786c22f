#include "dalembert/constraints/coincident.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, Coincident<Particle<2>, Particle<2>>>;
template struct BatchOf<ConstraintBatch, Coincident<Particle<3>, Particle<3>>>;

}  // namespace dalembert
