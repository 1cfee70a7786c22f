#pragma once

#include <dalembert/models/event_model.h>
#include <dalembert/models/rounded_edge.h>

#include <vector>

namespace dalembert::models {

/// A chain of beads and rods on a guide.
struct GuidedChain {
  Scene<2> scene;
  std::vector<Particle<2>> beads;     ///< from the hanging end to the one on the table
  std::vector<Constraint<1>> guides;  ///< what holds each of them
  std::vector<Constraint<1>> rods;    ///< between each two
  std::vector<Force> friction{};      ///< on each of them, if the table is rough
};

/// Uniform chain of length A on a table, of which B hangs over the edge, from rest (notes, mex148; mex149
/// with kinetic friction on the table). It follows the edge, as the notes' does.
///
/// The continuum. With h hanging, h pulls and the rest is braked: the tension tau at the edge is that of
/// either part,
///
///   rho h (g - h'') = tau = rho (A - h)(h'' + mu g),   so   A h'' = g ((1 + mu) h - mu A),      (1)
///   tau = (1 + mu) rho g h (A - h)/A,                                                           (2)
///   T = sqrt(A/(g (1 + mu))) acosh(A/c),   c = B (1 + mu) - mu A                                (3)
///
/// until h = A; it does not start if c <= 0. The edge turns the chain: it exerts tau - rho v^2 towards the
/// table, and has to pull from 2 h^2 - (A + 2 b) h + 2 b B - B^2 = 0 on, b = mu A/(1 + mu): by (1),
/// v^2 = (1 + mu)((h - b)^2 - (B - b)^2) g/A. A chain that is only supported would fly off there.
///
/// N links of length l = A/N: N + 1 beads of rho l, half of that at either end, are the trapezoidal rule for
/// its weight, exact on the wall and, as the edge is analytic, elsewhere but for e^(-2 pi 0.92 R/l): so l
/// pulls as it should, rho g times the depth of its end. R = 3/2 l, and what is left are the chords:
///  - a chord spans an arc longer than itself by (curvature l)^2/24, so between two beads on either side of
///    the edge there is  D = l^2/24 . 2/(3 R) = l^2/(36 R)  more than the links' length: when the last bead
///    is at the corner, s = 0, the end hangs at A + D, or a little less, as part of the arc lies behind it;
///  - as many beads pass anywhere, so on the arc they are faster by the same factor: the kinetic energy is
///    that of a chain longer by  rho l^2/12 . 2/(3 R),  A + 2 D in the left hand side of (1).
///
///   T_N = sqrt((A + 2 D)/(g (1 + mu))) acosh((A + (1 + mu) D)/c),   D = A/(54 N)                (4)
///
/// Of order 1 in 1/N, and small. A sharper edge, R < l, would add the oscillating error of the trapezoidal
/// rule, largest at the start, where the beads are slow; a wider one must still be short against B.
///
/// Friction. The last bead before a bend is drawn onto the table by the rods' tension, not by its weight
/// only: if it is rough there this is a capstan, whose part of tau does not vanish with l. So the table is
/// rough up to a distance C before the corner, mu/(1 + e^(2 (x + C)/R)), C = R (4 + log N): what the bend
/// adds is mu tau e^(-C/R) pi/2 = 0.03 mu tau/N. What is braked is shorter than A - h by L = C - sigma R - D;
/// (1) with mu (A - L) for mu A has the motion that it has with h shifted by
///
///   e = -mu L/(1 + mu),                                                                         (5)
///
/// so B and the place where the chain leaves are counted from s = e: there its pull is that of the notes'.
/// The smooth part of the table, which the end crosses last, costs mu g (L/(1 + mu))^3/(6 A v^3) of time.
struct ChainOverEdge {
  int links = 100;        ///< N
  double length = 1.0;    ///< A [length]
  double hanging = 0.5;   ///< B: well beyond R [length]
  double friction = 0.0;  ///< mu >= 0
  double mass = 1.0;      ///< of all of it [mass]
  double gravity = 9.81;

  [[nodiscard]] GuidedChain scene() const;
  /// The last bead is at the place of the corner: ends the run.
  [[nodiscard]] Event<2> leaves(const GuidedChain& chain) const;

  [[nodiscard]] double time() const;             ///< (3), infinite or no number if it does not start
  [[nodiscard]] double time_of_links() const;    ///< (4), and what the smooth part costs
  [[nodiscard]] double time_of_pulling() const;  ///< when the edge has to pull
  [[nodiscard]] double tension(double hanging_now) const;  ///< (2)

  [[nodiscard]] double link() const { return length / links; }
  [[nodiscard]] RoundedEdge edge() const { return {1.5 * link()}; }
  [[nodiscard]] double smooth() const;  ///< L, 0 without friction
  [[nodiscard]] double origin() const { return -friction * smooth() / (1.0 + friction); }  ///< e
  /// Between the rough part and the edge; the friction force is known to lose this much [energy].
  [[nodiscard]] double lost() const;

 private:
  [[nodiscard]] double net_pull() const { return hanging * (1.0 + friction) - friction * length; }  // c
  [[nodiscard]] double excess() const { return link() * link() / (36.0 * edge().radius); }          // D
  [[nodiscard]] double rough_until() const;                                                         // C
  [[nodiscard]] double rate() const;  // sqrt((1 + mu) g/A)
};

/// How the times at which chains of more and more links leave approach that of the continuum: within 3/2 of
/// T_N - T. The rest is of higher order in 1/N and, of friction, what the bend adds.
[[nodiscard]] EventModel chain_over_edge_model();
[[nodiscard]] EventModel chain_over_edge_friction_model();

}  // namespace dalembert::models
