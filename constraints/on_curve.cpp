#include "dalembert/constraints/on_curve.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, OnCurve<Particle<2>, Plane<2>>>;
template struct BatchOf<ConstraintBatch, OnCurve<Particle<2>, Sphere<2>>>;

}  // namespace dalembert
