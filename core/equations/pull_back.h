#pragma once

#include <dalembert/core/equations/arguments.h>
#include <dalembert/core/equations/point_maps.h>

#include <algorithm>
#include <array>
#include <type_traits>

namespace dalembert {

namespace detail {

/// The maps of all points that have inputs.
template <class Element>
[[nodiscard]] auto point_maps(const Element& element) {
  constexpr std::size_t moving = []<class... P>(std::type_identity<std::tuple<P...>>) {
    return (std::size_t{0} + ... + (P::inputs > 0));
  }(std::type_identity<PointTuple<Element>>{});
  std::array<PointMap, moving> maps;
  auto next = maps.begin();
  for_each_moving_point(element, [&next]<class P>(const P& point) {
    static_assert(P::inputs <= PointMap::most_inputs);
    if constexpr (P::inputs == P::coordinates) {
      *next++ = {nullptr, P::inputs, P::coordinates};
    } else {
      *next++ = {point.map().data(), P::inputs, P::coordinates};
    }
  });
  return maps;
}

/// A gradient with respect to the inputs of an element, as one with respect to its coordinates.
template <class Element>
void pull_back(const Element& element, const double* gradient, double* out) {
  if constexpr (PointFacts<Element>::direct) {
    std::copy_n(gradient, PointFacts<Element>::coordinates, out);
  } else {
    pull_back_by(point_maps(element), gradient, out);
  }
}

/// A matrix of second derivatives likewise; `block` by columns, `out` by rows.
template <class Element>
void pull_back_block(const Element& element, const double* block, double* out) {
  if constexpr (PointFacts<Element>::direct) {
    constexpr int n = PointFacts<Element>::coordinates;
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) out[row * n + column] = block[column * n + row];
    }
  } else {
    pull_back_block_by(point_maps(element), block, out);
  }
}

}  // namespace detail

}  // namespace dalembert
