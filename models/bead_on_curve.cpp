#include "dalembert/models/bead_on_curve.h"

#include <utility>

namespace dalembert::models {

Observed<2> observed(BeadOnCurve built, Counted force) {
  const double sign = force == Counted::along_gradient ? 1.0 : -1.0;
  return {std::move(built.scene), [bead = built.bead, curve = built.curve, sign](const Sample<2>& sample) {
            return Observation<2>{.positions = {sample.position(bead)},
                                  .forces = {sign * sample.multiplier(curve)}};
          }};
}

}  // namespace dalembert::models
