#pragma once

#include <dalembert/core/vec.h>

#include <cmath>

namespace dalembert {

/// n + 1 particles with the mass m of a body of n dimensions, its centre of mass, and its second moments
/// m a_k^2 along its principal axes e_k. Particle 0 has the mass m/(n + 1), the others share the rest as the
/// second moments do, all arms being equally long:
///
///   R^2 = (n + 1)/n sum a_k^2,   s_k = (a_k/R)^2 the shares,   c^2 = 1 - sum s_k = 1/(n + 1)      (1)
///   r_k = R (e_k - s/(1 + c)),   r_0 = -R s/c                                                   (2)
///   r = sum w_i r_i,  w_k = s_k (1 - (x_1 + ... + x_n)/(R (1 + c))) + x_k/R,  sum w_i = 1        (3)
///
/// for the point r at x_1 ... x_n from the centre. With equal moments this is the regular simplex of equal
/// masses. With unequal ones the obvious set, equal masses a_k apart, has short arms across a slender body
/// or a plate: a force F at a distance x from its axis then stretches the rods between them by F x/a_k.
/// Here only masses are small, and internal forces stay of the size of F x/R.
template <int n>
struct Equimomental {
  explicit Equimomental(const Vec<n>& a)
      : R(std::sqrt((n + 1.0) / n) * a.norm()), c(std::sqrt(1.0 / (n + 1.0))), s((a / R).cwiseAbs2()) {}

  double R, c;
  Vec<n> s;

  /// Mass of particle i as a share of the body's.
  [[nodiscard]] double share(int i) const { return i == 0 ? c * c : s[i - 1]; }
  [[nodiscard]] Vec<n> place(int i) const {
    if (i == 0) return -R / c * s;
    return R * (Vec<n>::Unit(i - 1) - s / (1.0 + c));
  }
  /// (3), from particle 0 on.
  [[nodiscard]] Vec<n + 1> weights(const Vec<n>& x) const {
    const Vec<n> others = s * (1.0 - x.sum() / (R * (1.0 + c))) + x / R;
    Vec<n + 1> w;
    w[0] = 1.0 - others.sum();
    for (int i = 0; i < n; ++i) w[i + 1] = others[i];
    return w;
  }
};

}  // namespace dalembert
