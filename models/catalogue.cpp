#include "dalembert/models/catalogue.h"

#include <dalembert/models/chain.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/pendulum_rotation.h>
#include <dalembert/models/pendulum_separatrix.h>
#include <dalembert/models/plane_pendulum.h>

namespace dalembert::models {

std::vector<AnyModel> catalogue() {
  return {
      PlanePendulum{}.model(),  //
      PendulumSeparatrix{}.model(),
      PendulumRotation{}.model(),
      ConeSlide{}.model(),
      DoublePendulum{}.model(),
      Chain{}.model(),
  };
}

}  // namespace dalembert::models
