#include "dalembert/models/disk_on_track.h"

#include <utility>

namespace dalembert::models {

Observed<2> observed(DiskOnTrack built) {
  return {std::move(built.scene),
          [centre = built.centre, contact = built.contact, grip = built.grip](const Sample<2>& sample) {
            return Observation<2>{.positions = {sample.position(centre)},
                                  .forces = {sample.multiplier(grip), sample.multiplier(contact)}};
          }};
}

}  // namespace dalembert::models
