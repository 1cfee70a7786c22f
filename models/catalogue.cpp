#include "dalembert/models/catalogue.h"

#include <dalembert/models/chain.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/disk_on_incline.h>
#include <dalembert/models/disk_on_rotating_track.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/elastic_string_circle.h>
#include <dalembert/models/elastic_string_line.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/hoop_about_external_axis.h>
#include <dalembert/models/parabolic_slide.h>
#include <dalembert/models/pendulum_rotation.h>
#include <dalembert/models/pendulum_separatrix.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/models/sliding_pivot.h>
#include <dalembert/models/sliding_rod.h>

namespace dalembert::models {

std::vector<AnyModel> catalogue() {
  return {
      PlanePendulum{}.model(),  //
      PendulumSeparatrix{}.model(),
      PendulumRotation{}.model(),
      ConeSlide{}.model(),
      DoublePendulum{}.model(),
      Chain{}.model(),
      ParabolicSlide{}.model(),
      SlidingPivot{}.model(),
      SlidingRod{}.model(),
      DiskOnIncline{}.model(),
      ElasticStringLine{}.model(),
      ElasticStringCircle{}.model(),
      HoopAboutExternalAxis{}.model(),
      HoopAboutDiameter{}.model(),
      Governor{}.model(),
      DiskOnRotatingTrack{}.model(),
      DrivenPivot::horizontal().model(),
      DrivenPivot::vertical().model(),
      DrivenPivot::circular().model(),
  };
}

}  // namespace dalembert::models
