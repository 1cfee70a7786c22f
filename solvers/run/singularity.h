#pragma once

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/hidden.h>

#include <limits>

namespace DALEMBERT_HIDDEN dalembert {

/// How close the constraints are to linearly dependent at a time: see Manifold::sine.
struct Angle {
  double t;
  double sine;
};

/// The time after `now` at which an angle that goes on falling as it has since `before` vanishes; infinite if
/// it does not fall. Close to an isolated singular position the sine is proportional to the time left.
[[nodiscard]] inline double time_to_singular(const Angle& before, const Angle& now) {
  const bool falls = now.sine < constants.close_to_dependent && now.sine < before.sine && now.t > before.t;
  return falls ? (now.t - before.t) * now.sine / (before.sine - now.sine)
               : std::numeric_limits<double>::infinity();
}

}  // namespace dalembert
