#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/equilibrium_solver.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>

#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Where linear terms say of a mode that it neither decays nor grows, an energy proves stability only if no
/// force adds to it. With the velocity u = v - X(q) relative to the frame, X = A q + b, and forces F without
/// a potential,
///
///   H' = u.F(q, X + u)   of   H = u.M u/2 + V - X.M X/2.                                             (1)
///
/// H, with a potential of F(q, X) if that has one, is a Lyapunov function if near the equilibrium
///
///   u.(F(q, X + u) - F(q, X)) <= 0,     a.T b = b.T a   with T = F_q + F_v A at (q, X)               (2)
///
/// for all velocities u, a, b that the constraints allow: F(q, X) then does no work on a closed path (on a
/// curved manifold too, as the derivative of a 1-form that is pulled back is the one pulled back).
///
/// (2) is looked at along the modes that do not decay, each by itself and all together, with a little of all
/// else: elsewhere linear damping would hide what grows here. The smallest displacement that shows more than
/// round-off decides, so that it is the term of lowest order. A vibration of one degree of freedom asks for
/// (2) only of what is odd in u: without that it is its own run backwards, and so periodic. Where a momentum
/// makes the energy > 0, (2) must be 0: damping as well as driving makes something grow. Modes of eigenvalue
/// 0 ask for nothing where their velocities decay: they are places of rest.
///
/// Looked at in some states, (2) is not proved, but a violation is one. Forces that read multipliers are not
/// looked at.
struct NearEquilibrium {
  const Problem& problem;
  const EquilibriumSolver& balance;
  const FlatSample& at;
  const LinearTerms& terms;

  /// For each uncoupled part of a scene the label of a force that violates (2), or nothing; empty if no force
  /// is without a potential. Of a small scene, with all its modes.
  [[nodiscard]] std::vector<std::string> violations(std::span<const Mode> modes) const;
  /// Of a large one, of which these modes were found: along others, too, that nothing damps.
  [[nodiscard]] std::vector<std::string> violations_of_many(std::span<const Mode> modes) const;
};

}  // namespace dalembert
