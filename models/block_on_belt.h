#pragma once

#include <dalembert/models/event_model.h>

namespace dalembert::models {

/// A block on a belt that moves at V, held by a spring: it sticks and slips.
///
/// With N = m g, omega^2 = k/m, x from where the spring is relaxed, and the friction sigma on the block:
///
///   sticks:  x' = V,   sigma = k x                      until k x = mu_static N, that is x = X + d,
///   slips:   x' < V,   x'' = -omega^2 (x - X),          X = mu N/k,  d = (mu_static - mu) N/k:
///            x' = V cos(omega t) - omega d sin(omega t) is V again after
///
///   T_slip = (2/omega) (pi - atan(omega d/V)),                                                       (1)
///
/// at x = X - d, as the harmonic motion is symmetric to X. The spring pulls by (2 mu - mu_static) N there,
/// less than mu_static N either way: it sticks, and is carried to X + d in
///
///   T_stick = 2 d/V,   and so on with the period T = T_slip + T_stick.                               (2)
///
/// At first it is let go at rest at x = 0, and slips: x = X (1 - cos(omega t)), x' = X omega sin(omega t) = V
/// at
///
///   t_0 = asin(V/(X omega))/omega,   V < X omega,                                                    (3)
///
/// and goes first (X + d - x(t_0))/V later. The belt's work over a period is the heat, that of friction on
/// the block none; slower than the belt by u it takes mu N u, so mu N (V T_slip + 2 d) in all.
struct BlockOnBelt {
  double mass = 2.0;
  double stiffness = 50.0;  ///< k
  double belt = 0.2;        ///< V, below X omega
  double friction = 0.3;    ///< mu
  double sticking = 0.5;    ///< mu_static > mu
  double gravity = 9.81;

  struct Built {
    Scene<2> scene;
    Particle<2> block;
    Constraint<1> belt, rough;
    Force spring;
  };
  [[nodiscard]] Built scene() const;
  [[nodiscard]] double weight() const { return mass * gravity; }                                ///< N
  [[nodiscard]] double balance() const { return friction * weight() / stiffness; }              ///< X
  [[nodiscard]] double excess() const { return (sticking - friction) * weight() / stiffness; }  ///< d
  [[nodiscard]] double frequency() const;                                                       ///< omega
  [[nodiscard]] double slip_time() const;                                                       ///< (1)
  [[nodiscard]] double period() const;                                                          ///< T
  /// When it begins to stick, and to slip from there, for the k-th time, k from 0.
  [[nodiscard]] double sticking_time(int k = 0) const;
  [[nodiscard]] double slipping_time(int k = 0) const;
  [[nodiscard]] double heat_of_period() const;
  /// Five periods.
  [[nodiscard]] EventModel event_model() const;
};

}  // namespace dalembert::models
