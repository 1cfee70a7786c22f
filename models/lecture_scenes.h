#pragma once

#include <dalembert/dalembert.h>

#include <variant>
#include <vector>

namespace dalembert::models {

/// A scene of the lecture that is shown there. Its page derives what no run of it is compared with: a count
/// of degrees of freedom, steady states, equal Lagrangians.
struct LectureScene {
  std::variant<Scene<2>, Scene<3>> scene;
  double t_end;  ///< of the run that is shown [time]
};

[[nodiscard]] std::vector<LectureScene> lecture_scenes();

}  // namespace dalembert::models
