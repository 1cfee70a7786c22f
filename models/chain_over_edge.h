#pragma once

#include <dalembert/models/event_model.h>
#include <dalembert/models/rounded_edge.h>

#include <cmath>
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
/// With h hanging, h pulls and the rest is braked: the tension tau at the edge is that of either part,
///
///   rho h (g - h'') = tau = rho (A - h)(h'' + mu g),   so   A h'' = g ((1 + mu) h - mu A),      (1)
///   tau = (1 + mu) rho g h (A - h)/A,                                                           (2)
///   T = sqrt(A/(g (1 + mu))) acosh(A/c),   c = B (1 + mu) - mu A                                (3)
///
/// until h = A; it does not start if c <= 0. With b = mu A/(1 + mu), (1) gives
///
///   v^2 = ((h - b)^2 - (B - b)^2) (1 + mu) g/A.                                                 (4)
///
/// The edge turns the chain: it exerts tau - rho v^2 towards the table, and has to pull as soon as that is
/// negative, from  2 h^2 - (A + 2 b) h + 2 b B - B^2 = 0  on. A chain that is only supported flies off there;
/// this one is held both ways.
///
/// It is made of N links, l = A/N, between N + 1 beads of mass rho l (half of that at either end, as in the
/// trapezoidal rule) that slide on a RoundedEdge, R = 3/4 l N^(1/4); see `time_of_links` and `smooth`.
struct ChainOverEdge {
  int links = 100;        ///< N
  double length = 1.0;    ///< A [length]
  double hanging = 0.5;   ///< B, well beyond R [length]
  double friction = 0.0;  ///< mu >= 0
  double mass = 1.0;      ///< of all of it [mass]
  double gravity = 9.81;

  [[nodiscard]] GuidedChain scene() const;
  /// The last bead is at the place of the corner: ends the run.
  [[nodiscard]] Event<2> leaves(const GuidedChain& chain) const;

  [[nodiscard]] double time() const;  ///< (3), of a chain that starts
  /// When the edge begins to pull. A round one does so later: what is in the bend moves towards the wall,
  /// too, sigma R more of the chain that tau accelerates.
  [[nodiscard]] double time_of_pulling() const;
  [[nodiscard]] double tension(double hanging_now) const;  ///< (2)

  /// (3) of N links, in leading order, and what `smooth` adds:
  ///
  ///   T_N = sqrt((A + 2 D)/(g (1 + mu))) acosh((A + (1 + mu) D)/c),   D = l^2/(36 R) = A/(27 N^(5/4)).   (5)
  ///
  /// Beads of equal masses at equal distances are the trapezoidal rule for the weight, exact on the wall;
  /// when the chain has moved by l one bead has gone from the table to the depth of its end: it pulls by rho
  /// g times that depth, as it should. What is left of R are the chords:
  ///  - a chord spans an arc longer than itself by (curvature l)^2/24, a part of it, so a chain over the edge
  ///    reaches further than its length by  D = l^2/24 int curvature^2 ds: with the last bead at the corner
  ///    the end hangs at A + D (at A + 0.835 D if it stands in the bend already, which it does without
  ///    friction);
  ///  - as many beads come by anywhere, so in the bend they are faster by the same part, and the kinetic
  ///    energy is that of a chain longer by  2 D.
  ///
  /// About these means all oscillates as beads come by, an analytic curve's way by e^(-2 pi 0.92 R/l), where
  /// 0.92 R is how far from the real s its nearest singularity lies (cosh d = 0). That is small, but with R/l
  /// fixed it would stay while N grows: from rest an oscillation of the speeds of table and end against each
  /// other costs time in proportion to int cos(2 pi h/l) dh/sqrt(h - B), of order 1/2 (of T, 5e-4/sqrt N with
  /// R = l), and the accelerations, which the forces show, oscillate N times as much. So R goes to zero
  /// slower than l, and T_N - T with order 5/4; (With R = 2 l it has
  /// order 1 from 100 to 1600 links, but at 400 the tension at the edge oscillates by half a percent.)
  /// The limit on the other side is B: R is to be short against it.
  [[nodiscard]] double time_of_links() const;

  /// By what the table's rough part is shorter than A - h, 0 without friction [length].
  ///
  /// The bead before a bend is pressed onto the table by the rods as well: where it is rough that is a
  /// capstan, whose part mu tau theta does not vanish with l. So friction ends before the bend does begin, at
  /// x = -C, smoothly, with the coefficient mu/(1 + e^(2 (x + C)/R)). Beads there still are turned, and add
  /// mu tau int e^(x/R)/(1 + e^(2 (x + C)/R)) dx/R = mu tau (pi/2) e^(-C/R);  C = R (3 + 5/4 log N) leaves
  /// 0.08 mu tau/N^(5/4) of it. Then L = C - sigma R - D is braked no more, and with mu (A - L) for mu A, (1)
  /// is what it was with h counted from
  ///
  ///   s = e = -mu L/(1 + mu)                                                                         (6)
  ///
  /// instead of the corner. So are B and the place where the chain leaves: its pull there is that of the
  /// notes. But in (1) friction reverses while the end crosses L/(1 + mu), which costs mu g (L/(1 + mu))^3/(6
  /// A v^3) of time, (R log N)^3.
  [[nodiscard]] double smooth() const;
  [[nodiscard]] double origin() const { return -friction * smooth() / (1.0 + friction); }  ///< e
  /// What friction takes while the rough part that is covered shrinks from A - B - L/(1 + mu) to 0: mu rho g
  /// times half its square, and pi^2 R^2/24 of where it ends smoothly [energy].
  [[nodiscard]] double energy_lost() const;

  [[nodiscard]] double link() const { return length / links; }
  [[nodiscard]] RoundedEdge edge() const { return {0.75 * link() * std::pow(links, 0.25)}; }

 private:
  [[nodiscard]] double net_pull() const { return hanging * (1.0 + friction) - friction * length; }  // c
  [[nodiscard]] double excess() const { return link() * link() / (36.0 * edge().radius); }          // D
  [[nodiscard]] double rough_until() const;                                                         // C
  [[nodiscard]] double rate() const;  // sqrt((1 + mu) g/A)
};

/// The times at which chains of more and more links leave, against that of the continuum: within 3/2 of
/// T_N - T, which is of order 5/4; the half is for higher orders and for what the bend adds to friction.
[[nodiscard]] EventModel chain_over_edge_model();
[[nodiscard]] EventModel chain_over_edge_friction_model();

}  // namespace dalembert::models
