#include "dalembert/constraints/distance.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, Distance<Fixed<2>, Particle<2>>>;
template struct BatchOf<ConstraintBatch, Distance<Particle<2>, Fixed<2>>>;
template struct BatchOf<ConstraintBatch, Distance<Particle<2>, Particle<2>>>;
template struct BatchOf<ConstraintBatch, Distance<Fixed<3>, Particle<3>>>;
template struct BatchOf<ConstraintBatch, Distance<Particle<3>, Fixed<3>>>;
template struct BatchOf<ConstraintBatch, Distance<Particle<3>, Particle<3>>>;

}  // namespace dalembert
