#pragma once

#include <dalembert/bench/rival.h>
#include <dalembert/models/chain.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/plane_pendulum.h>

namespace dalembert::bench {

/// What else integrates a system: its equation of motion derived by hand, and the peers of this build.
[[nodiscard]] Rivals<2> rivals(const models::PlanePendulum& pendulum);
[[nodiscard]] Rivals<2> rivals(const models::DoublePendulum& pendulum);
[[nodiscard]] Rivals<2> rivals(const models::Chain& chain);
[[nodiscard]] Rivals<3> rivals(const models::ConeSlide& cone);

/// The rivals of a model of the catalogue, known by its name; most have none.
[[nodiscard]] Rivals<2> rivals(const models::Model<2>& model);
[[nodiscard]] Rivals<3> rivals(const models::Model<3>& model);

}  // namespace dalembert::bench
