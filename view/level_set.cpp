#include "dalembert/view/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace dalembert {

namespace {

struct Corner {
  Eigen::Vector3d r;
  double value;
};

/// The function on a grid.
class Grid {
 public:
  Grid(const std::function<double(const Sketch::Place&)>& function, const Eigen::AlignedBox3d& box,
       int dimension, int cells)
      : origin_(box.min()), dimension_(dimension) {
    width_ = box.sizes().maxCoeff() / cells;
    for (int k = 0; k < dimension; ++k)
      cells_[k] = std::max(1, static_cast<int>(std::ceil(box.sizes()[k] / width_)));
    const Eigen::Array3i count = cells_ + 1;
    values_.resize(static_cast<std::size_t>(count.prod()));
    for (int z = 0; z < count[2]; ++z)
      for (int y = 0; y < count[1]; ++y)
        for (int x = 0; x < count[0]; ++x) values_[index({x, y, z})] = value(function, place({x, y, z}));
  }

  [[nodiscard]] const Eigen::Array3i& cells() const { return cells_; }
  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] Corner corner(const Eigen::Array3i& at) const { return {place(at), values_[index(at)]}; }

 private:
  [[nodiscard]] Eigen::Vector3d place(const Eigen::Array3i& at) const {
    return origin_ + width_ * at.matrix().cast<double>();
  }
  [[nodiscard]] std::size_t index(const Eigen::Array3i& at) const {
    return static_cast<std::size_t>(at[0] + (cells_[0] + 1) * (at[1] + (cells_[1] + 1) * at[2]));
  }
  [[nodiscard]] static double value(const std::function<double(const Sketch::Place&)>& function,
                                    const Eigen::Vector3d& r) {
    try {
      return function({r.x(), r.y(), r.z()});
    } catch (...) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }

  Eigen::Vector3d origin_;
  double width_ = 1.0;
  int dimension_;
  Eigen::Array3i cells_ = Eigen::Array3i::Zero();
  std::vector<double> values_;
};

Eigen::Vector3d crossing(const Corner& a, const Corner& b) {
  return a.r + (a.value / (a.value - b.value)) * (b.r - a.r);
}

void append_simplex(const std::vector<Eigen::Vector3d>& corners, int dimension, std::vector<double>& out) {
  for (const auto& r : corners) out.insert(out.end(), r.data(), r.data() + dimension);
}

/// What of the level set is in one triangle or tetrahedron.
void cut(std::vector<Corner> simplex, std::vector<double>& out) {
  const int dimension = static_cast<int>(simplex.size()) - 1;
  const auto below =
      std::partition(simplex.begin(), simplex.end(), [](const Corner& c) { return c.value < 0.0; }) -
      simplex.begin();
  const auto corner = [&](std::ptrdiff_t i) -> const Corner& { return simplex[static_cast<std::size_t>(i)]; };
  std::vector<Eigen::Vector3d> all;
  for (std::ptrdiff_t i = 0; i < below; ++i)
    for (std::ptrdiff_t k = below; k <= dimension; ++k) all.push_back(crossing(corner(i), corner(k)));
  if (all.size() == 4) {  // a quadrangle 0 1 3 2
    append_simplex({all[0], all[1], all[3]}, dimension, out);
    append_simplex({all[0], all[3], all[2]}, dimension, out);
  } else if (!all.empty()) {
    append_simplex(all, dimension, out);
  }
}

/// The simplices of one cell: from its lowest corner to the highest one, a coordinate at a time.
void cut_cell(const Grid& grid, const Eigen::Array3i& lowest, std::vector<double>& out) {
  std::array<int, 3> order{0, 1, 2};
  const auto end = order.begin() + grid.dimension();
  do {
    Eigen::Array3i at = lowest;
    std::vector<Corner> simplex{grid.corner(at)};
    for (auto axis = order.begin(); axis != end; ++axis) {
      ++at[*axis];
      simplex.push_back(grid.corner(at));
    }
    if (std::ranges::all_of(simplex, [](const Corner& c) { return std::isfinite(c.value); }))
      cut(std::move(simplex), out);
  } while (std::next_permutation(order.begin(), end));
}

}  // namespace

std::vector<double> level_set(const std::function<double(const Sketch::Place&)>& function,
                              const Eigen::AlignedBox3d& box, int dimension, int cells) {
  const Grid grid(function, box, dimension, cells);
  std::vector<double> out;
  for (int z = 0; z < std::max(1, grid.cells()[2]); ++z)
    for (int y = 0; y < grid.cells()[1]; ++y)
      for (int x = 0; x < grid.cells()[0]; ++x) cut_cell(grid, {x, y, z}, out);
  return out;
}

}  // namespace dalembert
