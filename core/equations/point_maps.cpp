#include "dalembert/core/equations/point_maps.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

namespace dalembert::detail {

namespace {

constexpr int most = PointMap::most_inputs;
using Position = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

/// Calls f with std::integral_constant<int, inputs>.
template <class F>
void with_inputs(int inputs, const F& f) {
  if (inputs == 3) return f(std::integral_constant<int, 3>{});
  if (inputs == 2) return f(std::integral_constant<int, 2>{});
  return f(std::integral_constant<int, 1>{});
}

/// Number k of L^T g.
[[nodiscard]] double pulled_back(const PointMap& map, int k, const double* g) {
  if (map.L == nullptr) return g[k];
  const double* column = map.L + k * map.inputs;
  double sum = 0.0;
  for (int r = 0; r < map.inputs; ++r) sum += column[r] * g[r];
  return sum;
}

}  // namespace

void gather_by(std::span<const PointMap> maps, const int* places, const double* x, const double* v,
               double* inputs, double* rates) {
  for (const PointMap& map : maps) {
    with_inputs(map.inputs, [&](auto D) {
      if (map.L == nullptr) {
        for (int r = 0; r < D; ++r) {
          inputs[r] = x[places[r]];
          rates[r] = v[places[r]];
        }
        return;
      }
      std::array<double, D> sum{}, rate{};
      const double* L = map.L;
      for (int k = 0; k < map.coordinates; ++k, L += D) {
        for (std::size_t r = 0; r < D; ++r) sum[r] += L[r] * x[places[k]];
        for (std::size_t r = 0; r < D; ++r) rate[r] += L[r] * v[places[k]];
      }
      std::ranges::copy(sum, inputs);
      std::ranges::copy(rate, rates);
    });
    inputs += map.inputs;
    rates += map.inputs;
    places += map.coordinates;
  }
}

void pull_back_by(std::span<const PointMap> maps, const double* gradient, double* out) {
  for (const PointMap& map : maps) {
    with_inputs(map.inputs, [&](auto D) {
      if (map.L == nullptr) {
        out = std::copy_n(gradient, D.value, out);
        return;
      }
      std::array<double, D> g;
      std::copy_n(gradient, D.value, g.begin());
      const double* L = map.L;
      for (int k = 0; k < map.coordinates; ++k, L += D) {
        double sum = L[0] * g[0];
        for (std::size_t r = 1; r < D; ++r) sum += L[r] * g[r];
        *out++ = sum;
      }
    });
    gradient += map.inputs;
  }
}

void pull_back_block_by(std::span<const PointMap> maps, const double* block, double* out) {
  int inputs = 0;
  for (const PointMap& map : maps) inputs += map.inputs;
  for (const PointMap& left : maps) {
    for (int k = 0; k < left.coordinates; ++k) {
      const double* B = block;  // at the columns of the right point
      for (const PointMap& right : maps) {
        std::array<double, most> row{};  // k of L^T B
        for (std::size_t s = 0; s < static_cast<std::size_t>(right.inputs); ++s, B += inputs) {
          row[s] = pulled_back(left, k, B);
        }
        for (int j = 0; j < right.coordinates; ++j) *out++ = pulled_back(right, j, row.data());
      }
    }
    block += left.inputs;  // its rows
  }
}

void forces_at_points(std::span<const PointMap> maps, int rows, const double* w,
                      std::span<const int> coordinates, std::span<const double> lengths, double* U) {
  int inputs = 0, width = 0;
  for (const PointMap& map : maps) {
    inputs += map.inputs;
    width += map.coordinates;
  }
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> W(w, rows, width);
  Eigen::Map<Rows> all(U, rows, inputs);
  double largest = 0.0;
  int input = 0, column = 0;
  for (const PointMap& map : maps) {
    auto own = all.middleCols(input, map.inputs);
    if (map.L == nullptr) {
      own = W.middleCols(column, map.inputs);
    } else {
      const Eigen::Map<const Eigen::MatrixXd> L(map.L, map.inputs, map.coordinates);
      const Eigen::LLT<Square> LLt(Square(L * L.transpose()));
      for (int r = 0; r < rows; ++r) {
        const Position Lw = L * W.row(r).segment(column, map.coordinates).transpose();
        own.row(r) = LLt.solve(Lw);
      }
    }
    own /= lengths[static_cast<std::size_t>(coordinates[static_cast<std::size_t>(column)])];
    largest = std::max(largest, own.norm());
    input += map.inputs;
    column += map.coordinates;
  }
  if (largest > 0.0) all *= largest / all.norm();
}

}  // namespace dalembert::detail
