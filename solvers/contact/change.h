#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What changes in a run at an instant, and the state and the equations with which it goes on.
struct Change {
  std::vector<double> v_before{}, v{};  ///< the velocities before and after it
  std::vector<double> impulses{};       ///< that lead from the ones to the others, one per row of the system
  std::vector<EventRecord> events{};    ///< what is listed, with the numbers of constraints in the layout
  std::vector<double> q{};              ///< the positions, which an event of the user's may set
  std::shared_ptr<const System> system{};  ///< with the constraints that are in force from there on
};

/// The impulses of joints that a change imposes: the velocities before them; and to what these are right, a
/// part of the top speed so far of what is coupled to them.
struct Joining {
  std::span<const double> v;
  double known;
};

}  // namespace dalembert
