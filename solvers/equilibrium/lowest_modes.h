#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>

namespace DALEMBERT_HIDDEN dalembert {

/// The lowest modes of a large scene at rest, without damping: with s > 0 small,
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
/// Throws InvalidScene if the scene is damped, has nonholonomic rows or forces without a potential (K must be
/// symmetric), if no number of modes is wanted or fewer than wanted converge.
[[nodiscard]] Modes lowest_modes(const System& system, const LinearTerms& terms, std::size_t wanted);

}  // namespace dalembert
