#include "dalembert/constraints/on_surface.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Plane<3>>>;
template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Sphere<3>>>;
template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Cylinder>>;
template struct BatchOf<ConstraintBatch, OnSurface<Particle<3>, Cone>>;

}  // namespace dalembert
