#include "dalembert/models/catalogue.h"

#include <dalembert/models/andrews.h>
#include <dalembert/models/bricard.h>
#include <dalembert/models/chain.h>
#include <dalembert/models/chaplygin_sleigh.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/disk_on_incline.h>
#include <dalembert/models/disk_on_rotating_track.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/elastic_string_circle.h>
#include <dalembert/models/elastic_string_line.h>
#include <dalembert/models/four_bar.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/hoop_about_external_axis.h>
#include <dalembert/models/parabolic_slide.h>
#include <dalembert/models/pendulum_rotation.h>
#include <dalembert/models/pendulum_separatrix.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/models/pursuit.h>
#include <dalembert/models/rigid_atoms.h>
#include <dalembert/models/rolling_disk.h>
#include <dalembert/models/rolling_disk_on_slope.h>
#include <dalembert/models/slider_crank.h>
#include <dalembert/models/sliding_pivot.h>
#include <dalembert/models/sliding_rod.h>
#include <dalembert/models/spinning_disk.h>

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
      RollingDisk{}.model(),
      RollingDiskOnSlope{}.model(),
      PursuitCurve{}.model(),
      RigidAtoms{}.model(),
      FourBar{}.model(),
      Andrews{}.model(),
      Bricard{}.model(),
      SliderCrank{}.model(),
      ChaplyginSleigh{}.model(),
      SpinningDisk{}.model(),
  };
}

}  // namespace dalembert::models
