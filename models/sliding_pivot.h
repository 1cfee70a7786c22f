#pragma once

#include <dalembert/models/model.h>

#include <numbers>
#include <span>
#include <vector>

namespace dalembert::models {

/// A pendulum hung from a block on a horizontal track.
struct BlockAndBob {
  Scene<2> scene;
  Particle<2> block, bob;
  Constraint<1> track;  ///< its multiplier is the force of the track on the block, positive upwards
  Constraint<1> rod;    ///< its tension is -multiplier
};

/// Pendulum hung from a block of mass M that slides along the x axis (notes, mex24, mex233), from rest.
///
/// With T the tension, phi from the downward vertical, Newton's law for the block and for the bob
/// along and across the rod is
///
///   M x'' = T sin phi,   m (x'' sin phi - L phi'^2) = m g cos phi - T,   x'' cos phi + L phi'' = -g sin phi
///
/// from which, x'' eliminated,
///
///   T = M m (L phi'^2 + g cos phi)/(M + m sin^2 phi),   L phi'' = -sin phi (g + (T/M) cos phi),
///   track force = M g + T cos phi,
///
/// and the centre of mass stays above its place:  x = mu L (sin phi0 - sin phi),  mu = m/(M + m), if the
/// block starts at x = 0. Energy conservation reads phi'^2 (1 - mu cos^2 phi) = (2g/L)(cos phi - cos phi0).
/// With sin(phi/2) = k sin u, k = sin(phi0/2) and omega^2 = (g/L)(1 + m/M) its quadrature is regular,
///
///   period = (4/omega) int_0^(pi/2) sqrt((1 + (m/M) sin^2 phi)/(1 - k^2 sin^2 u)) du
///          = (2 pi/omega)(1 + (1 + 4 m/M) phi0^2/16 + ...).
struct SlidingPivot {
  double block_mass = 2.0;  ///< M
  double bob_mass = 1.0;    ///< m
  double length = 1.0;      ///< L, of the rod
  double gravity = 9.81;
  double angle = std::numbers::pi / 2;  ///< phi0, at t = 0 [rad], between 0 and pi

  [[nodiscard]] BlockAndBob scene() const;
  [[nodiscard]] std::vector<Observation<2>> reference(std::span<const double> times) const;
  [[nodiscard]] Observation<2> reference(double t) const;
  [[nodiscard]] double period() const;
  [[nodiscard]] Model<2> model() const;
};

}  // namespace dalembert::models
