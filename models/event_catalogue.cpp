#include <dalembert/models/bead_on_rough_hoop.h>
#include <dalembert/models/block_on_belt.h>
#include <dalembert/models/bouncing_ball.h>
#include <dalembert/models/bouncing_pendulum.h>
#include <dalembert/models/event_model.h>
#include <dalembert/models/newtons_cradle.h>
#include <dalembert/models/particle_off_sphere.h>
#include <dalembert/models/puck_on_rough_table.h>
#include <dalembert/models/rocking_block.h>
#include <dalembert/models/slack_string.h>
#include <dalembert/models/sliding_ladder.h>

namespace dalembert::models {

std::vector<EventModel> models_with_events() {
  return {
      ParticleOffSphere{}.event_model(),
      SlackString{}.event_model(),
      SlidingLadder{}.event_model(),
      BouncingBall{.restitution = 0.3}.event_model(),
      BouncingBall{.restitution = 0.5}.event_model(),
      BouncingBall{.restitution = 0.8}.event_model(),
      BouncingBall{.restitution = 1.0}.event_model(),
      BouncingPendulum{}.event_model(),
      BouncingPendulum{.wall = -0.2, .restitution = 1.0}.event_model(),
      RockingBlock{}.event_model(),
      RockingBlock{.floor = RockingBlock::Floor::smooth}.event_model(),
      NewtonsCradle{}.event_model(),
      NewtonsCradle{.gap = 0.002}.event_model(),
      BlockOnBelt{}.event_model(),
      BeadOnRoughHoop{}.event_model(),
      PuckOnRoughTable{}.event_model(),
  };
}

}  // namespace dalembert::models
