#pragma once

#include <dalembert/models/event_model.h>

#include <vector>

namespace dalembert::models {

/// N equal balls in a row, each on a thread so long that it is a spring to its own place, m g/l: all swing at
/// omega^2 = g/l. The first is let go at -A, and the others are in their places.
///
/// In contact: all balls that are in their places are there again after pi/omega, whatever their speeds, and
/// so all impacts happen there, at (k + 1/2) pi/omega, k from 0. The first balls' contact has an impact, and
/// impulses P >= 0 of the others keep them closed, U+ = 0, as nothing separates them (Moreau's law): the
/// others go on as one of mass N - 1. At the first impact, with V = omega A,
///
///   v_1 = (1 - (N - 1) e) V/N,   v_2 = ... = v_N = (1 + e) V/N;                                          (1)
///
/// their difference is -e V from V and momentum is kept. That holds each time, so that with e = 1 the second
/// impact undoes the first: the first ball takes all, and the motion has the period 2 pi/omega.
///
/// Where balls touch and nothing presses them together their forces are 0, and which of them are closed is
/// decided by round-off. So the threads of the balls behind the first are nearer to each other than the
/// balls, by a part p of a diameter d each, about the same middle. That presses these together, the j-th of
/// the N - 1 on the next with
///
///   F_j = m omega^2 p d j (N - 1 - j)/2,                                                                 (4)
///
/// as long as they move together, and changes nothing else: their middle swings as before.
///
/// With gaps delta they collide one after the other, elastically as in textbooks: two equal balls exchange
/// their velocities. The first hits the second at delta, where it stops, and that goes off at V_1;
/// it hits the third at delta, and so on, V_k being the speed that the k-th impact passes on:
///
///   t_1 = (pi/2 + asin(delta/A))/omega,   V_k^2 = omega^2 (A^2 - k delta^2),
///   t_(k+1) - t_k = asin(omega delta/V_k)/omega,   k = 1 ... N - 2. (2)
///
/// The last one is off for half a period and a little: with B = V_(N-1)/omega and s = omega (t_N - t_(N-1))
/// it is at B sin s and its neighbour at delta cos s, which are delta apart at tan(s/2) = -B/delta,
///
///   s = 2 (pi - atan(B/delta)).                                                                          (3)
struct NewtonsCradle {
  int balls = 5;  ///< N >= 2
  double mass = 0.5;
  double diameter = 0.05;
  double thread = 0.8;  ///< l
  double gravity = 9.81;
  double amplitude = 0.2;    ///< A
  double gap = 0.0;          ///< delta
  double press = 0.02;       ///< p; with a gap there is none
  double restitution = 1.0;  ///< e; with a gap 1

  struct Built {
    Scene<2> scene;
    std::vector<Particle<2>> balls;
    std::vector<Constraint<1>> contacts;  ///< of each ball with the next
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double frequency() const;  ///< omega
  /// F_j, j from 1 to N - 2.
  [[nodiscard]] double pressing_force(int j) const;
  /// Of balls in touch all, k from 0; of balls with gaps the N of (2) and (3).
  [[nodiscard]] double impact_time(int k) const;
  /// In touch: four impacts. With gaps: N, until the last ball is back.
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
