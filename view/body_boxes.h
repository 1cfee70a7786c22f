#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/base/hidden.h>

#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A body as a page draws it: the uniform box that has its mass and inertia, and where something acts on it.
struct BodyBox {
  std::string name;
  std::vector<int> particles;          ///< their numbers in the layout
  SketchedPoint centre;                ///< all as maps of the coordinates of its particles
  std::vector<SketchedPoint> axes;     ///< half edges, directions; those of no length are left out
  std::vector<SketchedPoint> touched;  ///< points of constraints and forces
};

/// The bodies of a scene: particles that are held together by what no user stated. The second moments of a
/// uniform box with half edges h are m h^2/3. A body in the plane has one moment of inertia, of which any
/// h_1^2 + h_2^2 = 3 I/m is a box: the one that its points reach the sides of, if there is one.
[[nodiscard]] std::vector<BodyBox> body_boxes(const Layout& layout, const FlatSample& at);

}  // namespace dalembert
