#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/models/chain.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/plane_pendulum.h>

namespace dalembert::bench {

/// What else integrates a system: its equation of motion derived by hand, and the peers of this build.
[[nodiscard]] Methods<2> methods(const models::PlanePendulum& pendulum);
[[nodiscard]] Methods<2> methods(const models::DoublePendulum& pendulum);
[[nodiscard]] Methods<2> methods(const models::Chain& chain);
[[nodiscard]] Methods<3> methods(const models::ConeSlide& cone);

/// The methods of a model of the catalogue, known by its name; most have none.
[[nodiscard]] Methods<2> methods(const models::Model<2>& model);
[[nodiscard]] Methods<3> methods(const models::Model<3>& model);

}  // namespace dalembert::bench
