#pragma once

#include <dalembert/models/hanging_rods.h>
#include <dalembert/models/minimal_ode.h>

#include <span>
#include <vector>

namespace dalembert::models {

/// Chain of N equal beads on N equal rods from a fixed point, released from horizontal at rest.
///
/// Rod i has length l = length/N and the unit vectors e_i = (sin p_i, -cos p_i) along it and t_i = (cos p_i,
/// sin p_i) across, bead i below it mass m = mass/N. With tau_i = T_i/m, Newton's law for bead i is
///
///   a_i = g + tau_(i+1) e_(i+1) - tau_i e_i,     tau_(N+1) = 0,
///
/// and rod i turns by  a_i - a_(i-1) = l (p_i'' t_i - p_i'^2 e_i),  a_0 = 0. Along e_i this is a symmetric
/// tridiagonal system for the tensions, with c_i = e_i . e_(i+1) and s_i = t_i . e_(i+1) = -t_(i+1) . e_i,
///
///   -c_(i-1) tau_(i-1) + 2 tau_i - c_i tau_(i+1) = l p_i'^2       (first row: tau_1 - c_1 tau_2 = l p_1'^2 +
///   g . e_1)
///
/// and along t_i the equation of motion
///
///   l p_i'' = s_i tau_(i+1) - s_(i-1) tau_(i-1)                    (first row: + g . t_1).
///
/// O(N) work per evaluation, and in the angles the rods keep their lengths exactly. Its fastest
/// vibrations have a frequency near 2 N sqrt(g/length), so the work for a reference grows like N^2:
/// about 0.05 s for 10 beads over 1 s of motion, 3 s for 100; a looser `tolerance` costs less.
struct Chain {
  int beads = 10;       ///< N >= 1
  double length = 1.0;  ///< of all rods together [length]
  double mass = 1.0;    ///< of all beads together [mass]
  double gravity = 9.81;

  [[nodiscard]] HangingRods scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times,
                                                      Real tolerance = reference_tolerance) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
