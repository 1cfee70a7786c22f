#pragma once

#include <dalembert/models/model.h>

#include <array>
#include <span>
#include <vector>

namespace dalembert::models {

/// A scene of five rods in a ring with the ground.
struct BricardScene {
  Scene<3> scene;
  std::array<ThinRod<3>, 5> rods;
};

/// Bricard's mechanism (IFToMM benchmark A04): five thin uniform rods of length 1, six revolute
/// joints. By the count of equations it could not move, and one of them is redundant, so that it
/// has one degree of freedom.
///
/// Joints P_1 = (0,0,0) with axis w_1 = y and P_6 = (0,0,1) with axis w_6 = x on the ground; rod i is
/// r_i = P_(i+1) - P_i. At both its ends an axis is at right angles to the rod, and these two are at
/// right angles to each other. So from either end of the ring
///
///   w_2 = r_1 x w_1,  w_3 = r_2 x w_2     and     w_5 = r_5 x w_6,  w_4 = r_4 x w_5
///
/// (up to sign, in units of the rods), and the joints are, besides the pins at P_1 ... P_6,
///
///   r_1 . w_1 = 0,  r_2 . w_2 = 0,  r_3 . w_3 = 0,  w_3 . w_4 = 0,  r_3 . w_4 = 0,  r_4 . w_5 = 0,  r_5 .
///   w_6 = 0.
///
/// The rods being thin, they need no attitude about their own axes.
///
/// With a the turn of rod 1 about y and s = sin a, the positions solve these equations:
///
///   P_2 = (cos a, 0, -s),          P_3 = (cos a, -sqrt(1+2s), -s)/(1+s),
///   P_4 = (cos a, -sqrt(1+2s), 1-s),   P_5 = (0, -sqrt(1+2s), 1)/(1+s).
///
/// A thin rod between two points has the kinetic energy m/6 (v^2 + v . v~ + v~^2), so with P' = dP/da
///
///   M(a) a'' + C(a) a'^2 = -dV/da,
///   M = m/3 sum of (P'^2 + P' . P~' + P~'^2),   C = m/6 sum of (2 P' . P'' + P' . P~'' + P'' . P~' + 2 P~' .
///   P~'')
///
/// over the rods, and Newton's law for the whole gives what the ground carries in all,
///
///   force of the ground = m sum of (P'' + P~'')/2 a'^2 + (P' + P~')/2 a'' - m g per rod.
///
/// It starts at rest with a = 0, where a'' = g/5, and swings to a = pi and back.
struct Bricard {
  double mass = 1.0;  ///< of each rod
  double gravity = 9.81;

  [[nodiscard]] BricardScene scene() const;
  [[nodiscard]] std::vector<Observation<3>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<3> reference(double t) const;
  [[nodiscard]] Model<3> model() const;
};

}  // namespace dalembert::models
