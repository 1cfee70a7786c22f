#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>

namespace DALEMBERT_HIDDEN dalembert {

/// The lowest modes of a large scene. Without damping and rotation, with s > 0 small,
///
///   [ K + s M  -W^T ] [ u ]   [ M x ]
///   [ W         c   ] [ y ] = [  0  ],      u = T x,      T u = u/(omega^2 + s),                  (1)
///
/// T is symmetric in the mass metric. Its largest eigenvalues belong to the omega^2 closest to -s. Lanczos'
/// method with full orthogonalisation (Parlett, The Symmetric Eigenvalue Problem, 13) from a generic vector;
/// modes of one frequency are found one by one, as converged ones are deflated from the next run, until a run
/// finds nothing as low. s, a ten millionth of the largest K/M, keeps (1) regular where there are free
/// motions; that K + s M + rho W^T W has an L D L^T with D > 0 proves that nothing is below -s.
///
/// With damping, Coriolis forces or forces without a potential: `nearest_solutions` of the quadratic problem.
/// (1) then finds the free motions, one mode each, and whether K is positive: with damping that adds no
/// energy all modes are then stable (Kelvin, Tait; Chetaev), those that were not found too. Without such an
/// energy they are unstable if one that was found surely grows, else undecided: what some modes tell is not
/// told of all.
///
/// Throws InvalidScene if the scene has nonholonomic rows, no number of modes is wanted, fewer than wanted
/// converge, or an eigenvalue 0 cannot be told from others.
[[nodiscard]] Modes lowest_modes(const System& system, const LinearTerms& terms, std::size_t wanted);

}  // namespace dalembert
