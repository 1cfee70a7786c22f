#include "dalembert/core/forces/forces.h"

#include <dalembert/core/forces/batch_of.h>

namespace dalembert {

template struct BatchOf<ForceBatch, Spring<Fixed<2>, Particle<2>>>;
template struct BatchOf<ForceBatch, Spring<Particle<2>, Particle<2>>>;
template struct BatchOf<ForceBatch, Spring<Fixed<3>, Particle<3>>>;
template struct BatchOf<ForceBatch, Spring<Particle<3>, Particle<3>>>;
template struct BatchOf<ForceBatch, Damper<Fixed<2>, Particle<2>>>;
template struct BatchOf<ForceBatch, Damper<Particle<2>, Particle<2>>>;
template struct BatchOf<ForceBatch, Damper<Fixed<3>, Particle<3>>>;
template struct BatchOf<ForceBatch, Damper<Particle<3>, Particle<3>>>;

}  // namespace dalembert
