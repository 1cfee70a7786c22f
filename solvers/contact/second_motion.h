#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/rough_state.h>
#include <dalembert/solvers/contact/slip_coupling.h>

#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Another motion that satisfies Coulomb's law, where one has been found. With sigma_j = -mu_j |N_j| d_j of
/// what slides, s_j the signs of N_j and SlipCoupling
///
///   N = N_0 + G |N|,   G_ij = -mu_j B_ij d_j,   N = (1 - G s)^-1 N_0,   C = (1 - G s)^-1 G            (1)
///
/// is linear between changes of signs. With the other sign of N_k alone it gives
///
///   N'_k = N_k/(1 + 2 s_k C_kk),   N' = N - 2 s_k N'_k C_k                                            (2)
///
/// which has that sign if 1 + 2 s_k C_kk < 0, of one N if |G| > 1. It counts if the others keep theirs, and
/// what starts from rest its direction. (Signs that only change together are not tried, nor are the bounds of
/// what sticks looked at.)
struct SecondMotion {
  const RoughState* rough;
  double N, other;  ///< its normal force, and that of the other motion

  /// Of those that slide, in the order of `coupling`, which is that without their friction. Tried is what
  /// `begins`, on a constraint that holds both ways.
  [[nodiscard]] static std::optional<SecondMotion> find(const SlipCoupling& coupling,
                                                        const std::vector<const RoughState*>& sliding);
  [[nodiscard]] static bool tries(const RoughState& rough) {
    return rough.begins && !rough.one_sided && rough.mode == RoughState::Mode::slides;
  }
};

}  // namespace dalembert
