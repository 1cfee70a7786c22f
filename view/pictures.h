#pragma once

#include <dalembert/view/json.h>
#include <dalembert/view/quantities.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Of a point in a picture D numbers out of an instant.
[[nodiscard]] Sketch::Place place_at(const SketchedPoint& point, const FlatSample& at, int dimension);

/// What a page draws of constraints and forces: their sketches, and columns of what in them moves by itself.
class Pictures {
 public:
  using Numbers = std::vector<std::size_t>;
  /// Columns of what a picture needs besides the coordinates.
  struct Drawn {
    const Drawing* drawing = nullptr;
    std::vector<Numbers> paths{};  ///< of each driven point
    Numbers pose{};                ///< of what is carried: three rows of four
    std::vector<double> level_set{};
  };

  Pictures(const Layout& layout, Quantities& all) : layout_(&layout), all_(&all) {}

  [[nodiscard]] Drawn drawn(const Drawing& drawing);
  void write(Json& json, const Drawn& its) const;
  void write_point(Json& json, const SketchedPoint& point, const Numbers& path) const;

 private:
  [[nodiscard]] const Eigen::AlignedBox3d& box();

  const Layout* layout_;
  Quantities* all_;
  Eigen::AlignedBox3d box_;
};

/// The column of an error, if there is one.
inline void write_error(Json& json, const std::optional<std::size_t>& error,
                        std::string_view name = "error") {
  if (error) json.member(name, *error);
}

}  // namespace dalembert
