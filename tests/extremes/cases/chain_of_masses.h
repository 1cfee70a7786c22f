#pragma once

#include <dalembert/models/hanging_rods.h>

#include <vector>

namespace dalembert::extremes {

/// A chain as in models/chain.h whose beads differ in mass: with a_i = g + (T_(i+1) e_(i+1) - T_i e_i)/m_i
/// the rods' equations are, along e_i,
///
///   -(c_(i-1)/m_(i-1)) T_(i-1) + (1/m_(i-1) + 1/m_i) T_i - (c_i/m_i) T_(i+1) = l p_i'^2
///
/// (first row: without m_0, + g . e_1), and along t_i
///
///   l p_i'' = s_i T_(i+1)/m_i - s_(i-1) T_(i-1)/m_(i-1)       (first row: + g . t_1).
struct ChainOfMasses {
  std::vector<double> masses;  ///< from the pivot outwards
  double link;                 ///< l [length]
  double angle = 1.0;          ///< of all rods at t = 0, at rest [rad]

  /// This many links on 1 m, beads of 1 kg, the last of `ratio`.
  [[nodiscard]] static ChainOfMasses heavy_at_the_end(int links, double ratio);
  [[nodiscard]] models::Model<2> model() const;
};

}  // namespace dalembert::extremes
